"""Shortest ways in a free polygon, over its visibility graph.

A shortest way bends at corners of obstacles only, and is taut there, as a string pulled tight around them
(Lozano-Perez and Wesley, 1979). Of all lines between two obstacles few are taut at both ends, so tautness is
asked first (arithmetic on arrays), and freedom of obstacles (geometry) only of lines that a search comes by.
Among very many obstacles, so many ways are of nearly the same length that a search is cut off (`ways`).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from heapq import heappop, heappush
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from comity_sim2d.pose import XY

if TYPE_CHECKING:
    from shapely import LinearRing, Polygon

Points = NDArray[np.float64]
"""Points in rows, shape (n, 2) [m]."""
TOUCH_M = 1e-6
"""A line may graze an obstacle's outline by this much: it runs along outlines all the time."""

MOST_EFFORT = 30_000_000
"""Of one search, in corners that a line is drawn to: one to three seconds of one core (our choice)."""
LOOK_EFFORT, TAUT_EFFORT = 300, 20
"""What it takes to look whether one line is free, and to queue one that is taut, in that unit (measured)."""

DRAWN = 4096
"""Lines that are drawn at once: few take as long, for what each step over arrays takes by itself."""


class RouteSearch(NamedTuple):
    """What came of a search for the shortest way."""

    way: list[XY] | None
    """Its corner points, both ends included; None where there is none, or the search was cut off."""
    least_m: float | None
    """No way is shorter: its own length, or how far the search came; None where there is no way."""


class VisibilityGraph:
    """One connected free polygon, with holes where the obstacles are."""

    def __init__(self, free: Polygon) -> None:
        from shapely import prepare
        from shapely.geometry.polygon import orient

        self._free = free.buffer(TOUCH_M, join_style="mitre")
        prepare(self._free)
        ccw = orient(free, 1.0)  # the free side is to the left of every ring
        rings = [_bends(ring) for ring in (ccw.exterior, *ccw.interiors)]
        self._at, before, after = (np.concatenate(part) for part in zip(*rings, strict=True))
        self._before, self._after = before - self._at, after - self._at
        self._drawn = max(1, DRAWN // max(1, len(self._at)))
        """From so many corners lines are drawn at once."""
        self._lines: dict[int, list[tuple[int, float]]] = {}
        self._free_lines: dict[tuple[int, int], bool] = {}

    def shortest(self, start: XY, goal: XY) -> list[XY] | None:
        """The corner points of the shortest way, both ends included; None where there is none."""
        return self.search(start, goal, math.inf).way

    def search(self, start: XY, goal: XY, most_effort: float = MOST_EFFORT) -> RouteSearch:
        """The shortest way, or a length that none undercuts where the search takes more than so much effort.

        A* (Hart, Nilsson and Raphael, 1968), with lines drawn and looked at only when the search comes by.
        """
        if self._clear(start, goal):
            return RouteSearch([start, goal], math.dist(start, goal))
        ends = (start, goal)
        ahead = [*self._far_from(goal), math.dist(start, goal), 0.0]
        last = dict(self._seen_from(goal))
        begin, end = len(self._at), len(self._at) + 1
        came: dict[int, int] = {}
        queue, effort = [(ahead[begin], 0.0, begin, begin)], 0
        # A* is exact here, because the straight distance never overestimates. What is expensive is to ask
        # whether a line is free of obstacles, so a line is queued unasked, at its optimistic length, and
        # asked when it is taken up (lazy evaluation of edges; Dellin and Srinivasa 2016, "A unifying
        # formalism for shortest path problems with expensive edge evaluations via lazy best-first search").
        # A line that is not free is dropped then, and its corner stays open for others: the first line
        # taken up to the goal that is free ends the shortest path. The head of the queue bounds all paths
        # from below, which is what remains where the search is cut off.
        while queue:
            least_m, way_m, here, before = heappop(queue)
            if here in came:
                continue
            if effort > most_effort:
                return RouteSearch(None, least_m)
            effort += LOOK_EFFORT
            if not self._is_free(before, here, ends):
                continue
            came[here] = before
            if here == end:
                return RouteSearch([self._place(i, ends) for i in _back(came, begin, end)], way_m)
            lines = self._seen_from(start) if here == begin else self._taut_from(here)
            effort += begin + TAUT_EFFORT * len(lines)
            for there, line_m in (*lines, *([(end, last[here])] if here in last else ())):
                if there not in came:
                    heappush(queue, (way_m + line_m + ahead[there], way_m + line_m, there, here))
        return RouteSearch(None, None)

    def _taut_from(self, corner: int) -> list[tuple[int, float]]:
        """The corners to which a line from one corner is taut at both ends, with their distances."""
        if corner not in self._lines:
            self._draw_lines(corner - corner % self._drawn)
        return self._lines[corner]

    def _draw_lines(self, first: int) -> None:
        """Find the taut lines from a few corners: a search that comes by one comes by those next to it."""
        some = slice(first, first + self._drawn)
        lines = self._at - self._at[some, None]
        taut = _taut(lines, self._before[some, None], self._after[some, None])
        taut &= _taut(lines, self._before, self._after)
        length = np.hypot(lines[..., 0], lines[..., 1])
        taut &= length > TOUCH_M
        self._lines |= {first + i: [] for i in range(len(taut))}
        here, there = np.nonzero(taut)
        for i, j, length_m in zip(here.tolist(), there.tolist(), length[taut].tolist(), strict=True):
            self._lines[first + i].append((j, length_m))

    def _seen_from(self, point: XY) -> list[tuple[int, float]]:
        """The corners that a taut line from a point leads to, with their distances."""
        lines = self._at - np.array(point)
        taut = np.flatnonzero(_taut(lines, self._before, self._after))
        return list(zip(taut.tolist(), np.hypot(*lines[taut].T).tolist(), strict=True))

    def _far_from(self, point: XY) -> list[float]:
        """The distances of all corners from a point [m]."""
        far: list[float] = np.hypot(*(self._at - np.array(point)).T).tolist()
        return far

    def _place(self, which: int, ends: tuple[XY, XY]) -> XY:
        """A corner by its number; after the last one come both ends of a search."""
        if which >= len(self._at):
            return ends[which - len(self._at)]
        x, y = self._at[which].tolist()  # of thousands of corners, a search comes by a few
        return x, y

    def _is_free(self, one: int, other: int, ends: tuple[XY, XY]) -> bool:
        """Whether no obstacle is in the way; between two corners it is remembered."""
        if one == other:
            return True
        line = (min(one, other), max(one, other))
        if line[1] >= len(self._at):
            return self._clear(self._place(one, ends), self._place(other, ends))
        if line not in self._free_lines:
            self._free_lines[line] = self._clear(self._place(one, ends), self._place(other, ends))
        return self._free_lines[line]

    def _clear(self, start: XY, end: XY) -> bool:
        from shapely import covers, linestrings

        return bool(covers(self._free, linestrings((start, end))))


def _back(came: Mapping[int, int], begin: int, end: int) -> list[int]:
    """The way that a search has come, from its beginning."""
    way = [end]
    while way[-1] != begin:
        way.append(came[way[-1]])
    return way[::-1]


def _bends(ring: LinearRing) -> tuple[Points, Points, Points]:
    """The corners of a ring around which a way may bend, with their neighbours on the ring."""
    closed = np.asarray(ring.coords)[:, :2]
    at, before, after = closed[:-1], np.concatenate([closed[-2:-1], closed[:-2]]), closed[1:]
    right_turn = _cross(at - before, after - at) < 0.0
    return at[right_turn], before[right_turn], after[right_turn]


def _taut(lines: Points, before: Points, after: Points) -> NDArray[np.bool_]:
    """Whether a line leaves the obstacle at a corner on one side: both neighbours on it, or on the line."""
    return _cross(lines, before) * _cross(lines, after) >= -1e-12


def _cross(one: Points, other: Points) -> Points:
    return one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0]
