"""A desirability curve that moved along with its value."""

from __future__ import annotations

from dataclasses import dataclass

from comity_fis.defuzzification.curve import Curve, Point
from comity_fis.defuzzification.outline import sampled
from comity_fis.membership.interval import Interval


@dataclass(frozen=True, slots=True)
class MovedCurve:
    """Another curve, moved along its axis as far as limits allow."""

    curve: Curve
    by: float
    """In the parameter's unit."""
    limits: Interval
    """What may be asked for and is safe: beyond it nothing is desirable."""

    @property
    def domain(self) -> tuple[float, float]:
        """The interval, in the parameter's unit."""
        low, high = self.curve.domain
        return self.limits.clamp(low + self.by), self.limits.clamp(high + self.by)

    def __call__(self, x: float) -> float:
        """The desirability of one value; 0 outside the domain."""
        low, high = self.domain
        return self.curve(self._before(x)) if low <= x <= high else 0.0

    def height(self, low: float, high: float) -> float:
        """The largest desirability in [low, high]; 0 where that lies outside the domain."""
        low, high = max(low, self.domain[0]), min(high, self.domain[1])
        return self.curve.height(self._before(low), self._before(high)) if low <= high else 0.0

    def centroid(self, low: float, high: float) -> float | None:
        """The centre of area over [low, high]; None where there is no area."""
        low, high = max(low, self.domain[0]), min(high, self.domain[1])
        centre = self.curve.centroid(self._before(low), self._before(high)) if low < high else None
        return None if centre is None else min(max(centre + self.by, low), high)

    def sample(self, n: int = 101) -> tuple[Point, ...]:
        """The curve at `n` evenly spaced values, both ends of the domain among them."""
        return sampled(self, *self.domain, n)

    @property
    def outline(self) -> tuple[Point, ...]:
        """Points that straight lines join to the curve."""
        low, high = self.domain
        inside = [(x + self.by, y) for x, y in self.curve.outline if low < x + self.by < high]
        return (low, self(low)), *inside, (high, self(high))

    def _before(self, x: float) -> float:
        """Where a value was before the move; rounding takes no end of the domain out of it."""
        low, high = self.curve.domain
        return min(max(x - self.by, low), high)


def upper_limit(curve: Curve, otherwise: float) -> float:
    """The largest value that a curve's limits allow; at most `otherwise`, which holds without limits."""
    return min(otherwise, curve.limits.high) if isinstance(curve, MovedCurve) else otherwise
