"""Shortest ways in a free polygon, over its visibility graph, looked up only where a search comes by.

A shortest way bends at corners of obstacles only, and is taut there, as a string pulled tight around them
(Lozano-Perez and Wesley, 1979). Of all lines between two obstacles few are taut at both ends, so tautness is
asked first (arithmetic on arrays) and freedom of obstacles last (geometry).
"""

from __future__ import annotations

import heapq
import math
from typing import TYPE_CHECKING, cast

import numpy as np
from numpy.typing import NDArray

from comity_sim2d.pose import XY

if TYPE_CHECKING:
    from shapely import LinearRing, Polygon

Points = NDArray[np.float64]
"""Points in rows, shape (n, 2) [m]."""
TOUCH_M = 1e-6
"""A line may graze an obstacle's outline by this much: it runs along outlines all the time."""


class VisibilityGraph:
    """One connected free polygon, with holes where the obstacles are."""

    def __init__(self, free: Polygon) -> None:
        from shapely import prepare
        from shapely.geometry.polygon import orient

        self._free = free.buffer(TOUCH_M, join_style="mitre")
        prepare(self._free)
        ccw = orient(free, 1.0)  # the free side is to the left of every ring
        rings = [_bends(ring) for ring in (ccw.exterior, *ccw.interiors)]
        self._at, self._before, self._after = (np.concatenate(part) for part in zip(*rings, strict=True))
        self._known: dict[int, list[tuple[int, float]]] = {}

    def shortest(self, start: XY, goal: XY) -> list[XY] | None:
        """The corner points of the shortest way, both ends included; None where there is none."""
        if self._clear(np.array([start]), np.array([goal]))[0]:
            return [start, goal]
        from_start = self._seen_from(start)
        to_goal = dict(self._seen_from(goal))
        came_from = self._search(from_start, to_goal, goal)
        if came_from is None:
            return None
        corners = [cast(XY, tuple(map(float, self._at[i]))) for i in came_from]
        return [start, *corners, goal]

    def _search(
        self, from_start: list[tuple[int, float]], to_goal: dict[int, float], goal: XY
    ) -> list[int] | None:
        """A* from the corners seen from the start to those that see the goal; ties go to the lower number."""
        ahead = np.hypot(*(self._at - np.array(goal)).T)
        best = dict(from_start)
        parent: dict[int, int] = {}
        last, total = -1, math.inf
        queue = [(length + float(ahead[i]), i) for i, length in from_start]
        heapq.heapify(queue)
        closed: set[int] = set()
        while queue and queue[0][0] < total:
            _, here = heapq.heappop(queue)
            if here in closed:
                continue
            closed.add(here)
            if here in to_goal and best[here] + to_goal[here] < total:
                last, total = here, best[here] + to_goal[here]
            for there, step in self._neighbours(here):
                length = best[here] + step
                if length < best.get(there, math.inf) - 1e-12:
                    best[there], parent[there] = length, here
                    heapq.heappush(queue, (length + float(ahead[there]), there))
        return None if last < 0 else _walk_back(parent, last)

    def _neighbours(self, here: int) -> list[tuple[int, float]]:
        if here not in self._known:
            at = self._at[here]
            lines = self._at - at
            length = np.hypot(lines[:, 0], lines[:, 1])
            taut_here = _taut(lines, self._before[here] - at, self._after[here] - at)
            self._known[here] = self._visible(at, lines, length, taut_here & (length > TOUCH_M))
        return self._known[here]

    def _seen_from(self, point: XY) -> list[tuple[int, float]]:
        at = np.array(point)
        lines = self._at - at
        length = np.hypot(lines[:, 0], lines[:, 1])
        return self._visible(at, lines, length, np.ones(len(lines), dtype=bool))

    def _visible(
        self, at: Points, lines: Points, length: Points, wanted: NDArray[np.bool_]
    ) -> list[tuple[int, float]]:
        taut_there = _taut(lines, self._before - self._at, self._after - self._at)
        candidates = np.flatnonzero(wanted & taut_there)
        ends = self._at[candidates]
        clear = self._clear(np.broadcast_to(at, ends.shape), ends)
        return [(int(i), float(length[i])) for i in candidates[clear]]

    def _clear(self, starts: Points, ends: Points) -> NDArray[np.bool_]:
        from shapely import covers, linestrings

        return np.asarray(covers(self._free, linestrings(np.stack([starts, ends], axis=1))))


def _bends(ring: LinearRing) -> tuple[Points, Points, Points]:
    """The corners of a ring around which a way may bend, with their neighbours on the ring."""
    at = np.asarray(ring.coords)[:-1, :2]
    before, after = np.roll(at, 1, axis=0), np.roll(at, -1, axis=0)
    right_turn = _cross(at - before, after - at) < 0.0
    return at[right_turn], before[right_turn], after[right_turn]


def _taut(lines: Points, before: Points, after: Points) -> NDArray[np.bool_]:
    """Whether a line leaves the obstacle at a corner on one side: both neighbours on it, or on the line."""
    return _cross(lines, before) * _cross(lines, after) >= -1e-12


def _cross(one: Points, other: Points) -> Points:
    return one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0]


def _walk_back(parent: dict[int, int], last: int) -> list[int]:
    way = [last]
    while way[-1] in parent:
        way.append(parent[way[-1]])
    return way[::-1]
