"""Paths over one connected polygon in bounded time: the shortest, or near it among many obstacles."""

from __future__ import annotations

import math
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING

from comity_sim2d.paths.cost_grid import CostGrid
from comity_sim2d.paths.visibility import VisibilityGraph
from comity_sim2d.pose import XY

if TYPE_CHECKING:
    from shapely import Polygon

MOST_CORNERS = 2_000
"""Maximum number of corners of a graph that is searched: its lines grow quadratically (our choice: one second
on one core)."""


class Ways:
    """The paths over a polygon with obstacles as holes, with caches.

    Args:
        free: Region in which the centre of a body may be.
    """

    def __init__(self, free: Polygon) -> None:
        self.free = free

    def way(self, start: XY, goal: XY) -> list[XY] | None:
        """Corner points of a path, including both ends, or None.

        It is the shortest path if there are at most `MOST_CORNERS` corners. Otherwise it is the cheapest over
        the grid, pulled taut, which is up to a tenth longer. If the grid has no path through a gap narrower
        than its cells, the graph is searched after all.
        """
        found = self.grid.cheapest_way(start, goal, ()) if self._are_many else None
        return found or self._graph.shortest(start, goal)

    def least_m(self, start: XY, goal: XY) -> float | None:
        """A lower bound of the path length [m], exact if the shortest is found; None if there is no path."""
        if self._are_many:
            return math.dist(start, goal)
        way = self._graph.shortest(start, goal)
        return None if way is None else sum(math.dist(*leg) for leg in pairwise(way))

    @cached_property
    def grid(self) -> CostGrid:
        """The grid for paths past people."""
        return CostGrid(self.free)

    @cached_property
    def _graph(self) -> VisibilityGraph:
        return VisibilityGraph(self.free)

    @property
    def _are_many(self) -> bool:
        return self._graph.corners > MOST_CORNERS
