"""Shortest collision-free routes in a scene, around people at the distance they like where a way exists.

Obstacles grow by the robot's radius and a margin, people by their own distance; the robot becomes a point. A
person's ring gives way where the route has to start or end inside it, and all rings shrink together, step by
step, down to the safety margin, until a way exists.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import lru_cache, partial
from typing import TYPE_CHECKING

from comity_sim2d.obstacles import PERSON_MARGIN_M, WALL_MARGIN_M, Surroundings
from comity_sim2d.pose import XY
from comity_sim2d.route import Route, round_corners
from comity_sim2d.scene import Person, Scene
from comity_sim2d.visibility import VisibilityGraph

if TYPE_CHECKING:
    from shapely import Polygon

COMFORT_M = 0.45
"""The ring around people whose own distance is not known: the smallest distance of Bruno et al. 2017."""
RELAX = (1.0, 0.75, 0.5, 0.25, 0.0)
"""How much of the rings beyond the safety margin is kept, tried in this order."""
SLACK_M = 0.005
"""Routes may be nearer to walls than places to stand by this much, so that all free places are on the map;
and they stay away from people by so much more."""
SNAP_M = 0.3
"""A start inside a margin is led out of it, if this is enough."""
RING_SEGMENTS = 96
CHORD_M = 0.001
"""Arcs are made of short straight pieces, which run inside by so much at most."""

Ring = tuple[float, float, float]
"""Centre and radius of a disc that the robot's centre keeps out of."""


class RouteMap:
    """Routes in one scene; what was computed once is kept."""

    def __init__(self, scene: Scene | Surroundings) -> None:
        self.surroundings = Surroundings.of(scene) if isinstance(scene, Scene) else scene
        self._graphs = lru_cache(maxsize=128)(self._build_graphs)

    def length(self, start: XY, goal: XY, *, keep: Mapping[str, float] | None = None) -> float | None:
        """The length of the shortest route [m]; None where there is none. See `route`."""
        route = self.route(start, goal, keep=keep)
        return None if route is None else route.length_m

    def route(self, start: XY, goal: XY, *, keep: Mapping[str, float] | None = None) -> Route | None:
        """The shortest route between two places of the robot's centre [m]; None where there is none.

        Args:
            start: A place free of contact; inside a margin it is led out first.
            goal: A place with all margins (`Surroundings.blocker`).
            keep: How far to stay from people, by name, in place of their own distance; between surfaces [m].
        """
        for share in RELAX:
            rings = self._rings(share, keep or {}, start, goal)
            way = self._way(start, goal, rings)
            if way is not None:
                return round_corners(way, partial(self._is_clear, rings))
            if not rings:
                break
        return None

    def reaches(self, start: XY, goal: XY) -> bool:
        """Whether there is a route at all; quicker than to find it."""
        rings = self._rings(0.0, {}, start, goal)
        entry = self._entry(start, rings)
        return entry is not None and self._part_with(goal, rings) == entry[0]

    def _way(self, start: XY, goal: XY, rings: tuple[Ring, ...]) -> list[XY] | None:
        entry = self._entry(start, rings)
        if entry is None or self._part_with(goal, rings) != entry[0]:
            return None
        part, first = entry
        way = self._graphs(rings)[part][1].shortest(first, goal)
        return way if way is None or first == start else [start, *way]

    def _entry(self, start: XY, rings: tuple[Ring, ...]) -> tuple[int, XY] | None:
        """The free part where a route starts and its first free point: the start, or the nearest to it."""
        part = self._part_with(start, rings)
        if part is not None:
            return part, start
        from shapely import Point
        from shapely.ops import nearest_points

        point = Point(start)
        gaps = [(free.distance(point), i) for i, (free, _) in enumerate(self._graphs(rings))]
        if not gaps or min(gaps)[0] > SNAP_M:
            return None
        part = min(gaps)[1]
        near = nearest_points(self._graphs(rings)[part][0], point)[0]
        return part, (near.x, near.y)

    def _part_with(self, xy: XY, rings: tuple[Ring, ...]) -> int | None:
        from shapely import Point

        point = Point(xy)
        return next((i for i, (free, _) in enumerate(self._graphs(rings)) if free.covers(point)), None)

    def _build_graphs(self, rings: tuple[Ring, ...]) -> list[tuple[Polygon, VisibilityGraph]]:
        """The connected parts of the free space around those rings, in a fixed order, each with its graph."""
        from shapely import Polygon, difference, get_parts, prepare, union_all

        free = self.surroundings.plan.clear_space(self._clearance_m)
        if rings:
            free = difference(free, union_all([_disc(ring) for ring in rings]))
        parts = [part for part in get_parts(free) if isinstance(part, Polygon) and part.area > 1e-6]
        for part in parts:
            prepare(part)
        return [(part, VisibilityGraph(part)) for part in parts]

    @property
    def _clearance_m(self) -> float:
        return self.surroundings.robot_radius_m + WALL_MARGIN_M - SLACK_M

    def _rings(self, share: float, keep: Mapping[str, float], start: XY, goal: XY) -> tuple[Ring, ...]:
        return tuple(self._ring(person, share, keep, start, goal) for person in self.surroundings.people)

    def _ring(self, person: Person, share: float, keep: Mapping[str, float], start: XY, goal: XY) -> Ring:
        own = COMFORT_M if person.personal_distance_m is None else person.personal_distance_m
        contact = person.radius_m + self.surroundings.robot_radius_m
        floor = contact + PERSON_MARGIN_M
        wanted = max(0.0, keep.get(person.name, own) - PERSON_MARGIN_M) * share + floor + SLACK_M
        # A goal may be inside somebody's own distance, never inside the margin; a start is where it is.
        to_goal = max(floor - SLACK_M / 2, math.dist(person.pose.xy, goal) - SLACK_M / 2)
        to_start = max(contact + SLACK_M, math.dist(person.pose.xy, start) - SLACK_M / 2)
        return (person.x_m, person.y_m, round(min(wanted, to_goal, to_start), 6))

    def _is_clear(self, rings: tuple[Ring, ...], arc: list[XY]) -> bool:
        if self.surroundings.plan.clearance_m(arc) < self._clearance_m - CHORD_M:
            return False
        return all(math.dist((x, y), point) > radius - CHORD_M for x, y, radius in rings for point in arc)


def _disc(ring: Ring) -> Polygon:
    from shapely import Point

    x, y, radius = ring
    return Point(x, y).buffer(radius, quad_segs=RING_SEGMENTS // 4)
