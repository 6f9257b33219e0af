"""Inputs that are known only roughly: an interval, a fuzzy set of numbers, categories with degrees.

Such an input is itself a fuzzy set A, and a term holds to the degree to which it meets A: the largest of
min(term, A) over the domain, the possibility of the term (Zadeh 1978). A value that was not disclosed is the
case in which A is 1 everywhere.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import isfinite
from typing import Any

from comity_fis.errors import InputError
from comity_fis.inference.mixed_fact import MixedFact
from comity_fis.membership.function import Categories, Membership
from comity_fis.membership.interval import Interval
from comity_fis.rules.antecedent import Modified
from comity_fis.variables.variable import NominalVariable, NumericVariable, Variable

Function = Callable[[float], float]


@dataclass(frozen=True, slots=True)
class RoughNumber:
    """A fuzzy set of numbers, cut off at the ends of its variable's domain."""

    given: Interval | Membership
    low: float
    high: float

    def possibility(self, term: Membership, exponent: float, negated: bool) -> float:
        """The degree of a term of the variable, hedged by the exponent, perhaps negated."""
        literal = Modified(term, exponent, negated)
        if isinstance(self.given, Interval):
            return _largest([literal], term.knots, self.low, self.high)
        return _largest([literal, self.given], (*term.knots, *self.given.knots), self.low, self.high)

    def as_json(self) -> object:
        """An interval as its two ends, another fuzzy set in words."""
        return list(self.given.ends) if isinstance(self.given, Interval) else str(self.given)

    def __str__(self) -> str:
        return str(self.given)


@dataclass(frozen=True, slots=True)
class RoughWord:
    """Categories, each with the degree to which it is possible."""

    given: Mapping[str, float]

    def possibility(self, term: Categories, exponent: float, negated: bool) -> float:
        """The degree of a term of the variable, hedged by the exponent, perhaps negated."""
        literal = Modified(term, exponent, negated)
        return max(min(literal(category), possible) for category, possible in self.given.items())

    def as_json(self) -> object:
        """Categories with their degrees."""
        return dict(self.given)

    def __str__(self) -> str:
        return " or ".join(f"{category} ({degree:g})" for category, degree in self.given.items())


Rough = RoughNumber | RoughWord
ROUGH = (RoughNumber, RoughWord)
"""The types of it: a check against them is quicker than against their union."""
Stated = float | str | RoughNumber | RoughWord
"""What a rulebook can be told of one variable."""

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
    if not _largest([value], value.knots, low, high) > 0:
        raise InputError(
            expected=f"a fuzzy set of {variable.name} that is above 0 somewhere in {variable.domain}",
            got=str(value),
            remedy="Leave it out where nothing is known.",
        )
    excludes = _largest([lambda x: 1.0 - value(x)], value.knots, low, high)
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


def _largest(functions: Sequence[Function], knots: Sequence[float], low: float, high: float) -> float:
    """The largest value over [low, high] of the smallest of the functions, to 1e-12 of a gap between knots.

    Between its own extremes a function only rises or only falls, and the smallest of such functions has one
    peak: golden-section search finds it.
    """
    places = [low, *sorted({x for x in knots if low < x < high}), high]
    for function in functions:
        turns = {
            turn
            for left, right in pairwise(places)
            for sign in (1, -1)
            for turn in (_turn(function, sign, left, right),)
            if left < turn < right
        }
        places = sorted({*places, *turns})

    def smallest(x: float) -> float:
        return min(function(x) for function in functions)

    peaks = (_turn(smallest, 1, left, right) for left, right in pairwise(places))
    return max(smallest(x) for x in (*places, *peaks))


def _turn(function: Function, sign: int, low: float, high: float) -> float:
    """Where the function (its opposite for sign -1) is largest, if it has one peak at most."""
    ratio = (5**0.5 - 1) / 2
    for _ in range(60):  # 0.618^60 is below 1e-12
        left, right = high - ratio * (high - low), low + ratio * (high - low)
        low, high = (low, right) if sign * function(left) >= sign * function(right) else (left, high)
    return (low + high) / 2
