"""Mamdani inference: the set that rules give together.

A rule cuts its term off at its strength, and terms unite by max (Mamdani & Assilian 1975; the paper's choice,
MATLAB's default).
"""

from __future__ import annotations

from dataclasses import dataclass

from comity_fis.defuzzification.centroid import Cut, exact_centroid
from comity_fis.defuzzification.curve import Point
from comity_fis.defuzzification.outline import corners, sampled
from comity_fis.membership.function import Trapezoid
from comity_fis.membership.interval import Interval


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
