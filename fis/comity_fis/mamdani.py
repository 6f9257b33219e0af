"""Mamdani inference: how far rules hold, and the set that they give together.

`and` is min, `or` is max, a rule cuts its term off at its strength, and terms unite by max (Mamdani &
Assilian 1975; the paper's choice, MATLAB's default).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from comity_fis.centroid import Cut, exact_centroid
from comity_fis.curve import Point
from comity_fis.interval import Interval
from comity_fis.membership import Trapezoid
from comity_fis.outline import corners, sampled
from comity_fis.rule import And, Condition, Is, Not

Degrees = Callable[[str, str], float | None]
"""The degree of `name is term` for one person; None where the value was not disclosed."""


def strength(condition: Condition, degrees: Degrees, *, unknown: float = 1.0, negated: bool = False) -> float:
    """The degree in [0, 1] to which a condition holds.

    Args:
        condition: The antecedent of a rule, or a guard.
        degrees: What is known of the person.
        unknown: The degree of every term, and of every negated term, of a value that was not disclosed: 1
            where it is the fuzzy set that is 1 everywhere (composition-based inference), 0 where nothing may
            be presumed.
        negated: Whether the condition's opposite is meant; `not` moves inwards by De Morgan's laws.
    """
    if isinstance(condition, Is):
        degree = degrees(condition.name, condition.term)
        if degree is None:
            return unknown
        return 1.0 - degree if negated else degree
    if isinstance(condition, Not):
        return strength(condition.part, degrees, unknown=unknown, negated=not negated)
    parts = (strength(part, degrees, unknown=unknown, negated=negated) for part in condition.parts)
    return min(parts) if isinstance(condition, And) is not negated else max(parts)


def holds(guard: Condition, degrees: Degrees) -> bool:
    """Whether a guard holds fully; what is unknown never satisfies it: consent is not presumed."""
    return strength(guard, degrees, unknown=0.0) >= 1.0


@dataclass(frozen=True, slots=True)
class AggregatedSet:
    """The desirability of a numeric parameter: the largest of its terms, each cut off at its strength."""

    interval: Interval
    cuts: tuple[Cut, ...]

    @property
    def domain(self) -> tuple[float, float]:
        """The interval, in the parameter's unit."""
        return self.interval.ends

    def __call__(self, x: float) -> float:
        """The desirability of one value; 0 outside the domain."""
        if x not in self.interval:
            return 0.0
        return max((cut(x) for cut in self.cuts), default=0.0)

    def height(self, low: float, high: float) -> float:
        """The largest desirability in [low, high]; 0 where that lies outside the domain."""
        low, high = max(low, self.interval.low), min(high, self.interval.high)
        if low > high:
            return 0.0
        return max((min(cut.strength, cut.term.height(low, high)) for cut in self.cuts), default=0.0)

    def centroid(self, low: float, high: float) -> float | None:
        """The centre of area over [low, high], exactly; None where there is no area."""
        return exact_centroid(self.cuts, max(low, self.interval.low), min(high, self.interval.high))

    def sample(self, n: int = 101) -> tuple[Point, ...]:
        """The desirability at `n` evenly spaced values, both ends of the domain among them."""
        return sampled(self, *self.interval.ends, n)

    @property
    def outline(self) -> tuple[Point, ...]:
        """Points that straight lines join to the curve; its corners where every term is straight."""
        if all(isinstance(cut.term, Trapezoid) for cut in self.cuts):
            return corners(self.cuts, *self.interval.ends)
        return self.sample()


def largest(strengths: Iterable[tuple[str, float]]) -> dict[str, float]:
    """Max aggregation: each term's largest strength, terms in the order in which they first came."""
    best: dict[str, float] = {}
    for term, degree in strengths:
        best[term] = max(degree, best.get(term, 0.0))
    return best
