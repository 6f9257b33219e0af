"""From pydantic's refusal of a file to one error that says where, what, and what to do."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from comity_fis.errors import InputError, WrongValueError, closest

if TYPE_CHECKING:
    from pydantic import BaseModel, ValidationError
    from pydantic_core import ErrorDetails

    from comity_fis.yaml_file import Location, YamlFile

    Schema = Mapping[str, Any]
    """A part of a JSON schema."""


def explained(refusal: ValidationError, model: type[BaseModel], file: YamlFile) -> InputError:
    """The first complaint in the order of lines; a misspelt key before the one that it leaves missing."""

    def order(error: ErrorDetails) -> tuple[bool, int]:
        return error["type"] == "missing", file.where(_in_file(error, file)).line or 0

    return _explained(min(refusal.errors(), key=order), model, file)


def _explained(error: ErrorDetails, model: type[BaseModel], file: YamlFile) -> InputError:
    where = file.where(_in_file(error, file))
    key = _called(error["loc"]) or file.name
    context = error.get("ctx", {})
    cause = context.get("error")
    if isinstance(cause, WrongValueError):
        return cause.at(where)
    expected, got = f"{key} to be right: {error['msg'][0].lower()}{error['msg'][1:]}", _short(error["input"])
    remedy = "Change it here."
    match error["type"]:
        case "extra_forbidden":
            expected, got = "a known key", repr(key)
            remedy = closest(key, set(_keys_beside(model, error["loc"])))
        case "missing":
            expected, got, remedy = f"the key {key!r}", "nothing", f"Add a line `{key}: ...` here."
        case "union_tag_invalid":
            key = context["discriminator"].strip("'")
            expected, got = f"{key} to be one of {context['expected_tags']}", repr(context["tag"])
        case "no_level":
            expected, got, remedy = "the key 'level'", "nothing", "Add a line `level: ...` here."
        case "union_tag_not_found":
            key = context["discriminator"].strip("'")
            expected, got, remedy = f"the key {key!r}", "nothing", f"Add a line `{key}: ...` here."
    return InputError(expected=expected, got=got, remedy=remedy, where=where)


def _in_file(error: ErrorDetails, file: YamlFile) -> Location:
    """The error's location without the parts that are pydantic's own (names of union members)."""
    location: Location = ()
    for part in error["loc"]:
        if (*location, part) in file.lines:
            location = (*location, part)
    return location


def _called(location: Location) -> str:
    """How messages call a value: by its key, or as an item of the list with that key."""
    keys = [part for part in location if isinstance(part, str)]
    last = location[-1] if location else ""
    return f"item {last + 1} of {keys[-1] if keys else 'the list'}" if isinstance(last, int) else last


def _keys_beside(model: type[BaseModel], location: Location) -> Iterator[str]:
    """The keys that the model knows where `location` stands, found through its JSON schema."""
    schema = model.model_json_schema(by_alias=True)
    definitions = schema.get("$defs", {})
    places = list(_alternatives(schema, definitions))
    for part in location[:-1]:
        found = [
            inner
            for place in places
            for below in _below(place, part)
            for inner in _alternatives(below, definitions)
        ]
        # The name of a union's member is in pydantic's path, and in the schema only as a value that marks it.
        places = found or [place for place in places if _is_marked(place, part)] or places
    for place in places:
        yield from place.get("properties", {})


def _alternatives(place: Schema, definitions: Schema) -> Iterator[Schema]:
    if "$ref" in place:
        yield from _alternatives(definitions[place["$ref"].rsplit("/", 1)[-1]], definitions)
    yield place
    for alternative in (*place.get("anyOf", ()), *place.get("oneOf", ())):
        yield from _alternatives(alternative, definitions)


def _below(place: Schema, part: str | int) -> Iterator[Schema]:
    candidates = (
        place.get("properties", {}).get(part),
        place.get("additionalProperties"),
        place.get("items"),
        *place.get("patternProperties", {}).values(),
    )
    return (candidate for candidate in candidates if isinstance(candidate, Mapping))


def _is_marked(place: Schema, tag: str | int) -> bool:
    marks = place.get("properties", {}).values()
    return any(tag == mark.get("const") or tag in mark.get("enum", ()) for mark in marks)


def _short(value: object, limit: int = 60) -> str:
    text = repr(value)
    return text if len(text) <= limit else f"{text[: limit - 3]}..."
