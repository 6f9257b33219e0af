"""The path of a pedestrian from one point to another: the shortest around walls and furniture."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

from comity_sim2d.paths.visibility import TOUCH_M
from comity_sim2d.paths.ways import Ways
from comity_sim2d.pose import XY

if TYPE_CHECKING:
    from shapely import Polygon

    from comity_sim2d.scene.obstacles import FloorPlan

NEAR_THINGS_M = 0.05
EASE_M = (0.20, NEAR_THINGS_M, 0.0)
"""Preferred clearances from obstacles [m], tried in this order (our choice)."""

BESIDE_M = 0.3
"""A person whose clearance is too small by less than this still finds a path [m] (our choice)."""

Disc = tuple[float, float, float]
"""Centre and radius [m]."""
Parts = list[Ways]
"""The free floor in connected pieces."""


class Footpaths:
    """The paths of people of one size on one floor plan, with caches.

    Args:
        plan: The static obstacles.
        radius_m: Radius of these people [m].
        around: Standing people and o-spaces of groups, avoided if there is another path.
    """

    def __init__(self, plan: FloorPlan, radius_m: float, around: tuple[Disc, ...] = ()) -> None:
        self._plan, self._radius_m, self._around = plan, radius_m, around
        self._parts = lru_cache(maxsize=None)(self._build)

    def use_plan(self, plan: FloorPlan) -> None:
        """Replace the floor plan."""
        self._plan = plan
        self._parts.cache_clear()

    def between(self, start: XY, goal: XY) -> list[XY] | None:
        """Bends of the path without the start, including the goal; None if there is no path."""
        for ease in EASE_M:
            way = _way(self._parts(ease), start, goal)
            if way is None and ease == NEAR_THINGS_M and self._around:
                way = self._from_beside(start, goal)
            if way is not None:
                return way[1:]
        return self.past(None, start, goal)

    def _from_beside(self, start: XY, goal: XY) -> list[XY] | None:
        """The path around all people if it starts or ends too near to them, via the nearest free places."""
        parts = self._parts(NEAR_THINGS_M)
        first, last = _beside(parts, start), _beside(parts, goal)
        way = None if first is None or last is None else _way(parts, first, last)
        return way and [*([start] if first != start else []), *way, *([goal] if last != goal else [])]

    def past(self, thing: Disc | None, start: XY, goal: XY) -> list[XY] | None:
        """The same for a person close to walls, and around one more object; None if there is no path."""
        parts = self._parts(0.0) if thing is None else self._build(0.0, thing)
        beside = _beside(parts, start)
        return None if beside is None else _way(parts, beside, goal)

    def _build(self, ease_m: float, thing: Disc | None = None) -> Parts:
        around = (*(self._around if ease_m > 0.0 else ()), *([] if thing is None else [thing]))
        return [Ways(piece) for piece in clear_pieces(self._plan, self._radius_m + ease_m, around)]


def clear_pieces(plan: FloorPlan, clearance_m: float, around: tuple[Disc, ...] = ()) -> list[Polygon]:
    """The floor that keeps a clearance from static and further obstacles, in connected pieces.

    Args:
        plan: The static obstacles.
        clearance_m: The clearance [m].
        around: Further discs to keep clear of.
    """
    from shapely import Point, Polygon, difference, get_parts, prepare, union_all

    clear_m = round(clearance_m - 1e-3, 6)  # touching an obstacle counts as clear
    free = plan.clear_space(clear_m)
    if around:
        discs = [Point(x, y).buffer(radius + clear_m, quad_segs=4) for x, y, radius in around]
        free = difference(free, union_all(discs))
    pieces = [piece for piece in get_parts(free) if isinstance(piece, Polygon) and piece.area > 1e-6]
    for piece in pieces:
        prepare(piece)
    return pieces


def _way(parts: Parts, start: XY, goal: XY) -> list[XY] | None:
    from shapely import Point

    ends = Point(start), Point(goal)
    for ways in parts:
        if all(ways.free.distance(end) <= TOUCH_M for end in ends):
            return ways.way(start, goal)
    return None


def _beside(parts: Parts, place: XY) -> XY | None:
    """The nearest free place for a person who touches an obstacle."""
    from shapely import Point, shortest_line

    here = Point(place)
    nearest = min((ways.free for ways in parts), key=here.distance, default=None)
    if nearest is None or here.distance(nearest) > BESIDE_M:
        return None
    foot = shortest_line(here, nearest).coords[-1]
    return (foot[0], foot[1])
