"""Overlay of a factor's value over a scenario."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from comity_fis import InputError


def laid_over(data: Any, keys: Sequence[str], value: Any) -> Any:
    """Copy of the data with another value at one place; the input is unchanged.

    Args:
        data: Mappings, lists and scalars.
        keys: Path to the place; a number is the index of an item, from 0. A missing mapping is created.
        value: The new value.

    Raises:
        InputError: if the path leads through a value that has no children.
    """
    key, *rest = keys
    if isinstance(data, Mapping):
        within = data.get(key)
        if within is None and rest and rest[0].isdecimal():
            raise InputError(
                expected=f"a list `{key}` with an item {rest[0]}",
                got=f"none: the scenario has no `{key}`",
                remedy="Name a key that it has, or write the list into the scenario.",
            )
        return {**data, key: laid_over({} if within is None else within, rest, value) if rest else value}
    if isinstance(data, list) and key.isdecimal() and int(key) < len(data):
        i = int(key)
        return [*data[:i], laid_over(data[i], rest, value) if rest else value, *data[i + 1 :]]
    what = f"a list of {len(data)} items" if isinstance(data, list) else repr(data)
    raise InputError(
        expected=f"a mapping, or a list with an item {key}, on the way to this key",
        got=what,
        remedy="`comity schema scenario` prints which keys there are.",
    )
