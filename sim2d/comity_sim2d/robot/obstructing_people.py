"""Obstructing people: those who leave no route around them, or only a much longer one."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice

from comity_fis.listing import with_verb
from comity_fis.proxemics import COMFORT_M
from comity_sim2d.navigation.barrier import MOST_TRIED, barrier, who_bars
from comity_sim2d.navigation.past_people import without_people
from comity_sim2d.navigation.route import Route
from comity_sim2d.navigation.route_map import WORTH_M, RouteMap
from comity_sim2d.pose import XY
from comity_sim2d.robot.approach import FOLLOWS_S, Approach
from comity_sim2d.scene.o_space import OSpace
from comity_sim2d.scene.person import Person
from comity_sim2d.scene.surroundings import Surroundings

STEP_M = 0.05
"""Step along the path in the search for obstructing people [m]."""
ARRIVED_M = 0.05
"""Distance from the waiting place at which the robot waits [m]."""
NEARER_M = 0.1
"""Progress between two waits that justifies going on [m] (our choice)."""
MAY_FAIL = 3
"""Number of times in a row that it goes on at once without progress: short openings add up to a path past
people (our choice)."""
HOLD_S, LONGEST_HOLD_S = 1.0, 4.0
"""After that it waits at least `HOLD_S` [s], doubling each time up to `LONGEST_HOLD_S` [s]. In 4 s, the
horizon of predicted walks, a person who walks to and fro in a room has turned round (our choice)."""
Met = tuple[float, tuple[str, ...]]
"""Position along a path [m], and the people who are too near to it there, or between whom it leads."""


@dataclass(frozen=True, slots=True)
class ObstructingPeople:
    """People who would have to make way."""

    people: tuple[str, ...]
    """People each of whom alone could open the path; if no one could, all of them together."""
    wait_xy: XY
    """Waiting place on the path, at their own distance, and not among them [m]."""
    left_m: float
    """Length of the path if they make way [m]."""

    @property
    def words(self) -> str:
        """Their names with the verb: `a and b are`."""
        return with_verb(self.people, "is", "are")


def in_the_way(
    route_map: RouteMap, start: XY, goal: XY, *, visited: str, keep_m: float, detour_m: float
) -> ObstructingPeople | None:
    """The nearest people who block the shortest path, if a route around people is too long; else None.

    A group also blocks a path with the space between its members.

    Args:
        route_map: Routes around people.
        start: Position of the robot [m].
        goal: Goal position [m].
        visited: The visited person: an obstacle, but obstructing only if nothing else is, for example a
            person who walks off along a passage and has to be met from the front.
        keep_m: Distance of the docking pose from them [m].
        detour_m: Maximum additional length of the route around people [m].
    """
    keep = {visited: keep_m}
    any_way_will_do = math.isinf(detour_m)
    if any_way_will_do and route_map.reaches(start, goal, keep=keep):
        return None
    around = None if any_way_will_do else route_map.route(start, goal, keep=keep)
    if around is not None and around.length_m <= math.dist(start, goal) + detour_m:
        return None  # no path is shorter than the straight line
    place = route_map.surroundings
    direct = without_people(place, (visited,)).route(start, goal, keep=keep)
    if direct is None:
        return _in_their_own_way(route_map, start, goal, visited)
    if around is not None and around.length_m <= direct.length_m + detour_m:
        return None
    longest_m = direct.length_m + detour_m
    others = [person for person in place.people if person.name != visited]

    def bars(people: Collection[str]) -> bool:
        if len(people) in (0, len(others)):
            return bool(people)  # the path that they leave is the direct one, or the one around all people
        ways = without_people(place, (visited, *people))
        if any_way_will_do:
            return not ways.reaches(start, goal, keep=keep)
        length_m = ways.length(start, goal, keep=keep)
        return length_m is None or length_m > longest_m

    found = _first(islice(_along(direct, route_map, start, others), MOST_TRIED), place, visited, bars)
    return None if found is None else _waiting(direct, found, route_map, start)


class PathObstruction:
    """Obstructing people of one approach, searched for when the map or the goal has changed.

    The robot waits at once, and goes on at once if a path opens. If the path repeatedly closes before the
    robot gets nearer, it waits longer each time. Otherwise it would go to and fro with people who walk to and
    fro.

    Args:
        detour_m: Maximum additional length of the route around people [m].
        to: The person or place that the robot approaches.
    """

    def __init__(self, detour_m: float, to: str = "") -> None:
        self.detour_m = detour_m
        self.to = to
        self.now: ObstructingPeople | None = None
        self._found: ObstructingPeople | None = None
        """Result of the last search; `now` may outlast it."""
        self._map: RouteMap | None = None
        self._goal: XY | None = None
        self._looked_s = -math.inf
        self._waits_s, self._least_m = -math.inf, math.inf
        """Start of the current wait [s], and shortest remaining distance at a wait so far [m]."""
        self._in_vain = 0
        """Number of times in a row that it went on and came no nearer."""
        self._hold_s = 0.0
        """Minimum wait, given the result of the last one [s]."""

    @property
    def people(self) -> tuple[str, ...]:
        """People it waits for; empty if it goes on."""
        return self.now.people if self.now else ()

    def look(self, route_map: RouteMap, start: XY, goal: XY, approach: Approach, now_s: float) -> XY:
        """The position to go to: the goal, or the waiting place [m]."""
        if self._has_changed(route_map, goal, approach, now_s):
            self._looked_s = now_s
            self._found = self._in_the_way(route_map, start, goal, approach)
            self._map, self._goal = route_map, goal
        self._decide(now_s)
        return self.now.wait_xy if self.now else goal

    def _decide(self, now_s: float) -> None:
        if self._found is not None:
            if self.now is None:
                self._begin_to_wait(self._found.left_m, now_s)
            self.now = self._found
        elif now_s - self._waits_s >= self._hold_s:
            self.now = None

    def _begin_to_wait(self, left_m: float, now_s: float) -> None:
        self._waits_s = now_s
        if left_m <= self._least_m - NEARER_M:
            self._least_m, self._in_vain = left_m, 0
        else:
            self._in_vain += 1
        doublings = self._in_vain - MAY_FAIL - 1
        self._hold_s = min(HOLD_S * 2.0**doublings, LONGEST_HOLD_S) if doublings >= 0 else 0.0

    def _in_the_way(
        self, route_map: RouteMap, start: XY, goal: XY, approach: Approach
    ) -> ObstructingPeople | None:
        short = approach.remaining_m <= math.dist(start, goal) + self.detour_m
        if short and approach.leads_to(goal, route_map):
            return None  # and so no other route has to be found
        visited, keep_m = approach.person, approach.pose.distance_m
        # A waiting robot goes on only for a path that is shorter by a margin: otherwise noise would make it
        # start and stop.
        detour_m = self.detour_m - (min(WORTH_M, self.detour_m / 2) if self.now else 0.0)
        return in_the_way(route_map, start, goal, visited=visited, keep_m=keep_m, detour_m=detour_m)

    def _has_changed(self, route_map: RouteMap, goal: XY, approach: Approach, now_s: float) -> bool:
        if route_map is not self._map or self._goal is None:
            return True
        # A robot that gave way may have lost its route among people who stand as they did.
        is_lost = self._found is None and not approach.has_route
        has_moved = math.dist(self._goal, goal) > STEP_M
        return (is_lost or has_moved) and now_s - self._looked_s >= FOLLOWS_S


def _in_their_own_way(route_map: RouteMap, start: XY, goal: XY, visited: str) -> ObstructingPeople | None:
    """The visited person, if they alone block the path to the place before them."""
    direct = without_people(route_map.surroundings).route(start, goal)
    if direct is None:
        return None
    themselves = [person for person in route_map.surroundings.people if person.name == visited]
    met = next(_along(direct, route_map, start, themselves), None)
    return None if met is None else _waiting(direct, met, route_map, start)


def _waiting(direct: Route, met: Met, route_map: RouteMap, start: XY) -> ObstructingPeople:
    way_m, people = met
    return ObstructingPeople(people, _wait(direct, way_m, people, route_map, start), direct.length_m)


def _first(
    met: Iterable[Met], place: Surroundings, visited: str, bars: Callable[[Collection[str]], bool]
) -> Met | None:
    """The nearest blocking people, with those next to them; if only all together block it, the nearest."""
    first: Met | None = None
    for way_m, names in met:
        first = first or (way_m, names)
        people = barrier(place, names, visited)
        if len(people) <= MOST_TRIED and bars(people):
            return way_m, who_bars(people, bars)
    return first


def _along(direct: Route, route_map: RouteMap, start: XY, others: Sequence[Person]) -> Iterator[Met]:
    """People whom the path comes too near to, or leads between, and where: one entry per set of people."""
    place = route_map.surroundings
    spaces = route_map.groups(start, direct.goal)
    before: set[str] = set()
    for step in range(math.ceil(direct.length_m / STEP_M) + 1):
        xy = direct.at(min(step * STEP_M, direct.length_m))
        among = {name for space in spaces if _is_in(space, xy) for name in space.members}
        near = {person.name for person in others if person.gap_m(xy, place.robot_radius_m) < person.margin_m}
        met = tuple(person.name for person in others if person.name in {*near, *among})
        if not before.issuperset(met):
            yield step * STEP_M, met
        before.update(met)


def _wait(direct: Route, way_m: float, people: Collection[str], route_map: RouteMap, start: XY) -> XY:
    """The last reachable place before some people that keeps their distance, or the start [m]."""
    place = route_map.surroundings
    crowded = [(p, max(COMFORT_M, p.personal_distance_m or 0.0)) for p in place.people if p.name in people]
    spaces = route_map.groups(start, direct.goal)
    for step in range(math.floor(way_m / STEP_M), 0, -1):
        xy = direct.at(step * STEP_M)
        if any(person.gap_m(xy, place.robot_radius_m) < away_m for person, away_m in crowded):
            continue
        among = any(_is_in(space, xy) for space in spaces)
        if not among and place.blocker(xy) is None and route_map.reaches(start, xy):
            return xy
    return start


def _is_in(space: OSpace, xy: XY) -> bool:
    return math.dist(space.xy, xy) < space.radius_m
