"""Lazy records: the rest of their fields is computed when the first of them is read.

A plan needs its steps, and seldom all of the why: texts and alternatives wait until a person asks for them.
To its reader such a record is frozen like any other.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

Record = TypeVar("Record", bound="LazyRecord")


class LazyRecord:
    """Base of a frozen, slotted dataclass whose records may be made with some of their fields only.

    The others are computed together when the first of them is read. Threads compute the same.
    """

    __slots__ = ("_whole",)
    _whole: Callable[[], Any]

    @classmethod
    def lazy(cls: type[Record], whole: Callable[[], Record], **fields: object) -> Record:
        """A record with some fields.

        Args:
            whole: Makes the record with all fields, those given here among them; it must not depend on
                anything that changes.
            fields: By name.
        """
        record = object.__new__(cls)
        object.__setattr__(record, "_whole", whole)
        for name, value in fields.items():
            object.__setattr__(record, name, value)
        return record

    if not TYPE_CHECKING:  # a type checker shall know only the fields

        def __getattr__(self, name: str) -> Any:
            """A field that is still empty; Python asks here for nothing else that exists."""
            if name not in type(self).__slots__:
                raise AttributeError(f"{type(self).__name__} has no {name}", name=name, obj=self)
            whole = self._whole()
            for field in type(self).__slots__:
                object.__setattr__(self, field, getattr(whole, field))
            return getattr(whole, name)
