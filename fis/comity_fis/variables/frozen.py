"""An immutable mapping that is as fast as a dictionary, because it is one."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NoReturn, TypeVar

Key = TypeVar("Key")
Value = TypeVar("Value")


class FrozenDict(dict[Key, Value]):
    """An immutable dictionary for rulebooks: threads share them, so a change would affect other people."""

    __slots__ = ()

    def _refuse(self, *_: object, **__: object) -> NoReturn:
        raise TypeError("a rulebook does not change: build another one, or use with_rule")

    if not TYPE_CHECKING:  # hidden from type checkers, for which this is a read-only mapping
        __setitem__ = __delitem__ = __ior__ = _refuse
        clear = pop = popitem = setdefault = update = _refuse

    def __reduce__(self) -> tuple[Any, ...]:
        """Support copying and pickling."""
        return FrozenDict, (dict(self),)


def freeze(record: object, **fields: Mapping[Any, Any]) -> None:
    """Freeze mappings in a frozen dataclass; call this in its `__post_init__`."""
    for name, mapping in fields.items():
        object.__setattr__(record, name, FrozenDict(mapping))
