"""Routes in a scene: the shortest that leaves all people the space they like, or else the cheapest.

Obstacles grow by the robot's radius and a margin, and the robot becomes a point. A route keeps out of all
personal space if that takes no long detour: it is the shortest of these, found over a visibility graph.
Otherwise the loss of each person is weighed against the path length (`cost_grid`). No route leads through the
space that a group keeps open between its members, or within the minimum gap of a person.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import replace
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
"""A path around all people is taken without weighing if it is no longer than `DETOUR` times the shortest and
`DETOUR_M` (our choice)."""
SLACK_M = 0.005
"""Routes may be nearer to walls than places to stand by this much, so that all free places are on the map;
they stay away from people by the same distance more."""
CHORD_M = 0.001
"""Arcs are made of short straight pieces, which run inside by this distance at most [m]."""

MOST_SEARCHES = 8
"""Number of searches around the people that the last path crossed; then one around all people: in a crowd of
hundreds each path would cross others, for minutes (our choice)."""

AHEAD_M, AHEAD_STEP_M = 4.0, 0.1
"""Length ahead on a route that is checked against people who moved [m], and the step [m]."""
WORTH_M = 0.5
"""A route is kept if it has become more expensive by less than this, or another one is cheaper by less [m]:
between two routes of about the same cost the robot does not go to and fro (our choice)."""

Kept = PersonalSpace | OSpace


class RouteMap:
    """Routes in one scene; what was computed once is kept."""

    def __init__(self, scene: Scene | Surroundings) -> None:
        require_kinds("route map", scene=(scene, Scene | Surroundings))
        self.surroundings = Surroundings.of(scene) if isinstance(scene, Scene) else scene

    def __getstate__(self) -> dict[str, object]:
        """All but the caches, which cannot be pickled and fill again."""
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
        """A length [m] that no route undercuts, quicker to find; None where there is no route.

        It leads around what stands still alone, and cuts corners as far as rounded ones may.
        """
        free = _space_at_most(self.surroundings.plan, self._clearance_m - CHORD_M)
        if not free.holds(start):
            return math.dist(start, goal)
        least_m = free.least_m(start, goal)
        return None if least_m is None else max(0.0, least_m - 1e-6)

    def route(self, start: XY, goal: XY, *, keep: Mapping[str, float] | None = None) -> Route | None:
        """The route between two places of the robot's centre [m]; None where there is none.

        Args:
            start: A place free of contact; inside a margin it is led out first.
            goal: A place with all margins (`Surroundings.blocker`).
            keep: How far to stay from people, by name, in place of their own distance; between surfaces [m].
        """
        return self._routes(start, goal, tuple((keep or {}).items()))

    def _route(self, start: XY, goal: XY, kept: tuple[tuple[str, float], ...]) -> Route | None:
        keep = dict(kept)
        spaces = self.spaces(start, goal, keep=keep)
        groups = self.groups(start, goal)
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
        return self._shortest(start, goal, self.spaces(start, goal), self.groups(start, goal))

    def to(self, person: str) -> RouteMap:
        """The routes of a visit to a person."""
        return self

    def with_people(self, people: tuple[Person, ...]) -> RouteMap:
        """Routes of the same kind with other positions or preferences of people."""
        return RouteMap(self.surroundings.with_people(people))

    def without(self, names: Collection[str]) -> RouteMap:
        """The routes that there would be without some of the people."""
        people = tuple(person for person in self.surroundings.people if person.name not in names)
        return RouteMap(replace(self.surroundings, people=people))

    def reaches(self, start: XY, goal: XY, *, keep: Mapping[str, float] | None = None) -> bool:
        """Whether there is a route at all; quicker than to find it."""
        return self._reached(start, goal)

    def _reaches(self, start: XY, goal: XY) -> bool:
        floors = _giving_way(self._floors, start, goal)
        return self._around((*floors, *self.groups(start, goal))).joins(start, goal)

    def may_reach(self, start: XY, goals: Sequence[XY]) -> NDArray[np.bool_]:
        """Whether there would be routes without people, to many goals at once; shape (n,)."""
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
        """Whether people moved so that the rest of a route is blocked now, or costs much more than before.

        Args:
            route: One that the robot follows.
            way_m: How far along it the robot is.
            cost_m: What passing people on it cost when it was made.
            keep: As for `route`.
            by_m: What counts as much.
        """
        points = _ahead(route, way_m)
        spaces = self.spaces((points[0][0], points[0][1]), route.goal, keep=keep)
        if any(space.without_comfort().depth_m(points).max() > SLACK_M for space in spaces):
            return True
        return _discomfort_m(spaces, points) > cost_m + by_m

    def has_better(
        self, route: Route, way_m: float, *, keep: Mapping[str, float] | None = None, by_m: float = WORTH_M
    ) -> bool:
        """Whether people made room so that another way costs less than the rest of a route, by a good deal.

        Args:
            route: One that the robot follows.
            way_m: How far along it the robot is.
            keep: As for `route`.
            by_m: What counts as a good deal.
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
        """What passing people costs on the next metres of a route, in metres of detour."""
        points = _ahead(route, way_m)
        return _discomfort_m(self.spaces((points[0][0], points[0][1]), route.goal, keep=keep), points)

    def spaces(
        self, start: XY, goal: XY, *, keep: Mapping[str, float] | None = None
    ) -> tuple[PersonalSpace, ...]:
        """All personal spaces, which give way where the route has to start or end inside them."""
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
        """The o-spaces to keep out of, which give way as far as the robot is in one, or has to be."""
        grown = (group.grown(self.surroundings.robot_radius_m) for group in self.surroundings.o_spaces)
        shrunk = (group.leaving_out(goal, SLACK_M).leaving_out(start, SLACK_M) for group in grown)
        return tuple(group for group in shrunk if group.radius_m > 0.0)

    def _shortest(
        self, start: XY, goal: XY, spaces: tuple[PersonalSpace, ...], groups: tuple[OSpace, ...]
    ) -> Route | None:
        """The shortest path, with only those people on the map that a shorter one would disturb.

        More obstacles never make a shortest way shorter: one that keeps out of all spaces, found around some
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
        if way is None:  # no row of cells leads through a gap as narrow as a cell
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
        """Whether lines through points close together keep off walls and out of spaces."""
        clear = self.surroundings.plan.leave_clear(lines, self._clearance_m - CHORD_M)
        if kept and clear.any():
            points = np.concatenate(lines)
            first = np.cumsum([0, *(len(line) for line in lines[:-1])])
            for each in kept:
                clear &= np.maximum.reduceat(each.depth_m(points), first) < CHORD_M
        return clear


def _giving_way(spaces: Iterable[PersonalSpace], start: XY, goal: XY) -> tuple[PersonalSpace, ...]:
    """Spaces that leave out where a way has to start and end."""
    # A goal may be inside a person's own distance, never inside the margin; a start is where it is.
    to_goal = (each.leaving_out(goal, SLACK_M / 2, least_m=each.floor_m - 2 * SLACK_M) for each in spaces)
    return tuple(each.leaving_out(start, SLACK_M / 2, least_m=each.contact_m) for each in to_goal)


@lru_cache(maxsize=128)
def _free_space(plan: FloorPlan, clearance_m: float, kept: tuple[Kept, ...]) -> FreeSpace:
    """Shared by all maps of a floor plan: where people move, what stands still is the same."""
    return FreeSpace(plan.clear_space(clearance_m), kept)


@lru_cache(maxsize=16)
def _space_at_most(plan: FloorPlan, clearance_m: float) -> FreeSpace:
    """No route leaves it."""
    return FreeSpace(plan.clear_space(clearance_m, at_least=False), ())


@lru_cache(maxsize=256)
def _leaves_clear(plan: FloorPlan, start: XY, goal: XY, clearance_m: float) -> bool:
    """Whether a straight line keeps a distance from what stands still: asked again whenever people move."""
    return bool(plan.leave_clear([np.array([start, goal])], clearance_m).all())


def _ahead(route: Route, way_m: float) -> Points:
    count = math.ceil(min(AHEAD_M, max(route.length_m - way_m, 0.0)) / AHEAD_STEP_M)
    return np.array([route.at(way_m + AHEAD_STEP_M * k) for k in range(count + 1)])


def _discomfort_m(spaces: Iterable[PersonalSpace], points: Points) -> float:
    """What passing people costs at points `AHEAD_STEP_M` apart, in metres of detour."""
    return float(sum(space.discomfort(points).sum() for space in spaces)) * WEIGHT * AHEAD_STEP_M


def _depth_m(kept: Kept, points: Points) -> float:
    return float(kept.depth_m(points).max())


def _bearable(shortest: Route) -> float:
    return DETOUR * shortest.length_m + DETOUR_M


@lru_cache(maxsize=16)
def _between(corners: tuple[XY, ...]) -> Points:
    """Points along a way through corner points, at most 5 cm apart: read only, for they are kept."""
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
