"""Membership functions: the degree in [0, 1] to which a value belongs to a linguistic term."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from math import exp, inf, isfinite
from typing import Protocol, runtime_checkable

from comity_fis.errors import WrongValueError
from comity_fis.membership.curved import Curved
from comity_fis.membership.interval import Interval
from comity_fis.membership.turns import crossing, largest, turning_places


@runtime_checkable
class Membership(Protocol):
    """A fuzzy set over the real numbers."""

    def __call__(self, x: float) -> float:
        """Degree of `x`, in [0, 1]."""
        ...

    def height(self, low: float, high: float) -> float:
        """The largest degree in [low, high]."""
        ...

    @property
    def knots(self) -> tuple[float, ...]:
        """Ascending points between which the function is smooth; quadrature starts from them."""
        ...


@dataclass(frozen=True, slots=True)
class Trapezoid:
    """Rises over [a, b], is 1 over [b, c], falls over [c, d]; a = b or c = d is a shoulder."""

    a: float
    b: float
    c: float
    d: float

    def __post_init__(self) -> None:
        if not (isfinite(self.a) and isfinite(self.d) and self.a <= self.b <= self.c <= self.d):
            raise WrongValueError(expected="four finite corners that never decrease", got=self.knots)
        if self.a == self.d:
            raise WrongValueError(
                expected="corners that leave the trapezoid some width",
                got=self.knots,
                remedy=f"For the one value alone write `singleton: {self.a:g}`.",
            )

    def __call__(self, x: float) -> float:
        """Degree of `x`, in [0, 1]."""
        if self.b <= x <= self.c:
            return 1.0
        if x <= self.a or x >= self.d:
            return 0.0
        if x < self.b:
            return (x - self.a) / (self.b - self.a)
        return (self.d - x) / (self.d - self.c)

    def height(self, low: float, high: float) -> float:
        """The largest degree in [low, high]."""
        return 1.0 if low <= self.c and high >= self.b else max(self(low), self(high))

    @property
    def knots(self) -> tuple[float, ...]:
        """The four corners."""
        return self.a, self.b, self.c, self.d

    @property
    def turns(self) -> tuple[float, ...]:
        """The four corners."""
        return self.knots


@dataclass(frozen=True, slots=True)
class Singleton:
    """1 at one value and 0 elsewhere: the constant that a zero-order Sugeno rule concludes."""

    place: float

    def __post_init__(self) -> None:
        if not isfinite(self.place):
            raise WrongValueError(expected="a singleton at a finite place", got=self.place)

    def __call__(self, x: float) -> float:
        """Degree of `x`, 0 or 1."""
        return 1.0 if x == self.place else 0.0

    def height(self, low: float, high: float) -> float:
        """The largest degree in [low, high]."""
        return 1.0 if low <= self.place <= high else 0.0

    @property
    def knots(self) -> tuple[float, ...]:
        """The value."""
        return (self.place,)

    @property
    def turns(self) -> tuple[float, ...]:
        """The value."""
        return (self.place,)


@dataclass(frozen=True, slots=True)
class Bump:
    """`height * exp(-((x - centre) / width)^2)`: without the factor 2 of a normal density."""

    height: float
    centre: float
    width: float

    def __post_init__(self) -> None:
        if not (0 <= self.height < inf and isfinite(self.centre) and 0 < self.width < inf):
            raise WrongValueError(
                expected="a height of at least 0, a finite centre and a width above 0", got=self
            )

    def __call__(self, x: float) -> float:
        """Height of the bump at `x`."""
        off = (x - self.centre) / self.width
        return self.height * exp(-off * off)


@dataclass(frozen=True, slots=True)
class TwoTermGaussian:
    """The sum of two bumps, clipped at 1: the shape that the paper fits to its clusters.

    Heights are at least 0: a negative one fits the c-means memberships better, but yields negative degrees.
    """

    first: Bump
    second: Bump

    def __call__(self, x: float) -> float:
        """Degree of `x`, in [0, 1]."""
        return min(self.first(x) + self.second(x), 1.0)

    def height(self, low: float, high: float) -> float:
        """The largest degree in [low, high]."""
        return largest(self, self.turns, low, high)

    @property
    def knots(self) -> tuple[float, ...]:
        """Both centres, points up to three widths from them in steps of half a width, and the kinks.

        Kinks are where the sum is clipped at 1.
        """
        bumps = (self.first, self.second)
        places = {bump.centre + k / 2 * bump.width for bump in bumps for k in range(-6, 7)}
        if self.first.height + self.second.height > 1:
            places.update(_cut_off(self))
        return tuple(sorted(places))

    @property
    def turns(self) -> tuple[float, ...]:
        """The knots and the local extrema between them."""
        return _turns(self)


@lru_cache(maxsize=1024)
def _cut_off(term: TwoTermGaussian) -> tuple[float, ...]:
    """The points where the sum of the bumps crosses 1."""
    bumps = (term.first, term.second)

    def excess(x: float) -> float:
        return sum(bump(x) for bump in bumps) - 1

    # Six widths from its centre a bump is at 2e-16 of its height: no sum crosses 1 beyond.
    knots = sorted({bump.centre + k / 2 * bump.width for bump in bumps for k in range(-12, 13)})
    places = turning_places(excess, knots)
    return tuple(crossing(excess, a, b) for a, b in pairwise(places) if (excess(a) > 0) != (excess(b) > 0))


@lru_cache(maxsize=1024)
def _turns(term: TwoTermGaussian) -> tuple[float, ...]:
    return turning_places(term, term.knots)


@dataclass(frozen=True, slots=True)
class Complement:
    """`1 - part`: the conclusion of a negative index in a consequent."""

    part: NumericMembership

    def __call__(self, x: float) -> float:
        """Degree of `x`, in [0, 1]."""
        return 1.0 - self.part(x)

    def height(self, low: float, high: float) -> float:
        """The largest degree in [low, high]."""
        return largest(self, self.turns, low, high)

    @property
    def knots(self) -> tuple[float, ...]:
        """The knots of the part."""
        return self.part.knots

    @property
    def turns(self) -> tuple[float, ...]:
        """The extrema of the part."""
        return self.part.turns


NumericMembership = Trapezoid | Singleton | TwoTermGaussian | Curved | Complement
"""The shapes that a rulebook can declare over numbers."""


@dataclass(frozen=True, slots=True)
class Categories:
    """A crisp set of categories: the term of a nominal variable."""

    members: frozenset[str]

    def __call__(self, category: str) -> float:
        """1 for a member, 0 otherwise."""
        return 1.0 if category in self.members else 0.0


def everywhere(domain: Interval) -> Trapezoid:
    """The universal set: 1 on the whole domain, for an unknown value."""
    return Trapezoid(domain.low, domain.low, domain.high, domain.high)


def is_straight(term: NumericMembership) -> bool:
    """Whether a membership function is piecewise linear."""
    return isinstance(term.part if isinstance(term, Complement) else term, Trapezoid | Singleton)
