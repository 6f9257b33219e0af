"""Routes in a scene: the shortest one that respects all personal space, or else the cheapest.

Obstacles are grown by the robot's radius and a margin, so that the robot becomes a point. A route avoids all
personal space if that takes no long detour: it is then the shortest such route, found over a visibility
graph. Otherwise each person's loss of space is weighed against the path length (`cost_grid`). No route leads
through the o-space of a group, or within the minimum gap to a person.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cached_property, lru_cache, partial

import numpy as np
from numpy.typing import NDArray

from comity_fis.proxemics import COMFORT_M
from comity_sim2d.kinds import require_kinds
from comity_sim2d.navigation.route import Route, round_corners
from comity_sim2d.paths.cost_grid import WEIGHT, way_cost
from comity_sim2d.paths.free_space import FreeSpace
from comity_sim2d.paths.personal_space import FRONT, PersonalSpace, Points, bounding_box
from comity_sim2d.pose import XY
from comity_sim2d.scene.o_space import OSpace
from comity_sim2d.scene.obstacles import WALL_MARGIN_M, FloorPlan
from comity_sim2d.scene.person import Person
from comity_sim2d.scene.scene import Scene
from comity_sim2d.scene.surroundings import Surroundings

DETOUR, DETOUR_M = 1.25, 1.0
"""A path around all people is taken without weighing if it is no longer than `DETOUR` times the shortest one
plus `DETOUR_M` [m] (our choice)."""
SLACK_M = 0.005
"""Routes may be nearer to walls than docking poses by this much [m], so that all free poses are reachable;
they keep as much more distance from people."""
CHORD_M = 0.001
"""Arcs are made of short straight pieces, which deviate inwards by at most this [m]."""

MOST_SEARCHES = 8
"""Number of searches around the people whom the last path crossed; after that, one around all people. In a
crowd of hundreds each path would cross others, for minutes (our choice)."""

AHEAD_M, AHEAD_STEP_M = 4.0, 0.1
"""Length ahead on a route that is checked against people who moved, and the step [m]."""
WORTH_M = 0.5
"""A route is kept unless its cost has risen, or another one is cheaper, by more than this [m]: the robot does
not switch to and fro between two routes of similar cost (our choice)."""

Kept = PersonalSpace | OSpace


class RouteMap:
    """Routes in one scene, with caches."""

    def __init__(self, scene: Scene | Surroundings) -> None:
        require_kinds("route map", scene=(scene, Scene | Surroundings))
        self.surroundings = Surroundings.of(scene) if isinstance(scene, Scene) else scene

    def __getstate__(self) -> dict[str, object]:
        """The state without the caches, which cannot be pickled and refill."""
        return {name: value for name, value in vars(self).items() if name not in ("_routes", "_reached")}

    @cached_property
    def _routes(self) -> Callable[[XY, XY, tuple[tuple[str, float], ...]], Route | None]:
        return lru_cache(maxsize=64)(self._route)

    @cached_property
    def _reached(self) -> Callable[[XY, XY], bool]:
        return lru_cache(maxsize=64)(self._reaches)

    def length(self, start: XY, goal: XY, *, keep: Mapping[str, float] | None = None) -> float | None:
        """The length of the route [m]; None where there is none. See `route`."""
        route = self.route(start, goal, keep=keep)
        return None if route is None else route.length_m

    def least_length(self, start: XY, goal: XY) -> float | None:
        """A lower bound of the route length [m], quicker to find; None if there is no route.

        It considers only static obstacles, and cuts corners as far as rounded ones may.
        """
        free = _space_at_most(self.surroundings.plan, self._clearance_m - CHORD_M)
        if not free.holds(start):
            return math.dist(start, goal)
        least_m = free.least_m(start, goal)
        return None if least_m is None else max(0.0, least_m - 1e-6)

    def route(self, start: XY, goal: XY, *, keep: Mapping[str, float] | None = None) -> Route | None:
        """The route between two positions of the robot's centre [m], or None.

        Args:
            start: A position without contact; one inside a margin is first led straight out of it.
            goal: A position that keeps all margins (`Surroundings.blocker`).
            keep: Distances to keep from people, by name, instead of their own; between surfaces [m].
        """
        return self._routes(start, goal, tuple((keep or {}).items()))

    def _route(self, start: XY, goal: XY, kept: tuple[tuple[str, float], ...]) -> Route | None:
        keep, groups = dict(kept), self.groups(start, goal)
        return self._led_out(start, goal, lambda first: self._route_outside(first, goal, keep, groups))

    def _led_out(self, start: XY, goal: XY, find: Callable[[XY], Route | None]) -> Route | None:
        """The straight line out of all margins, and the route from there that `find` finds."""
        first = self.way_out(start, goal)
        route = None if first is None else find(first)
        if route is None or first == start:
            return route
        return Route((start, *route.points))

    def _route_outside(
        self, start: XY, goal: XY, keep: Mapping[str, float], groups: tuple[OSpace, ...]
    ) -> Route | None:
        """The route from a position outside all margins of people."""
        spaces = self.spaces(start, goal, keep=keep)
        if self._is_straight(start, goal, (*spaces, *groups)):
            return Route((start, goal))
        polite = self._shortest(start, goal, spaces, groups)
        if polite is not None and polite.length_m <= DETOUR * math.dist(start, goal) + DETOUR_M:
            return polite
        floors = tuple(space.without_comfort() for space in spaces)
        shortest = self._shortest(start, goal, floors, groups)
        if shortest is None or (polite is not None and polite.length_m <= _bearable(shortest)):
            return polite
        cheapest = self._cheapest(start, goal, spaces, (*floors, *groups))
        found = [route for route in (polite, cheapest, shortest) if route is not None]
        return min(found, key=lambda route: way_cost(route.points, spaces))

    def polite(self, start: XY, goal: XY) -> Route | None:
        """The shortest route that keeps all own distances, however long; None where there is none."""
        groups = self.groups(start, goal)
        return self._led_out(
            start, goal, lambda first: self._shortest(first, goal, self.spaces(first, goal), groups)
        )

    def to(self, person: str) -> RouteMap:
        """The routes for a visit to a person."""
        return self

    def with_people(self, people: tuple[Person, ...]) -> RouteMap:
        """The same kind of routes for changed positions or preferences of people."""
        return RouteMap(self.surroundings.with_people(people))

    def reaches(self, start: XY, goal: XY, *, keep: Mapping[str, float] | None = None) -> bool:
        """Whether there is a route at all; quicker than finding it."""
        return self._reached(start, goal)

    def _reaches(self, start: XY, goal: XY) -> bool:
        first = self.way_out(start, goal)
        if first is None:
            return False
        floors = _giving_way(self._floors, first, goal)
        return self._around((*floors, *self.groups(start, goal))).joins(first, goal)

    def way_out(self, start: XY, goal: XY) -> XY | None:
        """The nearest position outside all people's margins: the start, if it is outside them.

        A position with a route to the goal is preferred. None if there is none within the robot's diameter:
        farther away, a wall might be between.
        """
        floors = _giving_way(self._floors, goal, goal)
        at = np.array([start])
        if all(_depth_m(floor, at) <= SLACK_M for floor in floors):
            return start
        free = self._around((*floors, *self.groups(start, goal)))
        return free.nearest(start, goal, 2.0 * self.surroundings.robot_radius_m)

    def may_reach(self, start: XY, goals: Sequence[XY]) -> NDArray[np.bool_]:
        """Whether there would be routes to many goals without people; shape (n,)."""
        return self._around(()).joins_any(start, goals)

    def is_worse(
        self,
        route: Route,
        way_m: float,
        cost_m: float,
        *,
        keep: Mapping[str, float] | None = None,
        by_m: float = WORTH_M,
    ) -> bool:
        """Whether people moved so that the rest of a route is now blocked, or costs much more than before.

        Args:
            route: The route that the robot follows.
            way_m: Path length of the robot along it [m].
            cost_m: Cost of passing people on it when it was planned [m].
            keep: As for `route`.
            by_m: Increase in cost that counts as much [m].
        """
        points = _ahead(route, way_m)
        spaces = self.spaces((points[0][0], points[0][1]), route.goal, keep=keep)
        depths_m = [space.without_comfort().depth_m(points) for space in spaces]
        # The way out of a margin begins as deep inside it as the robot is.
        if any(depth_m.max() > max(SLACK_M, depth_m[0]) for depth_m in depths_m):
            return True
        return _discomfort_m(spaces, points) > cost_m + by_m

    def has_better(
        self, route: Route, way_m: float, *, keep: Mapping[str, float] | None = None, by_m: float = WORTH_M
    ) -> bool:
        """Whether people made room so that another route costs much less than the rest of this one.

        Args:
            route: The route that the robot follows.
            way_m: Path length of the robot along it [m].
            keep: As for `route`.
            by_m: Saving that counts as much [m].
        """
        here, goal, left_m = route.at(way_m), route.goal, route.length_m - way_m
        if left_m - math.dist(here, goal) < by_m:
            return False
        least_m = self.least_length(here, goal)
        if least_m is None or left_m - least_m < by_m:
            return False
        other = self.route(here, goal, keep=keep)
        if other is None:
            return False
        spaces = self.spaces(here, goal, keep=keep)
        return way_cost(other.points, spaces) < way_cost(route.rest(way_m), spaces) - by_m

    def discomfort_ahead(
        self, route: Route, way_m: float, *, keep: Mapping[str, float] | None = None
    ) -> float:
        """Cost of passing people on the next metres of a route, in metres of detour."""
        points = _ahead(route, way_m)
        return _discomfort_m(self.spaces((points[0][0], points[0][1]), route.goal, keep=keep), points)

    def spaces(
        self, start: XY, goal: XY, *, keep: Mapping[str, float] | None = None
    ) -> tuple[PersonalSpace, ...]:
        """All personal spaces, shrunk where the route has to start or end inside them."""
        people = zip(self.surroundings.people, self._spaces, strict=True)
        spaces = (
            self._space(person, keep[person.name]) if keep and person.name in keep else space
            for person, space in people
        )
        return _giving_way(spaces, start, goal)

    @cached_property
    def _spaces(self) -> tuple[PersonalSpace, ...]:
        return tuple(self._space(person, None) for person in self.surroundings.people)

    @cached_property
    def _floors(self) -> tuple[PersonalSpace, ...]:
        return tuple(space.without_comfort() for space in self._spaces)

    def _space(self, person: Person, kept_m: float | None) -> PersonalSpace:
        own = COMFORT_M if person.personal_distance_m is None else person.personal_distance_m
        contact = person.radius_m + self.surroundings.robot_radius_m
        return PersonalSpace(
            person.x_m,
            person.y_m,
            person.heading_rad,
            contact_m=contact,
            own_m=(own if kept_m is None else kept_m) + SLACK_M,
            floor_m=contact + person.margin_m + SLACK_M,
            front=FRONT if kept_m is None else 1.0,
        )

    def groups(self, start: XY, goal: XY) -> tuple[OSpace, ...]:
        """The o-spaces to avoid, shrunk where the route has to start or end inside them."""
        grown = (group.grown(self.surroundings.robot_radius_m) for group in self.surroundings.o_spaces)
        shrunk = (group.leaving_out(goal, SLACK_M).leaving_out(start, SLACK_M) for group in grown)
        return tuple(group for group in shrunk if group.radius_m > 0.0)

    def _shortest(
        self, start: XY, goal: XY, spaces: tuple[PersonalSpace, ...], groups: tuple[OSpace, ...]
    ) -> Route | None:
        """The shortest path, considering only those people whom a shorter one would disturb.

        More obstacles never make a shortest path shorter. So a path that avoids all spaces, found around some
        of them, is the shortest around all of them.
        """
        everybody: tuple[Kept, ...] = (*spaces, *groups)
        mapped: tuple[Kept, ...] = ()
        searches = 0
        while True:
            way = self._around(mapped).way(start, goal)
            if way is None:
                return None
            points = _between(way)
            box = bounding_box(points)
            near = [each for each in everybody if not each.is_beyond(box)]
            crossed = [each for each in near if each not in mapped and _depth_m(each, points) >= CHORD_M]
            if not crossed:  # rounded corners stay inside the box
                return round_corners(way, partial(self._are_clear, near))
            searches += 1
            many = searches >= MOST_SEARCHES
            mapped = tuple(each for each in everybody if many or each in mapped or each in crossed)

    def _cheapest(
        self, start: XY, goal: XY, spaces: tuple[PersonalSpace, ...], floors: tuple[Kept, ...]
    ) -> Route | None:
        around = self._around(floors)
        grid = around.cost_grid(start)
        if grid is None:
            return None
        way = grid.cheapest_way(start, goal, spaces)
        if way is None:  # no row of cells fits through a gap as narrow as a cell
            shortest = around.way(start, goal)
            way = None if shortest is None else grid.polished(shortest, spaces)
        return None if way is None else round_corners(way, partial(self._are_clear, floors))

    def _around(self, kept: tuple[Kept, ...]) -> FreeSpace:
        return _free_space(self.surroundings.plan, self._clearance_m, kept)

    @property
    def _clearance_m(self) -> float:
        return self.surroundings.robot_radius_m + WALL_MARGIN_M - SLACK_M

    def _is_straight(self, start: XY, goal: XY, kept: Sequence[Kept]) -> bool:
        if not _leaves_clear(self.surroundings.plan, start, goal, self._clearance_m - CHORD_M):
            return False
        near = [each for each in kept if not each.is_beyond_line(start, goal)]
        points = _between((start, goal)) if near else None
        return points is None or all(_depth_m(each, points) < CHORD_M for each in near)

    def _are_clear(self, kept: Sequence[Kept], lines: Sequence[Points]) -> NDArray[np.bool_]:
        """Whether polylines of closely spaced points keep clear of walls and spaces."""
        clear = self.surroundings.plan.leave_clear(lines, self._clearance_m - CHORD_M)
        if kept and clear.any():
            points = np.concatenate(lines)
            first = np.cumsum([0, *(len(line) for line in lines[:-1])])
            for each in kept:
                clear &= np.maximum.reduceat(each.depth_m(points), first) < CHORD_M
        return clear


def _giving_way(spaces: Iterable[PersonalSpace], start: XY, goal: XY) -> tuple[PersonalSpace, ...]:
    """Spaces shrunk so that a path can start and end within people's own distances, not within margins."""
    for end in (goal, start):
        spaces = [each.leaving_out(end, SLACK_M / 2, least_m=each.floor_m - 2 * SLACK_M) for each in spaces]
    return tuple(spaces)


@lru_cache(maxsize=128)
def _free_space(plan: FloorPlan, clearance_m: float, kept: tuple[Kept, ...]) -> FreeSpace:
    """Free space, shared by all maps of a floor plan: static obstacles stay the same while people move."""
    return FreeSpace(plan.clear_space(clearance_m), kept)


@lru_cache(maxsize=16)
def _space_at_most(plan: FloorPlan, clearance_m: float) -> FreeSpace:
    """The largest free space, which contains all routes."""
    return FreeSpace(plan.clear_space(clearance_m, at_least=False), ())


@lru_cache(maxsize=256)
def _leaves_clear(plan: FloorPlan, start: XY, goal: XY, clearance_m: float) -> bool:
    """Whether a straight line keeps a clearance from static obstacles; cached, as people move often."""
    return bool(plan.leave_clear([np.array([start, goal])], clearance_m).all())


def _ahead(route: Route, way_m: float) -> Points:
    count = math.ceil(min(AHEAD_M, max(route.length_m - way_m, 0.0)) / AHEAD_STEP_M)
    return np.array([route.at(way_m + AHEAD_STEP_M * k) for k in range(count + 1)])


def _discomfort_m(spaces: Iterable[PersonalSpace], points: Points) -> float:
    """Cost of passing people at points `AHEAD_STEP_M` apart, in metres of detour."""
    return float(sum(space.discomfort(points).sum() for space in spaces)) * WEIGHT * AHEAD_STEP_M


def _depth_m(kept: Kept, points: Points) -> float:
    return float(kept.depth_m(points).max())


def _bearable(shortest: Route) -> float:
    return DETOUR * shortest.length_m + DETOUR_M


@lru_cache(maxsize=16)
def _between(corners: tuple[XY, ...]) -> Points:
    """Points along a polyline, at most 5 cm apart; read-only, since they are cached."""
    way = np.array(corners)
    points = _divided(way)
    points.flags.writeable = False
    return points


def _divided(way: Points) -> Points:
    """The corner points, and points between those that are farther apart."""
    length = np.hypot(*(way[1:] - way[:-1]).T)
    pieces = np.maximum(np.ceil(length / 0.05).astype(int), 1)
    if pieces.max() == 1:
        return way
    leg = np.repeat(np.arange(len(pieces)), pieces)
    piece = np.arange(len(leg)) - (np.cumsum(pieces) - pieces)[leg]
    marks = np.append(leg + piece / pieces[leg], len(way) - 1.0)
    grid = np.arange(len(way))
    return np.stack([np.interp(marks, grid, way[:, 0]), np.interp(marks, grid, way[:, 1])], axis=1)
