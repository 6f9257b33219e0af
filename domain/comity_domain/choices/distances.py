"""Distances allowed if the target does not fit: down to the safety floor."""

from __future__ import annotations

from dataclasses import dataclass

from comity_fis.defuzzification.curve import Choice, Curve, Point
from comity_fis.inference.value import ParameterValue

SPARE_M = 0.01
"""Margin above the floor [m]: the robot rests within a centimetre of its pose, and never below the floor."""


@dataclass(frozen=True, slots=True)
class ReachingDown:
    """A desirability curve with its domain extended downwards, with desirability 0 there."""

    curve: Curve
    low: float
    """Lower end of the extended domain, in the parameter's unit."""

    @property
    def domain(self) -> tuple[float, float]:
        """The interval, in the parameter's unit."""
        return self.low, self.curve.domain[1]

    def __call__(self, x: float) -> float:
        """The desirability of one value; 0 outside the curve's own domain."""
        return self.curve(x) if x >= self.curve.domain[0] else 0.0

    def height(self, low: float, high: float) -> float:
        """The largest desirability in [low, high]."""
        return self.curve.height(low, high)

    def centroid(self, low: float, high: float) -> float | None:
        """Centroid of the area over [low, high]; None if there is no area."""
        return self.curve.centroid(low, high)

    def sample(self, n: int = 101) -> tuple[Point, ...]:
        """The curve at `n` evenly spaced values, both ends of the domain among them."""
        low, high = self.domain
        places = (low + (high - low) * k / (n - 1) for k in range(n))
        return tuple((x, self(x)) for x in places)

    @property
    def outline(self) -> tuple[Point, ...]:
        """Points of the curve as a polyline."""
        return (self.low, 0.0), (self.curve.domain[0], 0.0), *self.curve.outline


def distance_desirability(value: ParameterValue, floor_m: float) -> Curve:
    """Desirability of each distance between the bodies, over all allowed distances [m].

    If nothing else fits, the robot comes nearer than the rules suggest, down to the safety floor; but not to
    a person who asked for their distance, or showed in earlier visits which one they want.

    Args:
        value: The person's distance parameter.
        floor_m: Smallest safe distance [m].
    """
    curve = value.desirability
    if isinstance(curve, Choice):
        raise TypeError(f"{value.name} is nominal: it has no desirability over a range")
    theirs = any(part.origin in ("setting", "learnt") for part in value.contributions)
    low_m = floor_m + SPARE_M
    return curve if theirs or curve.domain[0] <= low_m else ReachingDown(curve, low_m)
