"""Free space of the robot's centre and shortest paths in it: connected polygons with their graphs."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

from comity_sim2d.paths.cost_grid import CostGrid
from comity_sim2d.paths.personal_space import Points
from comity_sim2d.paths.ways import Ways
from comity_sim2d.pose import XY

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

SNAP_M = 0.3
"""Maximum distance by which a start inside a margin is moved out of it [m]."""

KEPT = 256
"""Number of points whose connected part is cached: many paths share a start or an end."""
KEPT_WAYS = 16
"""Number of paths cached: searches around different people begin with the same one."""


class Outlined(Protocol):
    """A shape to keep out of."""

    def outline(self) -> Points:
        """Its corners in order."""
        ...


class FreeSpace:
    """The clear space of a floor plan, minus people and groups.

    Args:
        clear: Points far enough from all static obstacles.
        kept_out: Further shapes to keep out of.
    """

    def __init__(self, clear: BaseGeometry, kept_out: Sequence[Outlined]) -> None:
        from shapely import Polygon, difference, get_parts, prepare, union_all

        if kept_out:
            clear = difference(clear, union_all([Polygon(each.outline()) for each in kept_out]))
        parts = [part for part in get_parts(clear) if isinstance(part, Polygon) and part.area > 1e-6]
        for part in parts:
            prepare(part)
        self._parts = parts
        self._ways = [Ways(part) for part in parts]
        self._part_with = lru_cache(maxsize=KEPT)(self._find_part)
        self.way = lru_cache(maxsize=KEPT_WAYS)(self._find_way)
        """Corner points of the shortest path, or of one close to it (`Ways`), or None."""

    def _find_way(self, start: XY, goal: XY) -> tuple[XY, ...] | None:
        entry = self._entry(start)
        if entry is None or self._part_with(goal) != entry[0]:
            return None
        part, first = entry
        way = self._ways[part].way(first, goal)
        if way is None:
            return None
        return tuple(way) if first == start else (start, *way)

    def least_m(self, start: XY, goal: XY) -> float | None:
        """A lower bound of the path length from a free place [m]; None if there is no path."""
        part = self._part_with(start)
        if part is None or self._part_with(goal) != part:
            return None
        return self._ways[part].least_m(start, goal)

    def holds(self, xy: XY) -> bool:
        """Whether a point is in it."""
        return self._part_with(xy) is not None

    def joins(self, start: XY, goal: XY) -> bool:
        """Whether there is a path at all; quicker than finding it."""
        entry = self._entry(start)
        return entry is not None and self._part_with(goal) == entry[0]

    def nearest(self, xy: XY, goal: XY, within_m: float) -> XY | None:
        """The nearest free point within a distance [m], preferably one with a path to a goal; or None."""
        found = self._nearest(xy, within_m, first=self._part_with(goal))
        return None if found is None else found[1]

    def joins_any(self, start: XY, goals: Sequence[XY]) -> NDArray[np.bool_]:
        """Whether each of many goals has a path, or one that touches the edge; shape (n,)."""
        from shapely import intersects_xy

        entry = self._entry(start)
        if entry is None:
            return np.zeros(len(goals), dtype=bool)
        return np.asarray(intersects_xy(self._parts[entry[0]], np.array(goals)))

    def cost_grid(self, start: XY) -> CostGrid | None:
        """The grid over the connected part of a start, moved out of margins if necessary."""
        entry = self._entry(start)
        return None if entry is None else self._ways[entry[0]].grid

    def _entry(self, start: XY) -> tuple[int, XY] | None:
        """The connected part and the first free point of a path: the start, or the nearest to it."""
        part = self._part_with(start)
        return self._nearest(start, SNAP_M) if part is None else (part, start)

    def _nearest(self, xy: XY, within_m: float, *, first: int | None = None) -> tuple[int, XY] | None:
        """The nearest free point within a distance [m], preferably in one connected part, with its part."""
        from shapely import Point
        from shapely.ops import nearest_points

        point = Point(xy)
        gaps = ((part.distance(point), i) for i, part in enumerate(self._parts))
        reached = [(i != first, gap_m, i) for gap_m, i in gaps if gap_m <= within_m]
        if not reached:
            return None
        part = min(reached)[2]
        near = nearest_points(self._parts[part], point)[0]
        return part, (near.x, near.y)

    def _find_part(self, xy: XY) -> int | None:
        from shapely import intersects_xy

        return next((i for i, free in enumerate(self._parts) if intersects_xy(free, *xy)), None)
