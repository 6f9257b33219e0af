"""Reads and validates YAML; every error has its file and line.

Safe by construction: only plain scalars, lists and mappings; no aliases, so that no file expands in memory;
limits on size, depth and count; implicit types of YAML 1.2, so that the country code `NO` is a string.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import yaml

from comity_fis.errors import InputError, Location, Where
from comity_fis.validation.no_file import no_file
from comity_fis.validation.refusal import explained
from comity_fis.validation.undecodable import REMEDY, undecodable

if TYPE_CHECKING:
    from pydantic import BaseModel

ModelT = TypeVar("ModelT", bound="BaseModel")

MAX_BYTES = 2_000_000
MAX_DEPTH = 40
_NESTING = "nesting depth"
"""Part of libyaml's message for a file that exceeds its own nesting limit, which newer versions have."""
MAX_NODES = 200_000
KEPT = 128
"""Number of parsed texts to cache: test suites read the same profiles and rules repeatedly."""


if TYPE_CHECKING or not yaml.__with_libyaml__:
    from yaml import SafeDumper as _SafeDumper
    from yaml import SafeLoader as _SafeLoader
else:  # the C parser is about eight times as fast, and the C emitter writes the same text
    from yaml import CSafeDumper as _SafeDumper
    from yaml import CSafeLoader as _SafeLoader


class _Loader(_SafeLoader):
    """PyYAML's parser with the YAML 1.2 core schema: no `yes`, no octal, no sexagesimal, no dates."""


class _Dumper(_SafeDumper):
    """PyYAML's emitter; it quotes strings that either version of YAML could interpret differently."""

    def ignore_aliases(self, data: object) -> bool:
        """Write aliases in full: the reader rejects them."""
        return True


_Loader.yaml_implicit_resolvers = {}
for _tag, _pattern, _first in (
    ("null", r"~|null|Null|NULL|", ["~", "n", "N", ""]),
    ("bool", r"true|True|TRUE|false|False|FALSE", list("tTfF")),
    ("int", r"[-+]?[0-9]+", list("-+0123456789")),
    (
        "float",
        r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?|[-+]?\.(inf|Inf|INF)",
        list("-+.0123456789"),
    ),
    ("float", r"\.(nan|NaN|NAN)", ["."]),
):
    for _class in (_Loader, _Dumper):
        _class.add_implicit_resolver(f"tag:yaml.org,2002:{_tag}", re.compile(rf"^(?:{_pattern})$"), _first)


@dataclass(frozen=True, slots=True, eq=False)
class YamlFile:
    """A YAML file, safely parsed but not yet validated; its data is immutable. Compared by identity."""

    path: Path
    name: str
    """The path as the user gave it, for messages."""
    data: Any
    lines: Mapping[Location, int]
    """The line of every value (of its key, if it has one), from 1."""
    text: str
    """The whole text."""
    spans: Mapping[Location, tuple[int, int]]
    """Start and end of every scalar in `text`."""

    def where(self, location: Location) -> Where:
        """Location of a value, or of the nearest enclosing one in the file.

        Data written by a program has no visible lines: its location is the path of keys.
        """
        if not self.path.name:
            return Where(", ".join((self.name, *map(str, location))))
        while location and location not in self.lines:
            location = location[:-1]
        return Where(self.name, self.lines.get(location, 1))

    def part(self, *location: str | int) -> YamlFile:
        """A part of this file as a file, with its original line numbers."""
        data, n = self.data, len(location)
        for step in location:
            data = data[step]
        return replace(
            self,
            data=data,
            lines={at[n:]: line for at, line in self.lines.items() if at[:n] == location},
            spans={at[n:]: span for at, span in self.spans.items() if at[:n] == location},
        )

    def where_in(self, location: Location, value: str, offset: int) -> Where:
        """Line and column of one character of a string, however YAML quoted or folded it.

        Args:
            location: Location of the string.
            value: The string as parsed.
            offset: Index of the character; beyond the end counts as just after the last character.
        """
        start, end = self.spans[location]
        raw = self.text[start:end]
        skipped = 1 if raw[:1] in "'\"" else raw.find("\n") + 1 if raw[:1] in "|>" else 0
        printed = [start + i for i, character in enumerate(raw) if i >= skipped and not character.isspace()]
        # Folding changes only white space, so count the printing characters.
        count = sum(not character.isspace() for character in value[:offset])
        behind = 1 if count == sum(not character.isspace() for character in value) and count else 0
        index = printed[min(count - behind, len(printed) - 1)] + behind if printed else start
        line_start = self.text.rfind("\n", 0, index) + 1
        return Where(self.name, self.text.count("\n", 0, index) + 1, index - line_start + 1)

    @contextmanager
    def placing(self, *location: str | int) -> Iterator[None]:
        """Give errors raised inside the location of a value, unless they have one."""
        try:
            yield
        except InputError as error:
            raise error.at(self.where(location)) from None

    def check(self, model: type[ModelT]) -> ModelT:
        """Validate the file's content with a model.

        Raises:
            InputError: The model rejects a value; with the line of the first one.
        """
        from pydantic import ValidationError

        if not isinstance(self.data, Mapping):
            kind = model.__name__.removesuffix("File").removesuffix("Model").lower()
            raise InputError(
                expected="a mapping of keys to values",
                got=_kind(self.data),
                remedy="Write lines such as `schema_version: 1`; "
                f"`comity schema {kind}` prints what it may hold.",
                where=self.where(()),
            )
        try:
            return model.model_validate(self.data)
        except ValidationError as refusal:
            raise explained(refusal, model, self.lines, self.where) from None


def read_yaml(path: Path, name: str | None = None) -> YamlFile:
    """Read one YAML file.

    Args:
        path: The file.
        name: Name of the file in messages; None: the path as given.

    Raises:
        InputError: The file is missing, not UTF-8 text, not YAML, or exceeds a limit.
    """
    name = name or str(path)
    return parse_yaml(_text(path, name), path, name)


@lru_cache(maxsize=KEPT)
def parse_yaml(text: str, path: Path, name: str) -> YamlFile:
    """Parse YAML text.

    Args:
        text: The YAML.
        path: The file that it comes from.
        name: Name of the file in messages.

    Raises:
        InputError: It is not YAML, or exceeds a limit.
    """
    try:
        _refuse_excess(text, name)
        node = yaml.compose(text, Loader=_Loader)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        if _NESTING in str(error.problem):  # the scanner looks ahead, and has its own limit
            raise _too_deep(Where(name, mark.line + 1 if mark else None)) from None
        raise InputError(
            expected="YAML",
            got=str(error.problem or error.context or "a syntax error").removeprefix("but found "),
            remedy="Check the indentation, colons and quotes around this line.",
            where=Where(name, mark.line + 1, mark.column + 1) if mark else Where(name),
        ) from None
    except yaml.YAMLError as error:
        raise InputError(
            expected="YAML",
            got=str(error).splitlines()[0],
            remedy="Save the file as plain UTF-8 text.",
            where=Where(name),
        ) from None
    marks = _Marks(name)
    data = None if node is None else _value(node, (), marks)
    return YamlFile(path=path, name=name, data=data, lines=marks.lines, text=text, spans=marks.spans)


def _text(path: Path, name: str) -> str:
    def refuse(got: str, remedy: str, where: Where | None = None) -> InputError:
        return InputError(expected="a YAML file", got=got, remedy=remedy, where=where or Where(name))

    try:
        if not path.is_file():
            raise refuse(no_file(path), "Check the path and its spelling.")
        if path.stat().st_size > MAX_BYTES:
            raise refuse(f"{path.stat().st_size} bytes", f"Keep it below {MAX_BYTES} bytes.")
        return path.read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        where, got = undecodable(error, name)
        raise refuse(got, REMEDY, where) from None
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        raise refuse(reason, "Check the path and its permissions.") from None


def _refuse_excess(text: str, name: str) -> None:
    """Enforce limits on the event stream before anything is built from it."""
    depth = 0
    for count, event in enumerate(yaml.parse(text, Loader=_Loader)):
        where = Where(name, event.start_mark.line + 1 if event.start_mark else None)
        if isinstance(event, yaml.AliasEvent):
            raise InputError(
                expected="plain values",
                got=f"the alias *{event.anchor}",
                remedy="Write the value out.",
                where=where,
            )
        tag = getattr(event, "tag", None)
        if tag is not None:
            raise InputError(
                expected="plain values", got=f"the tag {tag}", remedy="Remove the tag.", where=where
            )
        depth += isinstance(event, yaml.CollectionStartEvent) - isinstance(event, yaml.CollectionEndEvent)
        if depth > MAX_DEPTH:
            raise _too_deep(where)
        if count > MAX_NODES:
            raise InputError(
                expected=f"at most {MAX_NODES} values", got="more", remedy="Split the file.", where=where
            )


def _too_deep(where: Where) -> InputError:
    return InputError(
        expected=f"at most {MAX_DEPTH} levels", got="deeper nesting", remedy="Flatten the file.", where=where
    )


def _kind(value: object) -> str:
    """The type of a file's content that is not a mapping, in words."""
    if value is None:
        return "nothing"
    return "a list" if isinstance(value, list) else f"{value!r:.40}"


@dataclass(frozen=True, slots=True)
class _Marks:
    """Locations recorded while the values are built."""

    name: str
    lines: dict[Location, int] = field(default_factory=dict)
    spans: dict[Location, tuple[int, int]] = field(default_factory=dict)


def _value(node: yaml.Node, location: Location, marks: _Marks) -> Any:
    marks.lines[location] = node.start_mark.line + 1
    if isinstance(node, yaml.MappingNode):
        return dict(_pairs(node, location, marks))
    if isinstance(node, yaml.SequenceNode):
        return [_value(item, (*location, i), marks) for i, item in enumerate(node.value)]
    marks.spans[location] = (node.start_mark.index, node.end_mark.index)
    return _scalar(node)


def _pairs(node: yaml.MappingNode, location: Location, marks: _Marks) -> Iterator[tuple[str, Any]]:
    seen: set[str] = set()
    for key_node, value_node in node.value:
        where = Where(marks.name, key_node.start_mark.line + 1)
        if not isinstance(key_node, yaml.ScalarNode):
            raise InputError(
                expected="a word as key", got="a collection", remedy="Use a plain word.", where=where
            )
        key = str(key_node.value)
        if key in seen:
            raise InputError(
                expected="each key once",
                got=f"{key!r} again",
                remedy="Remove or rename one of them.",
                where=where,
            )
        seen.add(key)
        value = _value(value_node, (*location, key), marks)
        marks.lines[(*location, key)] = key_node.start_mark.line + 1
        yield key, value


def _scalar(node: yaml.Node) -> str | int | float | bool | None:
    match node.tag.removeprefix("tag:yaml.org,2002:"):
        case "null":
            return None
        case "bool":
            return str(node.value).lower() == "true"
        case "int":
            # Longer numbers exceed any float and would take Python seconds to convert.
            return int(node.value) if len(node.value) < 300 else float(node.value)
        case "float":
            return float(node.value.lower().replace(".inf", "inf").replace(".nan", "nan"))
    return str(node.value)


def dump_yaml(content: Mapping[str, Any], *, inline: bool = False) -> str:
    """Plain values as YAML text that `read_yaml` reads back unchanged; keys keep their order.

    Args:
        content: Mappings, lists, strings and numbers.
        inline: Write innermost lists and mappings in one line, as people do by hand.
    """
    return yaml.dump(
        content,
        Dumper=_Dumper,
        default_flow_style=None if inline else False,
        sort_keys=False,
        allow_unicode=True,
        width=110,
    )
