"""The way of a person on foot from one point to another: the shortest around walls and furniture."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

from comity_sim2d.pose import XY
from comity_sim2d.visibility import VisibilityGraph

if TYPE_CHECKING:
    from shapely import Polygon

    from comity_sim2d.obstacles import FloorPlan

EASE_M = (0.20, 0.05, 0.0)
"""How far people like to stay clear of things where there is room, tried in this order (our choice)."""


Disc = tuple[float, float, float]
"""Centre and radius [m]."""


class Footpaths:
    """The ways of people of one size on one floor plan; what was computed once is kept.

    Args:
        plan: What stands still.
        radius_m: Of these people.
        around: People who stand, and what groups keep open: walked around where there is another way.
    """

    def __init__(self, plan: FloorPlan, radius_m: float, around: tuple[Disc, ...] = ()) -> None:
        self._plan, self._radius_m, self._around = plan, radius_m, around
        self._parts = lru_cache(maxsize=None)(self._build)

    def use_plan(self, plan: FloorPlan) -> None:
        """Find ways on another floor plan from now on."""
        self._plan = plan
        self._parts.cache_clear()

    def between(self, start: XY, goal: XY) -> list[XY] | None:
        """The points where the way bends, without the start and with the goal; None where there is no way."""
        for ease in EASE_M:
            way = self._way(start, goal, ease)
            if way is not None:
                return way[1:]
        return None

    def _way(self, start: XY, goal: XY, ease_m: float) -> list[XY] | None:
        from shapely import Point

        ends = Point(start), Point(goal)
        for free, graph in self._parts(ease_m):
            if all(free.covers(end) for end in ends):
                return graph.shortest(start, goal)
        return None

    def _build(self, ease_m: float) -> list[tuple[Polygon, VisibilityGraph]]:
        from shapely import Point, Polygon, difference, get_parts, prepare, union_all

        clear_m = round(self._radius_m + ease_m - 1e-3, 6)
        free = self._plan.clear_space(clear_m)
        if ease_m > 0.0 and self._around:
            discs = [Point(x, y).buffer(radius + clear_m, quad_segs=4) for x, y, radius in self._around]
            free = difference(free, union_all(discs))
        parts = [part for part in get_parts(free) if isinstance(part, Polygon) and part.area > 1e-6]
        for part in parts:
            prepare(part)
        return [(part, VisibilityGraph(part)) for part in parts]
