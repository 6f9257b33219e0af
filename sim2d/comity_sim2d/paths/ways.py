"""Paths over one connected polygon in bounded time: the shortest, or among many obstacles one near it."""

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
"""Of a graph that is searched: lines between them grow by the square (our choice: a second of one core)."""


class Ways:
    """The ways over a polygon with holes where the obstacles are; what was computed once is kept.

    Args:
        free: Where the centre of a body may be.
    """

    def __init__(self, free: Polygon) -> None:
        self.free = free

    def way(self, start: XY, goal: XY) -> list[XY] | None:
        """The corner points of a way, both ends included; None where there is none.

        It is the shortest, unless there are more than `MOST_CORNERS`: then it is the cheapest over the grid,
        pulled taut, which is up to a tenth longer. Where the grid has no way through a gap that is narrower
        than its cells, the graph is searched all the same.
        """
        found = self.grid.cheapest_way(start, goal, ()) if self._are_many else None
        return found or self._graph.shortest(start, goal)

    def least_m(self, start: XY, goal: XY) -> float | None:
        """A length [m] that no way undercuts, the shortest's where that is found; None: there is no way."""
        if self._are_many:
            return math.dist(start, goal)
        way = self._graph.shortest(start, goal)
        return None if way is None else sum(math.dist(*leg) for leg in pairwise(way))

    @cached_property
    def grid(self) -> CostGrid:
        """For ways past people."""
        return CostGrid(self.free)

    @cached_property
    def _graph(self) -> VisibilityGraph:
        return VisibilityGraph(self.free)

    @property
    def _are_many(self) -> bool:
        return self._graph.corners > MOST_CORNERS
