"""A route as driven: straight lines joined by arcs, with the speed limit of its bends."""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from comity_sim2d.pose import XY

ARC_RADII_M = (1.6, 0.8, 0.4, 0.3, 0.2, 0.1)
"""Candidate radii of arcs [m], widest first: the wider a bend, the faster it can be driven."""
ARC_STEP_RAD = math.radians(3.0)
ARC_STEP_M = 0.02
SAME_M = 1e-6


@dataclass(frozen=True)
class Route:
    """A path from its first point to its last. It is not empty, but start and goal may coincide."""

    points: tuple[XY, ...]
    """Corner points [m]; arcs are made of short straight pieces."""

    @cached_property
    def _legs(self) -> NDArray[np.float64]:
        return np.diff(np.array(self.points), axis=0)

    @cached_property
    def _marks(self) -> list[float]:
        """Path length up to every point [m]."""
        return [0.0, *np.cumsum(np.hypot(self._legs[:, 0], self._legs[:, 1])).tolist()]

    @cached_property
    def _directions(self) -> list[XY]:
        """The unit vector along every leg."""
        return [_unit(one, other) for one, other in pairwise(self.points)]

    @property
    def goal(self) -> XY:
        """Last point."""
        return self.points[-1]

    @cached_property
    def length_m(self) -> float:
        """Total length [m]."""
        return sum(math.dist(one, other) for one, other in pairwise(self.points))

    @cached_property
    def last_leg_m(self) -> float:
        """Path length at the start of the last straight line [m]."""
        return self._marks[-2]

    def at(self, way_m: float) -> XY:
        """The point at a path length."""
        i, rest = self._leg(way_m)
        (x, y), (dx, dy) = self.points[i], self._directions[i]
        return (x + rest * dx, y + rest * dy)

    def rest(self, way_m: float) -> tuple[XY, ...]:
        """The points from a path length on."""
        return (self.at(way_m), *self.points[self._leg(way_m)[0] + 1 :])

    def direction(self, way_m: float) -> XY:
        """Unit vector along the path at a path length."""
        return self._directions[self._leg(way_m)[0]]

    def nearest(self, xy: XY, low_m: float, high_m: float) -> float:
        """Path length of the point nearest to `xy`, searched between two path lengths [m]."""
        marks, best, best_m = self._marks, math.inf, low_m
        for i in range(self._leg(low_m)[0], len(marks) - 1):
            if marks[i] > high_m:
                break
            (x, y), (dx, dy) = self.points[i], self._directions[i]
            along = (xy[0] - x) * dx + (xy[1] - y) * dy
            most = min(high_m, marks[i + 1]) - marks[i]
            along = max(min(along, most), low_m - marks[i], 0.0)
            gap = math.hypot(xy[0] - x - along * dx, xy[1] - y - along * dy)
            if gap < best:
                best, best_m = gap, marks[i] + along
        return best_m

    def bend_limit(self, way_m: float, turning: float, braking: float) -> float:
        """The speed from which every bend ahead can still be taken [m/s].

        Args:
            way_m: Current path length [m].
            turning: The acceleration for changing direction [m/s^2]: v = sqrt(turning * radius) in a bend.
            braking: The deceleration before it [m/s^2].
        """
        marks, bends, square = self._marks, self._bends, math.inf
        for i in range(bisect_left(marks, way_m - ARC_STEP_M, 1), len(marks) - 1):
            to_brake = 2.0 * braking * max(marks[i] - way_m, 0.0)
            if to_brake >= square:
                break
            square = min(square, turning / bends[i - 1] + to_brake)
        return math.sqrt(square)

    @cached_property
    def _bends(self) -> list[float]:
        """Curvature at every inner point [1/m]; a sharp corner counts as a bend `2 * ARC_STEP_M` long."""
        angle = np.arctan2(self._legs[:, 1], self._legs[:, 0])
        turn = np.abs((np.diff(angle) + np.pi) % (2 * np.pi) - np.pi)
        length = np.diff(self._marks)
        around = np.clip((length[:-1] + length[1:]) / 2, 1e-3, 2 * ARC_STEP_M)
        bends: list[float] = np.maximum(turn / around, 1e-9).tolist()
        return bends

    def _leg(self, way_m: float) -> tuple[int, float]:
        marks = self._marks
        i = bisect_right(marks, way_m, 1, len(marks) - 1) - 1
        return i, min(max(way_m - marks[i], 0.0), marks[i + 1] - marks[i])


AreClear = Callable[[Sequence[NDArray[np.float64]]], NDArray[np.bool_]]
"""For polylines of closely spaced points, each of shape (n, 2): whether each is clear of obstacles."""


def round_corners(points: Sequence[XY], are_clear: AreClear) -> Route:
    """Replace the corners of a path by the widest clear arcs that fit between the neighbouring corners.

    The corners of obstacles grown by an offset lie outside the true, round offset: an arc with the offset's
    radius fits.
    """
    corners = [_Corner.of(*three) for three in zip(points, points[1:], points[2:], strict=False)]
    arcs = _arcs(corners, are_clear)
    rounded = [points[0]]
    for i, corner in enumerate(corners):
        arc = arcs.get(i, [corner.at])
        rounded.extend(arc[math.dist(rounded[-1], arc[0]) < SAME_M :])  # two arcs may meet in one point
    return Route((*rounded, points[-1]))


@dataclass(frozen=True, slots=True)
class _Corner:
    """A corner of a path."""

    at: XY
    arrive: XY
    """Unit vector along the line to it."""
    turn_rad: float
    widest_m: float
    """Radius of the widest arc between the midpoints of both lines [m]."""

    @classmethod
    def of(cls, before: XY, at: XY, after: XY) -> _Corner:
        arrive, leave = _unit(before, at), _unit(at, after)
        across = arrive[0] * leave[1] - arrive[1] * leave[0]
        turn = math.atan2(across, arrive[0] * leave[0] + arrive[1] * leave[1])
        tangent = math.tan(abs(turn) / 2)
        longest = min(math.dist(before, at), math.dist(at, after)) / 2
        return cls(at, arrive, turn, longest / tangent if tangent >= 1e-6 else 0.0)

    def arc(self, radius: float) -> list[XY]:
        """Points of the arc of this radius that is tangent to both lines."""
        side = math.copysign(1.0, self.turn_rad)
        back = radius * math.tan(abs(self.turn_rad) / 2)
        first = (self.at[0] - back * self.arrive[0], self.at[1] - back * self.arrive[1])
        x, y = first[0] - side * radius * self.arrive[1], first[1] + side * radius * self.arrive[0]
        angle = abs(self.turn_rad)
        steps = max(2, math.ceil(angle / ARC_STEP_RAD), math.ceil(angle * radius / ARC_STEP_M))
        dx, dy = first[0] - x, first[1] - y  # the spoke that turns around the centre
        turns = [self.turn_rad * k / steps for k in range(steps + 1)]
        units = zip(map(math.cos, turns), map(math.sin, turns), strict=True)
        return [(x + c * dx - s * dy, y + s * dx + c * dy) for c, s in units]


def _arcs(corners: Sequence[_Corner], are_clear: AreClear) -> dict[int, list[XY]]:
    """The widest clear arc of every corner that has one."""
    found: dict[int, list[XY]] = {}
    left = {i: corner for i, corner in enumerate(corners) if corner.widest_m > 0.0}
    for radius in ARC_RADII_M:
        # An arc that is the widest that fits was tried with the first radius.
        wide = {i: it for i, it in left.items() if radius == ARC_RADII_M[0] or it.widest_m > radius}
        arcs = {i: corner.arc(min(radius, corner.widest_m)) for i, corner in wide.items()}
        clear = are_clear([np.array(arc) for arc in arcs.values()]).tolist() if arcs else []
        found |= {i: arcs[i] for i, is_clear in zip(arcs, clear, strict=True) if is_clear}
        left = {i: corner for i, corner in left.items() if i not in found}
    return found


def _unit(start: XY, end: XY) -> XY:
    length = math.dist(start, end)
    return ((end[0] - start[0]) / length, (end[1] - start[1]) / length) if length else (0.0, 0.0)
