"""YAML in, checked values out, every complaint with its file and line.

Safe by construction: plain scalars, lists and mappings only; no aliases, so that no file blows up in memory;
limits on size, depth and count; YAML 1.2's implicit types, so that the country code `NO` stays a word.
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
"""In what libyaml says of a file that is deeper than it goes itself, which newer ones do."""
MAX_NODES = 200_000
KEPT = 128
"""Texts that were read already: a test of many cases reads the same profiles and rules again and again."""


if TYPE_CHECKING or not yaml.__with_libyaml__:
    from yaml import SafeDumper as _SafeDumper
    from yaml import SafeLoader as _SafeLoader
else:  # the parser in C reads the same files about eight times as fast, and the emitter writes the same text
    from yaml import CSafeDumper as _SafeDumper
    from yaml import CSafeLoader as _SafeLoader


class _Loader(_SafeLoader):
    """PyYAML's parser with the YAML 1.2 core schema: no `yes`, no octal, no sexagesimal, no dates."""


class _Dumper(_SafeDumper):
    """PyYAML's emitter; it quotes a word that either version of YAML could take for something else."""

    def ignore_aliases(self, data: object) -> bool:
        """Write everything out: the reader refuses aliases."""
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
    """One YAML file, read and safe, not yet checked; nobody changes its data. The same only as itself."""

    path: Path
    name: str
    """The path as the user gave it: messages use it."""
    data: Any
    lines: Mapping[Location, int]
    """The line of every value (of its key, where it has one), counted from 1."""
    text: str
    """All of it, as read."""
    spans: Mapping[Location, tuple[int, int]]
    """Where in `text` every scalar starts and ends."""

    def where(self, location: Location) -> Where:
        """The place of a value, or of the nearest thing around it that stands in the file.

        What a program wrote out has no lines that anybody sees: its place is the keys that lead there.
        """
        if not self.path.name:
            return Where(", ".join((self.name, *map(str, location))))
        while location and location not in self.lines:
            location = location[:-1]
        return Where(self.name, self.lines.get(location, 1))

    def part(self, *location: str | int) -> YamlFile:
        """What stands at a place of this file, as a file of its own that still knows its lines."""
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
        """The line and column of one character of a text, however YAML quoted or folded it.

        Args:
            location: The text's.
            value: The text, as YAML gave it.
            offset: The character's index in it; beyond the end counts as just behind its last character.
        """
        start, end = self.spans[location]
        raw = self.text[start:end]
        skipped = 1 if raw[:1] in "'\"" else raw.find("\n") + 1 if raw[:1] in "|>" else 0
        printed = [start + i for i, character in enumerate(raw) if i >= skipped and not character.isspace()]
        # Folding changes white space only: count the characters that print.
        count = sum(not character.isspace() for character in value[:offset])
        behind = 1 if count == sum(not character.isspace() for character in value) and count else 0
        index = printed[min(count - behind, len(printed) - 1)] + behind if printed else start
        line_start = self.text.rfind("\n", 0, index) + 1
        return Where(self.name, self.text.count("\n", 0, index) + 1, index - line_start + 1)

    @contextmanager
    def placing(self, *location: str | int) -> Iterator[None]:
        """Give every complaint from inside the place of a value, unless it already has one."""
        try:
            yield
        except InputError as error:
            raise error.at(self.where(location)) from None

    def check(self, model: type[ModelT]) -> ModelT:
        """The file's content as the given model.

        Raises:
            InputError: naming the line, for the first value that the model refuses.
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
        name: How messages call it; the path as given when None.

    Raises:
        InputError: if the file is missing, no UTF-8 text, no YAML, or over a limit.
    """
    name = name or str(path)
    return parse_yaml(_text(path, name), path, name)


@lru_cache(maxsize=KEPT)
def parse_yaml(text: str, path: Path, name: str) -> YamlFile:
    """Read YAML that is in memory already.

    Args:
        text: The YAML.
        path: The file that it comes from.
        name: How messages call it.

    Raises:
        InputError: if it is no YAML, or over a limit.
    """
    try:
        _refuse_excess(text, name)
        node = yaml.compose(text, Loader=_Loader)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        if _NESTING in str(error.problem):  # the scanner looks ahead, and has a limit of its own
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
    """Walk the flat stream of events, before anything is built from it."""
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
    """What a file holds that is no mapping, in words."""
    if value is None:
        return "nothing"
    return "a list" if isinstance(value, list) else f"{value!r:.40}"


@dataclass(frozen=True, slots=True)
class _Marks:
    """What is noted while the values are built."""

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
            # Digits beyond any float's are refused by every range, and would take Python seconds to convert.
            return int(node.value) if len(node.value) < 300 else float(node.value)
        case "float":
            return float(node.value.lower().replace(".inf", "inf").replace(".nan", "nan"))
    return str(node.value)


def dump_yaml(content: Mapping[str, Any], *, inline: bool = False) -> str:
    """Plain values as YAML text that `read_yaml` reads back unchanged; keys in their own order.

    Args:
        content: Mappings, lists, words and numbers.
        inline: Write a list or mapping that holds no other in one line, as people do by hand.
    """
    return yaml.dump(
        content,
        Dumper=_Dumper,
        default_flow_style=None if inline else False,
        sort_keys=False,
        allow_unicode=True,
        width=110,
    )
