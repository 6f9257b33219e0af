"""Single values as tables have them: scalars of numpy and pandas, and what these call missing."""

from __future__ import annotations

from collections.abc import Iterable
from math import isnan
from typing import Any, TypeGuard

from comity_fis.errors import InputError, shown

MISSING = frozenset({"NAType", "NaTType", "MaskedConstant"})
"""Types whose only value means that there is none: pandas' NA and NaT, numpy's masked."""


def scalar(value: Any) -> Any:
    """A value as plain Python has it: the number in a scalar of numpy, None for NaN and what else is missing.

    Anything else is given back as it is.
    """
    if isinstance(value, float):
        return None if isnan(value) else value
    if isinstance(value, str | int):
        return value
    if type(value).__name__ in MISSING:
        return None
    if getattr(value, "ndim", None) == 0 and callable(item := getattr(value, "item", None)):
        return scalar(item())
    return value


def is_number(value: object) -> TypeGuard[int | float]:
    """Whether a value is a number; True and False are none."""
    return isinstance(value, int | float) and not isinstance(value, bool)


def by_name(told: Any, what: str = "facts by the name of a variable") -> Iterable[Any]:
    """The names in a dictionary, or in a row or table of pandas.

    Raises:
        InputError: if it is nothing of the kind.
    """
    if not callable(getattr(told, "keys", None)) or not hasattr(told, "__getitem__"):
        raise InputError(
            expected=what, got=shown(told), remedy="Give a dictionary, an empty one where nothing is known."
        )
    names: Iterable[Any] = told.keys()
    return names
