"""Who is in the way: somebody around whom there is no way, or only a much longer one."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from comity_sim2d.approach import Approach
from comity_sim2d.obstacles import PERSON_MARGIN_M, Surroundings
from comity_sim2d.past_people import without_people
from comity_sim2d.pose import XY
from comity_sim2d.route import Route
from comity_sim2d.route_map import COMFORT_M, RouteMap
from comity_sim2d.scene import Person

STEP_M = 0.05
"""The way is looked along in steps of this length."""
EVERY_LOOKS = 5
"""Where people move all the time and nobody is in the way, every fifth tick is enough (our choice)."""
ARRIVED_M = 0.05
"""So near the place to wait at, the robot waits."""


@dataclass(frozen=True, slots=True)
class InTheWay:
    """Somebody who would have to make way."""

    person: str
    wait_xy: XY
    """Where to wait: on the way, as far from them as they like robots to be."""


def in_the_way(
    route_map: RouteMap, start: XY, goal: XY, *, visited: str, keep_m: float, detour_m: float
) -> InTheWay | None:
    """The first on the shortest way, where a way around people is too long; None where it is not.

    Args:
        route_map: Routes around people.
        start: Where the robot is.
        goal: Where it is to go.
        visited: Whom it visits: not in the way, and not to be driven over.
        keep_m: How far from them its pose is.
        detour_m: How much longer the way around may be.
    """
    keep = {visited: keep_m}
    any_way_will_do = math.isinf(detour_m)
    if any_way_will_do and route_map.reaches(start, goal, keep=keep):
        return None
    around = None if any_way_will_do else route_map.route(start, goal, keep=keep)
    if around is not None and around.length_m <= math.dist(start, goal) + detour_m:
        return None  # no way is shorter than the straight line
    direct = without_people(route_map.surroundings, visited).route(start, goal, keep=keep)
    if direct is None or (around is not None and around.length_m <= direct.length_m + detour_m):
        return None
    return next(_along(direct, route_map, start, visited), None)


class Hindrance:
    """Who is in the way of one approach, looked for when the map or the goal has changed.

    Args:
        detour_m: How much longer the way around people may be.
    """

    def __init__(self, detour_m: float) -> None:
        self.detour_m = detour_m
        self.now: InTheWay | None = None
        self._looks = 0
        self._map: RouteMap | None = None
        self._goal: XY | None = None

    def look(self, route_map: RouteMap, start: XY, goal: XY, approach: Approach) -> XY:
        """Where to go now: the goal, or the place to wait at."""
        self._looks += 1
        due = self._goal is None or self.now is not None or self._looks >= EVERY_LOOKS
        if due and self._has_changed(route_map, goal):
            self._looks = 0
            self.now = self._in_the_way(route_map, start, goal, approach)
            self._map, self._goal = route_map, goal
        return self.now.wait_xy if self.now else goal

    def _in_the_way(self, route_map: RouteMap, start: XY, goal: XY, approach: Approach) -> InTheWay | None:
        short = approach.remaining_m <= math.dist(start, goal) + self.detour_m
        if short and approach.leads_to(goal, route_map):
            return None  # and so no other route has to be found
        visited, keep_m = approach.person, approach.pose.distance_m
        return in_the_way(route_map, start, goal, visited=visited, keep_m=keep_m, detour_m=self.detour_m)

    def _has_changed(self, route_map: RouteMap, goal: XY) -> bool:
        return route_map is not self._map or self._goal is None or math.dist(self._goal, goal) > STEP_M


def _along(direct: Route, route_map: RouteMap, start: XY, visited: str) -> Iterator[InTheWay]:
    """Everybody within whose margin the way leads, from the first on."""
    place = route_map.surroundings
    others = [person for person in place.people if person.name != visited]
    for step in range(math.ceil(direct.length_m / STEP_M) + 1):
        xy = direct.at(min(step * STEP_M, direct.length_m))
        for person in others:
            if _gap_m(person, xy, place) < PERSON_MARGIN_M:
                yield InTheWay(person.name, _wait(direct, step * STEP_M, person, route_map, start))


def _wait(direct: Route, way_m: float, person: Person, route_map: RouteMap, start: XY) -> XY:
    """The last place before somebody where they are not crowded and that can be reached, or the start."""
    place = route_map.surroundings
    away_m = max(COMFORT_M, person.personal_distance_m or 0.0)
    for step in range(math.floor(way_m / STEP_M), 0, -1):
        xy = direct.at(step * STEP_M)
        if _gap_m(person, xy, place) >= away_m and place.blocker(xy) is None and route_map.reaches(start, xy):
            return xy
    return start


def _gap_m(person: Person, xy: XY, place: Surroundings) -> float:
    return math.dist(person.xy, xy) - person.radius_m - place.robot_radius_m
