"""Records: frozen dataclasses that JSON holds as they stand, key by key."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import Field, fields, is_dataclass
from datetime import date
from functools import cache
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar, cast

if TYPE_CHECKING:
    from pydantic import TypeAdapter

R = TypeVar("R", bound="Record")


def key_of(field: str) -> str:
    """The key of a field: its name, without the `_` behind a word that Python keeps for itself."""
    return field.removesuffix("_")


class Record:
    """Base of a frozen dataclass whose fields are the keys of a JSON object, in their order.

    The docstring below a field is its description in the JSON schema. What such an object holds beyond the
    fields is refused where one is read, and so is a number that is not finite.
    """

    __slots__ = ()
    if TYPE_CHECKING:
        __dataclass_fields__: ClassVar[dict[str, Field[Any]]]
    __pydantic_config__: ClassVar = {"extra": "forbid", "allow_inf_nan": False, "alias_generator": key_of}


def plain(value: object) -> Any:
    """A record, or what one may hold, as `json.dumps` takes it."""
    if is_dataclass(value):
        return {key_of(field.name): plain(getattr(value, field.name)) for field in fields(value)}
    if isinstance(value, Mapping):
        return {key: plain(content) for key, content in value.items()}
    if isinstance(value, tuple | list):
        return [plain(one) for one in value]
    return value.isoformat() if isinstance(value, date) else value


def as_text(record: Record) -> str:
    """The JSON of a record, as it is written to a file.

    Raises:
        ValueError: It holds a number that is not finite.
    """
    return json.dumps(plain(record), indent=2, ensure_ascii=False, allow_nan=False) + "\n"


def reader(kind: type[R]) -> TypeAdapter[R]:
    """What reads records of a kind from JSON, and makes their JSON schema."""
    found: TypeAdapter[R] = _reader(cast("Any", kind))
    return found


@cache
def _reader(kind: Any) -> TypeAdapter[Any]:
    from pydantic import TypeAdapter

    return TypeAdapter(kind)
