"""Shortest paths in a free polygon: A* over its visibility graph, which is a networkx graph.

A shortest path bends only at corners of obstacles, and is taut there, like a string pulled tight around them
(Lozano-Perez and Wesley, 1979). Few of all lines between two obstacles are taut at both ends; the graph has
only these (array arithmetic). Whether a line is free of obstacles is tested when a search reaches it:
geometry takes most of the time, and a search reaches few of the lines.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from comity_sim2d.pose import XY

if TYPE_CHECKING:
    import networkx as nx
    from shapely import LinearRing, Polygon

Points = NDArray[np.float64]
"""Points in rows, shape (n, 2) [m]."""
TOUCH_M = 1e-6
"""Tolerance for a line that touches an obstacle's outline [m]: shortest paths run along outlines."""
DRAWN = 256
"""Number of corners processed at once: all at once would take quadratic memory."""


class VisibilityGraph:
    """One connected free polygon, with holes where the obstacles are.

    Args:
        free: Region in which the centre of a body may be.
    """

    def __init__(self, free: Polygon) -> None:
        from shapely import prepare
        from shapely.geometry.polygon import orient

        self._free = free.buffer(TOUCH_M, join_style="mitre")
        prepare(self._free)
        ccw = orient(free, 1.0)  # the free side is to the left of every ring
        rings = [_bends(ring) for ring in (ccw.exterior, *ccw.interiors)]
        self._at, before, after = (np.concatenate(part) for part in zip(*rings, strict=True))
        self._before, self._after = before - self._at, after - self._at

    @property
    def corners(self) -> int:
        """Number of corners at which a path may bend."""
        return len(self._at)

    def shortest(self, start: XY, goal: XY) -> list[XY] | None:
        """Corner points of the shortest path, including both ends, or None."""
        import networkx as nx

        if self._is_clear(start, goal):
            return [start, goal]
        graph = self._graph
        new = [end for end in (start, goal) if end not in graph]
        graph.add_nodes_from(new)
        for end in (start, goal):  # an end may be a corner, and lines need not be taut there
            graph.add_weighted_edges_from(self._lines_from(end), weight="length_m")
        try:
            return list(nx.astar_path(graph, start, goal, math.dist, self._free_length_m))
        except nx.NetworkXNoPath:
            return None
        finally:
            graph.remove_nodes_from(new)

    @cached_property
    def _graph(self) -> nx.Graph[XY]:
        """The taut lines between corners, with `length_m`, and `is_free` once a search has tested it."""
        import networkx as nx

        graph: nx.Graph[XY] = nx.Graph()
        graph.add_weighted_edges_from(self._taut_lines(), weight="length_m")
        return graph

    def _taut_lines(self) -> Iterator[tuple[XY, XY, float]]:
        """The lines that are taut at both ends."""
        corners = [(x, y) for x, y in self._at.tolist()]
        for first in range(0, len(corners), DRAWN):
            some = slice(first, first + DRAWN)
            lines = self._at - self._at[some, None]
            taut = _taut(lines, self._before[some, None], self._after[some, None])
            taut &= _taut(lines, self._before, self._after)
            length = np.hypot(lines[..., 0], lines[..., 1])
            taut &= length > TOUCH_M
            here, there = np.nonzero(np.triu(taut, first))
            for i, j, length_m in zip(
                here.tolist(), there.tolist(), length[here, there].tolist(), strict=True
            ):
                yield corners[first + i], corners[j], length_m

    def _lines_from(self, end: XY) -> list[tuple[XY, XY, float]]:
        """The lines from an end of a path that are taut at their other end."""
        lines = self._at - np.array(end)
        taut = _taut(lines, self._before, self._after)
        corners = [(x, y) for x, y in self._at[taut].tolist()]
        lengths = np.hypot(*lines[taut].T).tolist()
        return [(end, corner, length_m) for corner, length_m in zip(corners, lengths, strict=True)]

    def _free_length_m(self, one: XY, other: XY, line: dict[str, Any]) -> float | None:
        """Length of a line [m]; None if an obstacle blocks it, so that networkx ignores the edge."""
        if "is_free" not in line:
            line["is_free"] = self._is_clear(one, other)
        return line["length_m"] if line["is_free"] else None

    def _is_clear(self, start: XY, end: XY) -> bool:
        from shapely import covers, linestrings

        return bool(covers(self._free, linestrings((start, end))))


def _bends(ring: LinearRing) -> tuple[Points, Points, Points]:
    """The corners of a ring around which a path may bend, with their neighbours on the ring."""
    closed = np.asarray(ring.coords)[:, :2]
    at, before, after = closed[:-1], np.concatenate([closed[-2:-1], closed[:-2]]), closed[1:]
    right_turn = _cross(at - before, after - at) < 0.0
    return at[right_turn], before[right_turn], after[right_turn]


def _taut(lines: Points, before: Points, after: Points) -> NDArray[np.bool_]:
    """Whether a line has the obstacle on one side at a corner: both neighbours on that side or on it."""
    return _cross(lines, before) * _cross(lines, after) >= -1e-12


def _cross(one: Points, other: Points) -> Points:
    return one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0]
