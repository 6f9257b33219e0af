"""A desirability curve as points: its corners, or evenly spaced samples."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import combinations, pairwise

from comity_fis.defuzzification.centroid import Cut
from comity_fis.defuzzification.curve import Point

SAME = 1e-12
"""Degrees that differ by less are the same."""


def sampled(curve: Callable[[float], float], low: float, high: float, n: int) -> tuple[Point, ...]:
    """The curve at `n` evenly spaced places, both ends among them.

    Raises:
        ValueError: for fewer than two places.
    """
    if n < 2:
        raise ValueError(f"expected at least 2 points, got {n}")
    places = (low + (high - low) * i / (n - 1) for i in range(n - 1))
    return (*((x, curve(x)) for x in places), (high, curve(high)))


def corners(cuts: Sequence[Cut], low: float, high: float) -> tuple[Point, ...]:
    """Where the straight pieces of the largest of several cut trapezoids meet; a jump has two points."""
    places = {x for cut in cuts for x in _bends(cut) if low < x < high}
    points: list[Point] = []
    for x0, x1 in pairwise((low, *sorted(places), high)):
        for point in _tops([_ends(cut, x0, x1) for cut in cuts], x0, x1):
            _append(points, point)
    return tuple(points)


def _bends(cut: Cut) -> tuple[float, float, float, float]:
    """The four corners of a cut trapezoid."""
    a, b, c, d = cut.term.knots
    return a, a + cut.strength * (b - a), d - cut.strength * (d - c), d


def _ends(cut: Cut, x0: float, x1: float) -> Point:
    """A cut's degrees just inside both ends of an interval over which it is straight.

    Taken from two places inside it: at a vertical edge the end itself has another degree.
    """
    near, far = cut(x0 + (x1 - x0) / 3), cut(x0 + (x1 - x0) * 2 / 3)
    return min(max(2 * near - far, 0.0), 1.0), min(max(2 * far - near, 0.0), 1.0)


def _tops(lines: Sequence[Point], x0: float, x1: float) -> list[Point]:
    """The largest of several straight lines over [x0, x1]: its ends, and where one line overtakes another."""
    crossings = {
        (p0 - q0) / (p0 - q0 - p1 + q1)
        for (p0, p1), (q0, q1) in combinations(lines, 2)
        if (p0 - q0) * (p1 - q1) < 0
    }
    return [
        (x0 + t * (x1 - x0) if t < 1 else x1, max((p0 + t * (p1 - p0) for p0, p1 in lines), default=0.0))
        for t in (0.0, *sorted(crossings), 1.0)
    ]


def _append(points: list[Point], point: Point) -> None:
    """Add a point, and drop the one before it where it lies between its neighbours on a straight line."""
    if points and points[-1][0] == point[0] and abs(points[-1][1] - point[1]) < SAME:
        return
    if len(points) > 1:
        (x0, y0), (x1, y1) = points[-2:]
        x2, y2 = point
        if x0 < x1 < x2 and abs(y0 + (y2 - y0) * (x1 - x0) / (x2 - x0) - y1) < SAME:
            points.pop()
    points.append(point)
