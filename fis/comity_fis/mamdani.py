"""Mamdani inference: how far rules hold, and the set that they give together.

`and` is min, `or` is max, a rule cuts its term off at its strength, and terms unite by max (Mamdani &
Assilian 1975; the paper's choice, MATLAB's default).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from comity_fis.centroid import Cut, exact_centroid
from comity_fis.interval import Interval
from comity_fis.methods import DUAL, MAMDANI, Methods, combined
from comity_fis.rule import And, Condition, Is, Not

Degrees = Callable[[str, str], float | None]
"""The degree of `name is term` for one person; None where the value was not disclosed."""


def strength(
    condition: Condition,
    degrees: Degrees,
    *,
    unknown: float = 1.0,
    negated: bool = False,
    methods: Methods = MAMDANI,
) -> float:
    """The degree in [0, 1] to which a condition holds.

    Args:
        condition: The antecedent of a rule, or a guard.
        degrees: What is known of the person.
        unknown: The degree of every term, and of every negated term, of a value that was not disclosed: 1
            where it is the fuzzy set that is 1 everywhere (composition-based inference), 0 where nothing may
            be presumed.
        negated: Whether the condition's opposite is meant; `not` moves inwards by De Morgan's laws.
        methods: What `and` and `or` mean.
    """
    if isinstance(condition, Is):
        degree = degrees(condition.name, condition.term)
        if degree is None:
            return unknown
        return 1.0 - degree if negated else degree
    if isinstance(condition, Not):
        return strength(condition.part, degrees, unknown=unknown, negated=not negated, methods=methods)
    parts = (
        strength(part, degrees, unknown=unknown, negated=negated, methods=methods) for part in condition.parts
    )
    method = methods.conjunction if isinstance(condition, And) else methods.disjunction
    return combined(DUAL[method] if negated else method, parts)


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


def united(strengths: Iterable[tuple[str, float]], method: str = "max") -> dict[str, float]:
    """Each term's strengths as one, at most 1; terms in the order in which they first came."""
    by_term: dict[str, list[float]] = {}
    for term, degree in strengths:
        by_term.setdefault(term, []).append(degree)
    return {term: min(1.0, combined(method, degrees)) for term, degrees in by_term.items()}
