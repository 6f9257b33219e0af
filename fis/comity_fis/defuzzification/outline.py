"""A desirability curve as points: its corners, or evenly spaced samples."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING

from comity_fis.defuzzification.curve import Point

if TYPE_CHECKING:
    from comity_fis.defuzzification.panels import Panels

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


def corners(panels: Panels) -> tuple[Point, ...]:
    """Where the straight pieces of one person's set meet; a jump has two points."""
    points: list[Point] = []
    for point in _ends(panels):
        _append(points, point)
    return tuple(points)


def _ends(panels: Panels) -> Iterable[Point]:
    """Both ends of each panel with the degrees just inside, and the tops of spikes between them.

    Taken from two places inside: at a vertical edge the end itself has another degree.
    """
    third = (panels.right - panels.left) / 3
    near, far = (panels.sets.at(panels.person, x) for x in (panels.left + third, panels.right - third))
    degrees = ((2 * one - other).clip(0.0, 1.0).tolist() for one, other in ((near, far), (far, near)))
    ends = (panels.left.tolist(), panels.right.tolist())
    tops = panels.sets.at(panels.person, panels.left).clip(0.0, 1.0).tolist()
    before = 0.0
    for left, right, at_left, at_right, top in zip(*ends, *degrees, tops, strict=True):
        if top > max(before, at_left) + SAME:
            yield left, top
        yield left, at_left
        yield right, at_right
        before = at_right
    last = float(panels.sets.at(panels.person[-1:], panels.right[-1:])[0])
    if last > before + SAME:
        yield float(panels.right[-1]), min(1.0, last)


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
