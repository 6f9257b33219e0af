"""Converts pydantic's validation error for a file to one error with location, problem and remedy."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from itertools import chain
from typing import TYPE_CHECKING, Any

from comity_fis.errors import InputError, Location, Where, WrongValueError, closest
from comity_fis.listing import listed
from comity_fis.validation.complaint import (
    TYPES,
    Complaint,
    counted,
    of_kind,
    of_length,
    of_type,
    or_a_list,
    shown,
)

if TYPE_CHECKING:
    from pydantic import BaseModel, ValidationError
    from pydantic_core import ErrorDetails

    Schema = Mapping[str, Any]
    """A part of a JSON schema."""


def explained(
    refusal: ValidationError,
    model: type[BaseModel],
    places: Collection[Location],
    where_of: Callable[[Location], Where],
) -> InputError:
    """The first error by line; a misspelt key takes precedence over the missing key that it causes.

    Args:
        refusal: Pydantic's error.
        model: The model that rejected the file.
        places: Locations of everything in the file.
        where_of: Maps a location to its line in the file.
    """
    errors = _most_specific(refusal.errors(), places)

    def order(error: ErrorDetails) -> tuple[bool, int]:
        return error["type"] == "missing", where_of(_in_file(error, places)).line or 0

    first = min(errors, key=order)
    place = _in_file(first, places)
    where = where_of(place)
    cause = first.get("ctx", {}).get("error")
    if isinstance(cause, WrongValueError):
        return cause.at(where)
    kinds = [
        _wanted(error, model) for error in errors if _in_file(error, places) == place and _is_type(error)
    ]
    said = of_type(_called(place), kinds, first["input"]) if _is_type(first) else _said(first, place, model)
    beside = {TYPES.get(error["type"]) for error in refusal.errors() if _in_file(error, places) == place}
    if first["type"] == "literal_error" and "a list" in beside:
        said = or_a_list(said, first["input"])
    return InputError(expected=said.expected, got=said.got, remedy=said.remedy, where=where)


def _most_specific(errors: Sequence[ErrorDetails], known: Collection[Location]) -> list[ErrorDetails]:
    """The errors about a value itself.

    An error about a list or mapping only follows from one inside it. If a value may have several types,
    pydantic reports an error for each; those for the type it nearly matches say the most.
    """
    places = [_in_file(error, known) for error in errors]
    around = {place[:n] for place in places for n in range(len(place))}
    nearly = {place for error, place in zip(errors, places, strict=True) if not _is_type(error)}
    inner = [(error, place) for error, place in zip(errors, places, strict=True) if place not in around]
    return [error for error, place in inner if place not in nearly or not _is_type(error)]


def _is_type(error: ErrorDetails) -> bool:
    return error["type"] in TYPES


def _wanted(error: ErrorDetails, model: type[BaseModel]) -> str:
    """The type that an error requires; for a mapping with known keys, an example."""
    if error["type"].startswith("model_"):
        for place in _schemas_at(model, error["loc"]):
            for key in place.get("required", ()):
                value, is_text = error["input"], place["properties"][key].get("type") == "string"
                example = value if is_text and isinstance(value, str) and value.isidentifier() else "..."
                return f"a mapping such as `{key}: {example}`"
    return TYPES[error["type"]]


def _said(error: ErrorDetails, place: Location, model: type[BaseModel]) -> Complaint:
    location, kind, value = error["loc"], error["type"], error["input"]
    key = str(location[-1]) if location else ""
    if kind == "extra_forbidden":
        return _of_extra(key, _schemas_at(model, location[:-1]))
    if kind == "missing" and isinstance(location[-1], int):
        kind, location = "missing_item", location[:-1]
    counts = kind in ("missing_item", "too_short", "too_long")
    length = _fixed_length(model, location) if counts else None
    if length is not None:
        return of_length(_called(place), counted(length, "item"), value)
    called = f"the name {_called(place)}" if key == "[key]" else _called(place)
    context = error.get("ctx", {})
    return (
        _of_key(kind, key, context)
        or of_kind(kind, called, _key(place), value, context)
        # Error types that no model uses yet still get a message.
        or Complaint(f"{called} to be right ({error['msg']})", shown(value), "Change it here.")
    )


def _of_key(kind: str, key: str, context: Mapping[str, Any]) -> Complaint | None:
    """The complaint about a missing key, or about one that determines which other keys exist."""
    tag = context.get("discriminator", "").strip("'")
    if kind == "union_tag_invalid":
        known = [one.strip("'") for one in context["expected_tags"].split(", ")]
        return Complaint(f"a known {tag}", repr(context["tag"]), closest(str(context["tag"]), known))
    missing = {"missing": key, "no_level": "level", "union_tag_not_found": tag}.get(kind)
    if missing is None:
        return None
    return Complaint(f"the key {missing!r}", "nothing", f"Add a line `{missing}: ...` here.")


def _fixed_length(model: type[BaseModel], location: Location) -> int | None:
    """The required length of a list; None if it is not fixed."""
    for place in _schemas_at(model, location):
        least, most = place.get("minItems"), place.get("maxItems")
        if isinstance(least, int) and least == most:
            return least
    return None


def _in_file(error: ErrorDetails, places: Collection[Location]) -> Location:
    """The error's location without pydantic's own parts (names of union members)."""
    location: Location = ()
    for part in error["loc"]:
        if (*location, part) in places:
            location = (*location, part)
    return location


def _called(place: Location) -> str:
    """Name of a value in messages: its key, or "item" of the list with that key."""
    if not place:
        return "the file"
    *before, last = place
    if isinstance(last, str):
        return last if last.isidentifier() else repr(last)
    return f"item {last + 1} of {_called(tuple(before)) if before else 'the list'}"


def _key(place: Location) -> str:
    """The key of a value, or of the list around it."""
    return next((part for part in reversed(place) if isinstance(part, str)), "")


def _of_extra(key: str, places: Sequence[Schema]) -> Complaint:
    """The complaint about a key that the model does not allow there, or only with other keys."""
    for place in places:
        if key in place.get("properties", {}):
            beside = listed(repr(other) for other in place.get("required", ()) if other != key)
            remedy = f"It goes with {beside}; leave it out." if beside else "Leave it out."
            return Complaint("a key that goes with the others here", repr(key), remedy)
    return Complaint(
        "a known key", repr(key), closest(key, {*chain(*(p.get("properties", ()) for p in places))})
    )


def _schemas_at(model: type[BaseModel], location: Location) -> list[Schema]:
    """The parts of the model's JSON schema for a value at a pydantic location."""
    schema = model.model_json_schema(by_alias=True)
    definitions = schema.get("$defs", {})
    places = list(_alternatives(schema, definitions))
    for part in location:
        found = [
            inner
            for place in places
            for below in _below(place, part)
            for inner in _alternatives(below, definitions)
        ]
        # A union member's name is in pydantic's path, but in the schema only as a discriminator value.
        places = found or [place for place in places if _is_marked(place, part)] or places
    return places


def _alternatives(place: Schema, definitions: Schema) -> Iterator[Schema]:
    if "$ref" in place:
        yield from _alternatives(definitions[place["$ref"].rsplit("/", 1)[-1]], definitions)
    yield place
    for alternative in (*place.get("anyOf", ()), *place.get("oneOf", ())):
        yield from _alternatives(alternative, definitions)


def _below(place: Schema, part: str | int) -> Iterator[Schema]:
    first = place.get("prefixItems", ())
    candidates = (
        first[part] if isinstance(part, int) and part < len(first) else None,
        place.get("properties", {}).get(part),
        place.get("additionalProperties"),
        place.get("items"),
        *place.get("patternProperties", {}).values(),
    )
    return (candidate for candidate in candidates if isinstance(candidate, Mapping))


def _is_marked(place: Schema, tag: str | int) -> bool:
    marks = place.get("properties", {}).values()
    return any(tag == mark.get("const") or tag in mark.get("enum", ()) for mark in marks)
