"""A route as the robot drives it: straight lines joined by arcs, with the speed that its bends allow."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from comity_sim2d.pose import XY

ARC_RADII_M = (1.6, 0.8, 0.4, 0.3, 0.2, 0.1)
"""Tried from the widest: the wider a bend, the faster it can be driven."""
ARC_STEP_RAD = math.radians(3.0)
ARC_STEP_M = 0.02
SAME_M = 1e-6


@dataclass(frozen=True)
class Route:
    """A way from its first point to its last. Not empty, but start and goal may be the same point."""

    points: tuple[XY, ...]
    """Corner points; bends are so many short pieces."""

    @cached_property
    def _at(self) -> NDArray[np.float64]:
        return np.array(self.points)

    @cached_property
    def _legs(self) -> NDArray[np.float64]:
        return np.diff(self._at, axis=0)

    @cached_property
    def _marks(self) -> NDArray[np.float64]:
        """The way gone at every point [m]."""
        return np.concatenate([[0.0], np.cumsum(np.hypot(self._legs[:, 0], self._legs[:, 1]))])

    @property
    def goal(self) -> XY:
        """Where it leads."""
        return self.points[-1]

    @cached_property
    def length_m(self) -> float:
        """All of the way."""
        return sum(math.dist(one, other) for one, other in pairwise(self.points))

    @cached_property
    def last_leg_m(self) -> float:
        """The way gone where its last straight line begins."""
        return float(self._marks[-2])

    def at(self, way_m: float) -> XY:
        """The point after so much of the way."""
        i, rest = self._leg(way_m)
        (x, y), (dx, dy) = self.points[i], self._direction(i)
        return (x + rest * dx, y + rest * dy)

    def direction(self, way_m: float) -> XY:
        """The unit vector along the way there."""
        return self._direction(self._leg(way_m)[0])

    def nearest(self, xy: XY, low_m: float, high_m: float) -> float:
        """The way gone at the point of the route nearest to a place, searched between two marks."""
        to_place = np.array(xy) - self._at[:-1]
        length = np.diff(self._marks)
        along = np.einsum("ij,ij->i", to_place, self._legs) / np.maximum(length, 1e-12)
        first = np.maximum(low_m - self._marks[:-1], 0.0)
        last = np.minimum(high_m - self._marks[:-1], length)
        along = np.clip(along, first, np.maximum(last, first))
        foot = self._at[:-1] + self._legs * (along / np.maximum(length, 1e-12))[:, None]
        gap = np.hypot(*(foot - np.array(xy)).T)
        gap[(first > length) | (last < 0.0)] = np.inf
        best = int(np.argmin(gap))
        return float(self._marks[best] + along[best])

    def bend_limit(self, way_m: float, turning: float, braking: float) -> float:
        """The speed from which every bend ahead can still be taken.

        Args:
            way_m: The way gone.
            turning: The acceleration for changing direction [m/s^2]: v = sqrt(turning * radius) in a bend.
            braking: The deceleration before it [m/s^2].
        """
        ahead = self._marks[1:-1] - way_m
        square = turning / self._bends + 2.0 * braking * np.maximum(ahead, 0.0)
        return math.sqrt(float(np.min(square[ahead >= -ARC_STEP_M], initial=np.inf)))

    @cached_property
    def _bends(self) -> NDArray[np.float64]:
        """Curvature at every inner point [1/m]; a sharp corner counts as a bend `2 * ARC_STEP_M` long."""
        angle = np.arctan2(self._legs[:, 1], self._legs[:, 0])
        turn = np.abs((np.diff(angle) + np.pi) % (2 * np.pi) - np.pi)
        length = np.diff(self._marks)
        around = np.clip((length[:-1] + length[1:]) / 2, 1e-3, 2 * ARC_STEP_M)
        return np.maximum(turn / around, 1e-9)

    def _leg(self, way_m: float) -> tuple[int, float]:
        marks = self._mark_list
        i = min(max(bisect_right(marks, way_m) - 1, 0), len(marks) - 2)
        return i, min(max(way_m - marks[i], 0.0), marks[i + 1] - marks[i])

    @cached_property
    def _mark_list(self) -> list[float]:
        marks: list[float] = self._marks.tolist()
        return marks

    def _direction(self, leg: int) -> XY:
        return _unit(self.points[leg], self.points[leg + 1])


def round_corners(points: list[XY], is_clear: Callable[[list[XY]], bool]) -> Route:
    """Replace the corners of a way by the widest arcs that are clear and fit between their neighbours.

    The corners of offset obstacles lie outside the true, round offset: an arc with the offset's radius fits.
    """
    rounded = [points[0]]
    for before, corner, after in zip(points, points[1:], points[2:], strict=False):
        arc = _round(before, corner, after, is_clear)
        rounded.extend(arc[math.dist(rounded[-1], arc[0]) < SAME_M :])  # two arcs may meet in one point
    return Route((*rounded, points[-1]))


def _round(before: XY, corner: XY, after: XY, is_clear: Callable[[list[XY]], bool]) -> list[XY]:
    arrive, leave = _unit(before, corner), _unit(corner, after)
    turn = math.atan2(
        arrive[0] * leave[1] - arrive[1] * leave[0], arrive[0] * leave[0] + arrive[1] * leave[1]
    )
    longest = min(math.dist(before, corner), math.dist(corner, after)) / 2
    tangent = math.tan(abs(turn) / 2)
    if tangent < 1e-6:
        return [corner]
    for radius in (min(r, longest / tangent) for r in ARC_RADII_M):
        arc = _arc(corner, arrive, turn, radius)
        if is_clear(arc):
            return arc
    return [corner]


def _arc(corner: XY, arrive: XY, turn: float, radius: float) -> list[XY]:
    """Points of the arc of that radius that touches both lines through a corner."""
    side = math.copysign(1.0, turn)
    back = radius * math.tan(abs(turn) / 2)
    first = (corner[0] - back * arrive[0], corner[1] - back * arrive[1])
    centre = (first[0] - side * radius * arrive[1], first[1] + side * radius * arrive[0])
    steps = max(2, math.ceil(abs(turn) / ARC_STEP_RAD), math.ceil(abs(turn) * radius / ARC_STEP_M))
    spoke = (first[0] - centre[0], first[1] - centre[1])
    return [_turned(centre, spoke, turn * k / steps) for k in range(steps + 1)]


def _turned(centre: XY, spoke: XY, angle: float) -> XY:
    c, s = math.cos(angle), math.sin(angle)
    return (centre[0] + c * spoke[0] - s * spoke[1], centre[1] + s * spoke[0] + c * spoke[1])


def _unit(start: XY, end: XY) -> XY:
    length = math.dist(start, end)
    return ((end[0] - start[0]) / length, (end[1] - start[1]) / length) if length else (0.0, 0.0)
