"""What is known of one variable: checked values, rough ones, and facts that differ between cultures."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import isfinite
from typing import Any

from comity_fis.errors import InputError
from comity_fis.inference.rough import Rough, RoughNumber, RoughWord, Stated, largest_of_smallest
from comity_fis.listing import listed
from comity_fis.membership.function import Membership
from comity_fis.membership.interval import Interval
from comity_fis.variables.variable import NominalVariable, NumericVariable, Variable


@dataclass(frozen=True, slots=True)
class MixedFact:
    """What is known of one variable, culture by culture; no inference takes it as an input."""

    parts: tuple[tuple[str, float, Stated | None], ...]
    """Culture, its share in (0, 1], and the value there; None where it is not disclosed."""

    def as_json(self) -> object:
        """The parts as a list."""
        return {
            "mixed": [
                {
                    "part": name,
                    "share": share,
                    "value": value
                    if value is None or isinstance(value, float | int | str)
                    else value.as_json(),
                }
                for name, share, value in self.parts
            ]
        }

    def __str__(self) -> str:
        return listed(
            f"{'not disclosed' if value is None else _shown(value)} ({name}, {share:.0%})"
            for name, share, value in self.parts
        )


Known = Stated | MixedFact
"""What an inference knows of one variable; a mixed fact where it was combined from several."""


def known(variable: Variable, value: object) -> Stated | None:
    """What a caller stated, checked; None where it excludes nothing and so says nothing.

    Args:
        variable: What it is about.
        value: A number or a category; or, roughly, an `Interval` or two numbers, a membership function, a
            mapping of categories to degrees.

    Raises:
        InputError: if it cannot be a value of the variable.
    """
    if isinstance(value, float | int | str):
        return variable.check(value)
    if isinstance(value, Rough):
        value = value.given
    if isinstance(variable, NominalVariable):
        return _words(variable, value) if isinstance(value, Mapping) else variable.check(value)
    if isinstance(value, list | tuple) and len(value) == 2:
        low, high = (variable.check(end) for end in value)
        if low >= high:
            return low if low == high else variable.check(value)
        value = Interval(low, high)
    if isinstance(value, Interval):
        return _interval(variable, value)
    if isinstance(value, Membership):
        return _fuzzy_set(variable, value)
    return variable.check(value)


def _interval(variable: NumericVariable, value: Interval) -> Stated | None:
    low, high = variable.check(value.low), variable.check(value.high)
    return None if value.covers(variable.domain) else RoughNumber(value, low, high)


def _fuzzy_set(variable: NumericVariable, value: Membership) -> Stated | None:
    low, high = variable.domain.ends
    if not largest_of_smallest([value], value.knots, low, high) > 0:
        raise InputError(
            expected=f"a fuzzy set of {variable.name} that is above 0 somewhere in {variable.domain}",
            got=str(value),
            remedy="Leave it out where nothing is known.",
        )
    excludes = largest_of_smallest([lambda x: 1.0 - value(x)], value.knots, low, high)
    return RoughNumber(value, low, high) if excludes > 0 else None


def _words(variable: NominalVariable, degrees: Mapping[Any, object]) -> Stated | None:
    given: dict[str, float] = {}
    for category, degree in degrees.items():
        if not isinstance(degree, float | int) or not (isfinite(degree) and 0 <= degree <= 1):
            raise InputError(
                expected=f"a degree in 0..1 for {variable.name} {category}",
                got=repr(degree),
                remedy="Write 1 for what is fully possible, 0 for what is not.",
            )
        given[variable.check(category)] = float(degree)
    possible = {category: degree for category, degree in given.items() if degree > 0}
    if not possible:
        raise InputError(
            expected=f"at least one category of {variable.name} that is possible",
            got=repr(dict(degrees)),
            remedy="Leave it out where nothing is known.",
        )
    if possible.keys() >= set(variable.categories) and min(possible.values()) == 1:
        return None
    only = next(iter(possible))
    return only if possible == {only: 1.0} else RoughWord(possible)


def _shown(value: Stated) -> str:
    return f"{value:g}" if isinstance(value, float | int) else str(value)
