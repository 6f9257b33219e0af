"""The weighted sum of several desirability curves."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import fsum

from comity_fis.defuzzification.curve import Curve, Point
from comity_fis.defuzzification.outline import SAME, sampled


@dataclass(frozen=True, slots=True)
class MixedCurve:
    """Combined desirability for several cultures of one person.

    Heights, areas and outlines are exact for piecewise-linear curves; for other curves they use the 101
    points of the outline.
    """

    parts: tuple[tuple[float, Curve], ...]
    """Each curve with its share; the shares sum to 1."""

    @property
    def domain(self) -> tuple[float, float]:
        """The smallest interval that holds every curve's domain."""
        ends = [curve.domain for _, curve in self.parts]
        return min(low for low, _ in ends), max(high for _, high in ends)

    def __call__(self, x: float) -> float:
        """The desirability of one value."""
        return fsum(share * curve(x) for share, curve in self.parts)

    def height(self, low: float, high: float) -> float:
        """Maximum desirability in [low, high], which is at an end or at a corner of some curve."""
        start, end = self.domain
        low, high = max(low, start), min(high, end)
        if low > high:
            return 0.0
        bends = {x for _, curve in self.parts for x, _ in curve.outline if low < x < high}
        return max(self(x) for x in (low, *bends, high))

    def centroid(self, low: float, high: float) -> float | None:
        """Centroid of the area over [low, high]; None if there is no area."""
        start, end = self.domain
        low, high = max(low, start), min(high, end)
        if not low < high:
            return None
        area = moment = 0.0
        for (x0, y0), (x1, y1) in pairwise(_between(self.outline, low, high)):
            half = (x1 - x0) / 2
            area += half * (y0 + y1)
            moment += half / 3 * (y0 * (2 * x0 + x1) + y1 * (x0 + 2 * x1))
        return min(max(moment / area, low), high) if area > 0 else None

    def sample(self, n: int = 101) -> tuple[Point, ...]:
        """The curve at `n` evenly spaced values, both ends of the domain among them."""
        return sampled(self, *self.domain, n)

    @property
    def outline(self) -> tuple[Point, ...]:
        """Points of the curve as a polyline; a jump has two points at the same value."""
        lines = [(share, curve.outline) for share, curve in self.parts]
        places = sorted({x for _, points in lines for x, _ in points})
        found: list[Point] = []
        for x in places:
            before = fsum(share * _before(points, x) for share, points in lines)
            after = fsum(share * _after(points, x) for share, points in lines)
            if x > places[0]:
                found.append((x, before))
            if x < places[-1] and (x == places[0] or abs(after - before) > SAME):
                found.append((x, after))
        return tuple(found)


def _before(points: Sequence[Point], x: float) -> float:
    """The height just below a place; 0 outside the points."""
    i = bisect_left(points, x, key=lambda point: point[0])
    return _on_line(points[i - 1], points[i], x) if 0 < i < len(points) else 0.0


def _after(points: Sequence[Point], x: float) -> float:
    """The height just above a place; 0 outside the points."""
    i = bisect_right(points, x, key=lambda point: point[0])
    return _on_line(points[i - 1], points[i], x) if 0 < i < len(points) else 0.0


def _on_line(start: Point, end: Point, x: float) -> float:
    (x0, y0), (x1, y1) = start, end
    return y0 + (y1 - y0) * (x - x0) / (x1 - x0)


def _between(points: Sequence[Point], low: float, high: float) -> list[Point]:
    """The part of an outline that stands over [low, high]."""
    inside = [point for point in points if low < point[0] < high]
    return [(low, _after(points, low)), *inside, (high, _before(points, high))]
