"""Ways over one connected polygon in bounded time: the shortest, or among very many obstacles one near it."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

from comity_sim2d.paths.cost_grid import CostGrid
from comity_sim2d.paths.visibility import VisibilityGraph
from comity_sim2d.pose import XY

if TYPE_CHECKING:
    from shapely import Polygon


class Ways:
    """The ways over a polygon with holes where the obstacles are; what was computed once is kept.

    Args:
        free: Where the centre of a body may be.
    """

    def __init__(self, free: Polygon) -> None:
        self.free = free

    def way(self, start: XY, goal: XY) -> list[XY] | None:
        """The corner points of a way, both ends included; None where there is none.

        It is the shortest, unless the search for that takes too much effort: then it is the cheapest over the
        grid, pulled taut, which is up to a tenth longer. Where the grid has no way through a gap that is
        narrower than its cells, the search goes on to its end.
        """
        search = self._graph.search(start, goal)
        if search.way is not None or search.least_m is None:
            return search.way
        return self.grid.cheapest_way(start, goal, ()) or self._graph.shortest(start, goal)

    def least_m(self, start: XY, goal: XY) -> float | None:
        """A length [m] that no way undercuts, that of the shortest if it is found; None: there is no way."""
        return self._graph.search(start, goal).least_m

    @cached_property
    def grid(self) -> CostGrid:
        """For ways past people."""
        return CostGrid(self.free)

    @cached_property
    def _graph(self) -> VisibilityGraph:
        return VisibilityGraph(self.free)
