"""The set that the rules give together, under any implication and aggregation.

`mamdani.AggregatedSet` is the special case of min and max, which has a faster centre of area.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import combinations, pairwise
from typing import NamedTuple

from comity_fis import defuzzification
from comity_fis.interval import Interval
from comity_fis.matlab_membership import Complement
from comity_fis.membership import NumericMembership, Trapezoid
from comity_fis.methods import Methods, combined
from comity_fis.peak import highest

SCAN = 8
"""Parts of the way between two knots of a curve, searched for the place where a rule cuts it off."""


class Concluded(NamedTuple):
    """An output term, and the strength in (0, 1] of one rule that concludes it."""

    term: NumericMembership
    strength: float


@dataclass(frozen=True, slots=True)
class OutputSet:
    """The desirability of a numeric parameter; every rule's conclusion counts for itself."""

    interval: Interval
    concluded: tuple[Concluded, ...]
    """At least one."""
    methods: Methods

    @property
    def domain(self) -> tuple[float, float]:
        """The interval, in the parameter's unit."""
        return self.interval.ends

    def __call__(self, x: float) -> float:
        """The desirability of one value, in [0, 1]; 0 outside the domain."""
        return min(1.0, self.degree(x)) if x in self.interval else 0.0

    def degree(self, x: float) -> float:
        """As the methods have it: `sum` is not cut off at 1."""
        return combined(self.methods.aggregation, (self._shaped(c, x) for c in self.concluded))

    def height(self, low: float, high: float) -> float:
        """The largest desirability in [low, high]; 0 where that lies outside the domain."""
        low, high = max(low, self.interval.low), min(high, self.interval.high)
        if not low < high:
            return self(low) if low == high else 0.0
        if self.methods.aggregation != "max":
            return highest(self, self._places(low, high), low, high)
        heights = (combined(self.methods.implication, (s, t.height(low, high))) for t, s in self.concluded)
        return max(heights)

    def centroid(self, low: float, high: float) -> float | None:
        """The centre of area over [low, high]; None where there is no area."""
        low, high = max(low, self.interval.low), min(high, self.interval.high)
        return defuzzification.centroid(self._surface(low, high)) if low < high else None

    def defuzzified(self) -> float | None:
        """The value by the rulebook's method, exactly (curves to 1e-9 of the range); None without area."""
        return defuzzification.EXACT[self.methods.defuzzification](self._surface(*self.domain))

    def defuzzified_from_samples(self, samples: int = 101) -> float | None:
        """MATLAB's rule: evenly spaced samples of equal weight, both ends included; None without area."""
        low, high = self.domain
        xs = [low + (high - low) * i / (samples - 1) for i in range(samples)]
        return defuzzification.SAMPLED[self.methods.defuzzification](xs, [self.degree(x) for x in xs])

    def _shaped(self, conclusion: Concluded, x: float) -> float:
        return combined(self.methods.implication, (conclusion.strength, conclusion.term(x)))

    def _surface(self, low: float, high: float) -> defuzzification.Surface:
        parts = [partial(self._shaped, conclusion) for conclusion in dict.fromkeys(self.concluded)]
        return defuzzification.Surface(
            self.degree,
            self._places(low, high),
            parts if self.methods.aggregation == "max" else [self.degree],
        )

    def _places(self, low: float, high: float) -> tuple[float, ...]:
        """Ascending, from low to high: the set is smooth between them, and straight where its terms are."""
        knots = _ascending((x for term, _ in self.concluded for x in term.knots), low, high)
        if self.methods.implication == "min":
            knots = _ascending((*knots, *self._cuts(knots)), low, high)
        if self.methods.aggregation == "max":
            knots = _ascending((*knots, *self._crossings(knots)), low, high)
        return knots

    def _cuts(self, knots: Sequence[float]) -> Iterator[float]:
        """Where rules cut their terms off."""
        for term, strength in dict.fromkeys(self.concluded):
            parts = 1 if _is_straight(term) else SCAN
            for left, right in pairwise(knots):
                between = (left + (right - left) * i / parts for i in range(1, parts))
                for x0, x1 in pairwise((left, *between, right)):
                    yield from _crossing(term, strength, x0, x1)

    def _crossings(self, knots: Sequence[float]) -> Iterator[float]:
        """Where one straight conclusion passes another; curves are left to the quadrature."""
        straight = [c for c in dict.fromkeys(self.concluded) if _is_straight(c.term)]
        for left, right in pairwise(knots):
            lines = {self._line(conclusion, left, right) for conclusion in straight}
            for (p0, p1), (q0, q1) in combinations(sorted(lines), 2):
                if (p0 - q0) * (p1 - q1) < 0:
                    yield left + (right - left) * (p0 - q0) / (p0 - q0 - p1 + q1)

    def _line(self, conclusion: Concluded, left: float, right: float) -> tuple[float, float]:
        """The degrees just inside both ends, from two places between them: an edge may be vertical there."""
        near, far = (self._shaped(conclusion, left + part * (right - left)) for part in (0.25, 0.75))
        return near - (far - near) / 2, far + (far - near) / 2


def needs_output_set(methods: Methods) -> bool:
    """Whether `mamdani.AggregatedSet` does not serve; what `and` and `or` mean does not matter here."""
    return (methods.implication, methods.aggregation, methods.defuzzification) != ("min", "max", "centroid")


def _is_straight(term: NumericMembership) -> bool:
    return isinstance(term.part if isinstance(term, Complement) else term, Trapezoid)


def _crossing(term: NumericMembership, level: float, low: float, high: float) -> Iterator[float]:
    """Where a term that is monotonous over [low, high] has a degree, by bisection."""
    rises = term(high) > term(low)
    if not min(term(low), term(high)) < level < max(term(low), term(high)):
        return
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if (term(middle) < level) is rises else (low, middle)
    yield (low + high) / 2


def _ascending(places: Iterator[float] | Sequence[float], low: float, high: float) -> tuple[float, ...]:
    return low, *sorted({x for x in places if low < x < high}), high
