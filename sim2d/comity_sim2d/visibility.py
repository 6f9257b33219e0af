"""Shortest ways in a free polygon, over its visibility graph.

A shortest way bends at corners of obstacles only, and is taut there, as a string pulled tight around them
(Lozano-Perez and Wesley, 1979). Of all lines between two obstacles few are taut at both ends, so tautness is
asked first (arithmetic on arrays), and freedom of obstacles (geometry) only of lines that a search comes by.
"""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, cast

import numpy as np
from numpy.typing import NDArray

from comity_sim2d.pose import XY

if TYPE_CHECKING:
    from networkx import Graph
    from shapely import LinearRing, Polygon

Points = NDArray[np.float64]
"""Points in rows, shape (n, 2) [m]."""
TOUCH_M = 1e-6
"""A line may graze an obstacle's outline by this much: it runs along outlines all the time."""
ROWS = 256
"""Corners that are compared with all others at a time, so that large maps stay small in memory."""
START, GOAL = -1, -2
"""The nodes of one question; corners are numbered from 0."""


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

    def shortest(self, start: XY, goal: XY) -> list[XY] | None:
        """The corner points of the shortest way, both ends included; None where there is none."""
        from networkx import NetworkXNoPath, astar_path

        if self._clear(np.array([start]), np.array([goal]))[0]:
            return [start, goal]
        places = np.vstack([self._at, goal, start])  # so that GOAL and START index the last two
        ahead = np.hypot(*(places - np.array(goal)).T)
        graph = self._graph
        graph.add_nodes_from((START, GOAL))
        graph.add_weighted_edges_from((START, *seen) for seen in self._seen_from(start))
        graph.add_weighted_edges_from((GOAL, *seen) for seen in self._seen_from(goal))

        def weight(one: int, other: int, line: dict[str, float]) -> float | None:
            """The line's length; None, which hides it from the search, where an obstacle is in its way."""
            if "clear" not in line:
                line["clear"] = self._clear(places[[one]], places[[other]])[0]
            return line["weight"] if line["clear"] else None

        try:
            way = astar_path(graph, START, GOAL, lambda here, _: float(ahead[here]), weight)
        except NetworkXNoPath:
            return None
        finally:
            graph.remove_nodes_from((START, GOAL))
        corners = [cast(XY, tuple(map(float, self._at[i]))) for i in way[1:-1]]
        return [start, *corners, goal]

    @cached_property
    def _graph(self) -> Graph[int]:
        """All lines between corners that are taut at both ends, free of obstacles or not.

        Made for the first way that is asked for: whether there is one at all can be said without it.
        """
        from networkx import Graph

        graph: Graph[int] = Graph()
        graph.add_nodes_from(range(len(self._at)))
        for first in range(0, len(self._at), ROWS):
            rows, others = slice(first, first + ROWS), slice(first, None)  # a line has no direction
            lines = self._at[others] - self._at[rows, None]
            taut = _taut(lines, self._before[rows, None], self._after[rows, None])
            taut &= _taut(lines, self._before[others], self._after[others])
            here, there = np.nonzero(taut)
            length = np.hypot(*lines[here, there].T)
            apart = length > TOUCH_M
            ends = (here[apart] + first, there[apart] + first, length[apart])
            graph.add_weighted_edges_from(zip(*(end.tolist() for end in ends), strict=True))
        return graph

    def _seen_from(self, point: XY) -> list[tuple[int, float]]:
        """The corners that a taut line from a point leads to, with their distances."""
        lines = self._at - np.array(point)
        taut = np.flatnonzero(_taut(lines, self._before, self._after))
        return list(zip(taut.tolist(), np.hypot(*lines[taut].T).tolist(), strict=True))

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
