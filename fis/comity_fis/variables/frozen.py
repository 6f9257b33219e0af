"""A mapping that nobody can change, looked up as fast as a dictionary: it is one."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NoReturn, TypeVar

Key = TypeVar("Key")
Value = TypeVar("Value")


class FrozenDict(dict[Key, Value]):
    """What a rulebook is made of: threads share it, so that a change would change other people's answers."""

    __slots__ = ()

    def _refuse(self, *_: object, **__: object) -> NoReturn:
        raise TypeError("a rulebook does not change: build another one, or use with_rule")

    if not TYPE_CHECKING:  # a type checker shall know a mapping, which has none of these
        __setitem__ = __delitem__ = __ior__ = _refuse
        clear = pop = popitem = setdefault = update = _refuse

    def __reduce__(self) -> tuple[Any, ...]:
        """How a copy is made, here or in another process."""
        return FrozenDict, (dict(self),)


def freeze(record: object, **fields: Mapping[Any, Any]) -> None:
    """Put mappings into a frozen dataclass such that nobody can change them; for its `__post_init__`."""
    for name, mapping in fields.items():
        object.__setattr__(record, name, FrozenDict(mapping))
