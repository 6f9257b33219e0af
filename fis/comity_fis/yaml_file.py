"""YAML in, checked values out, every complaint with its file and line.

Safe by construction: plain scalars, lists and mappings only; no aliases, so that no file can blow up in memory;
limits on size, depth and count; YAML 1.2's implicit types, so that the country code `NO` stays a word.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import yaml

from comity_fis.errors import InputError, Where, closest

if TYPE_CHECKING:
    from pydantic import BaseModel
    from pydantic_core import ErrorDetails

ModelT = TypeVar("ModelT", bound="BaseModel")

Location = tuple[str | int, ...]
"""The way from the document's root to a value: keys and list indexes."""

MAX_BYTES = 2_000_000
MAX_DEPTH = 40
MAX_NODES = 200_000


class _Loader(yaml.SafeLoader):
    """PyYAML's parser with the YAML 1.2 core schema: no `yes`, no octal, no sexagesimal, no dates."""


_Loader.yaml_implicit_resolvers = {}
for _tag, _pattern, _first in (
    ("null", r"~|null|Null|NULL|", ["~", "n", "N", ""]),
    ("bool", r"true|True|TRUE|false|False|FALSE", list("tTfF")),
    ("int", r"[-+]?[0-9]+", list("-+0123456789")),
    ("float", r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?|[-+]?\.(inf|Inf|INF)", list("-+.0123456789")),
    ("float", r"\.(nan|NaN|NAN)", ["."]),
):
    _Loader.add_implicit_resolver(f"tag:yaml.org,2002:{_tag}", re.compile(rf"^(?:{_pattern})$"), _first)


@dataclass(frozen=True, slots=True)
class YamlFile:
    """One YAML file, read and safe, not yet checked."""

    path: Path
    name: str
    """The path as the user gave it: messages use it."""
    data: Any
    lines: Mapping[Location, int]
    """The line of every value, counted from 1."""

    def where(self, location: Location) -> Where:
        """The place of a value, or of the nearest thing around it that stands in the file."""
        while location and location not in self.lines:
            location = location[:-1]
        return Where(self.name, self.lines.get(location, 1))

    def check(self, model: type[ModelT]) -> ModelT:
        """The file's content as the given model.

        Raises:
            InputError: naming the line, for the first value that the model refuses.
        """
        from pydantic import ValidationError

        if not isinstance(self.data, Mapping):
            raise InputError(
                expected="a mapping of keys to values",
                got="nothing" if self.data is None else f"a {type(self.data).__name__}",
                remedy=f"Write lines such as `schema_version: 1`; `comity schema` prints what {self.name} may hold.",
                where=self.where(()),
            )
        try:
            return model.model_validate(self.data)
        except ValidationError as refusal:
            first = min(refusal.errors(), key=lambda error: self.where(_in_file(error, self.lines)).line or 0)
            raise self._explain(first, model) from None

    def _explain(self, error: ErrorDetails, model: type[BaseModel]) -> InputError:
        location = _in_file(error, self.lines)
        where = self.where(location)
        key = str(error["loc"][-1]) if error["loc"] else self.name
        cause = error.get("ctx", {}).get("error")
        if isinstance(cause, InputError):
            return cause.at(where)
        match error["type"]:
            case "extra_forbidden":
                known = sorted(_keys_beside(model, error["loc"]))
                return InputError(expected="a known key", got=repr(key), remedy=closest(key, known), where=where)
            case "missing":
                return InputError(
                    expected=f"the key {key!r}", got="nothing", remedy=f"Add a line `{key}: ...` here.", where=where
                )
        return InputError(
            expected=f"{key} to be right: {error['msg'][0].lower()}{error['msg'][1:]}",
            got=_short(error["input"]),
            remedy=f"Change the value of {key!r}.",
            where=where,
        )


def read_yaml(path: Path, name: str | None = None) -> YamlFile:
    """Read one YAML file.

    Args:
        path: The file.
        name: How messages call it; the path as given when None.

    Raises:
        InputError: if the file is missing, no UTF-8 text, no YAML, or over a limit.
    """
    name = name or str(path)
    text = _text(path, name)
    try:
        _refuse_excess(text, name)
        node = yaml.compose(text, Loader=_Loader)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        raise InputError(
            expected="YAML",
            got=str(error.problem or error.context or "a syntax error"),
            remedy="Check the indentation, colons and quotes around this line.",
            where=Where(name, mark.line + 1, mark.column + 1) if mark else Where(name),
        ) from None
    except yaml.YAMLError as error:
        raise InputError(
            expected="YAML", got=str(error).splitlines()[0], remedy="Save the file as plain UTF-8 text.", where=Where(name)
        ) from None
    lines: dict[Location, int] = {}
    data = None if node is None else _value(node, (), lines, name)
    return YamlFile(path=path, name=name, data=data, lines=lines)


def _text(path: Path, name: str) -> str:
    def refuse(got: str, remedy: str) -> InputError:
        return InputError(expected="a YAML file", got=got, remedy=remedy, where=Where(name))

    try:
        if not path.is_file():
            raise refuse("no such file" if not path.exists() else "something else", "Check the path and its spelling.")
        if path.stat().st_size > MAX_BYTES:
            raise refuse(f"{path.stat().st_size} bytes", f"Keep it below {MAX_BYTES} bytes.")
        return path.read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        raise refuse(f"a byte that is no UTF-8 at position {error.start}", "Save the file as UTF-8 text.") from None
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        raise refuse(reason, "Check the path and its permissions.") from None


def _refuse_excess(text: str, name: str) -> None:
    """Walk the flat stream of events, before anything is built from it."""
    depth = 0
    for count, event in enumerate(yaml.parse(text, Loader=_Loader)):
        where = Where(name, event.start_mark.line + 1)
        if isinstance(event, yaml.AliasEvent):
            raise InputError(
                expected="plain values", got=f"the alias *{event.anchor}", remedy="Write the value out.", where=where
            )
        depth += isinstance(event, yaml.CollectionStartEvent) - isinstance(event, yaml.CollectionEndEvent)
        if depth > MAX_DEPTH:
            raise InputError(
                expected=f"at most {MAX_DEPTH} levels", got="deeper nesting", remedy="Flatten the file.", where=where
            )
        if count > MAX_NODES:
            raise InputError(
                expected=f"at most {MAX_NODES} values", got="more", remedy="Split the file.", where=where
            )


def _value(node: yaml.Node, location: Location, lines: dict[Location, int], name: str) -> Any:
    lines[location] = node.start_mark.line + 1
    if isinstance(node, yaml.MappingNode):
        return dict(_pairs(node, location, lines, name))
    if isinstance(node, yaml.SequenceNode):
        return [_value(item, (*location, i), lines, name) for i, item in enumerate(node.value)]
    return _scalar(node, name)


def _pairs(
    node: yaml.MappingNode, location: Location, lines: dict[Location, int], name: str
) -> Iterator[tuple[str, Any]]:
    seen: set[str] = set()
    for key_node, value_node in node.value:
        where = Where(name, key_node.start_mark.line + 1)
        if not isinstance(key_node, yaml.ScalarNode):
            raise InputError(expected="a word as key", got="a collection", remedy="Use a plain word.", where=where)
        key = str(key_node.value)
        if key in seen:
            raise InputError(
                expected="each key once", got=f"{key!r} again", remedy="Remove or rename one of them.", where=where
            )
        seen.add(key)
        value = _value(value_node, (*location, key), lines, name)
        lines[(*location, key)] = key_node.start_mark.line + 1
        yield key, value


def _scalar(node: yaml.Node, name: str) -> str | int | float | bool | None:
    match node.tag.removeprefix("tag:yaml.org,2002:"):
        case "null":
            return None
        case "bool":
            return str(node.value).lower() == "true"
        case "int":
            # Longer digits than any float are refused by the models' ranges, and would take Python seconds to convert.
            return int(node.value) if len(node.value) < 300 else float(node.value)  # noqa: PLR2004
        case "float":
            return float(node.value.lower().replace(".inf", "inf").replace(".nan", "nan"))
        case "str":
            return str(node.value)
    raise InputError(
        expected="a plain value", got=f"the tag {node.tag}", remedy="Remove the tag.",
        where=Where(name, node.start_mark.line + 1),
    )


def _in_file(error: ErrorDetails, lines: Mapping[Location, int]) -> Location:
    """The error's location without the parts that are pydantic's own (names of union members)."""
    location: Location = ()
    for part in error["loc"]:
        if (*location, part) in lines:
            location = (*location, part)
    return location


def _keys_beside(model: type[BaseModel], loc: Location) -> Iterator[str]:
    """The keys that the model knows where `loc` stands, found through its JSON schema."""
    schema = model.model_json_schema(by_alias=True)
    definitions = schema.get("$defs", {})

    def inside(node: Mapping[str, Any]) -> Iterator[Mapping[str, Any]]:
        if "$ref" in node:
            yield from inside(definitions[node["$ref"].rsplit("/", 1)[-1]])
        yield node
        for alternative in (*node.get("anyOf", ()), *node.get("oneOf", ())):
            yield from inside(alternative)

    places = list(inside(schema))
    for part in loc[:-1]:
        found = []
        for place in places:
            for below in (
                place.get("properties", {}).get(part) if isinstance(part, str) else None,
                place.get("additionalProperties"),
                place.get("items"),
            ):
                if isinstance(below, Mapping):
                    found += inside(below)
        # A union member's own name is in pydantic's path but not in the schema's.
        places = found or places
    for place in places:
        yield from place.get("properties", {})


def _short(value: object, limit: int = 60) -> str:
    text = repr(value)
    return text if len(text) <= limit else f"{text[: limit - 3]}..."
