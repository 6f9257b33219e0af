"""How long the robot takes from one person to the next, computed so that culture has no say in it.

A deadline that some people's taste could break would decide who is served, and so would the price of a way
that bends around a person who likes to be passed at a distance. So the robot is sent, in thought, to the same
distance from everybody, passes everybody at the same distance, and within 1.5 m of the person it visits is as
slow as any rule may want. What the plan promises is therefore late rather than early.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import islice, product
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from comity_domain import Way
from comity_sim2d import spot_pose
from comity_sim2d.base.drive import NEAR_PEOPLE_M
from comity_sim2d.pose import XY

if TYPE_CHECKING:
    from comity_sim2d import Pose, RouteMap, Scene
    from comity_sim2d.navigation.route import Route
    from comity_sim2d.scene.person import Person


CRUISE_M_S = 0.6
"""On the way: the base's 0.7 m/s, with its speeding up and slowing down."""
SLOWEST_M_S = 0.2
"""Near the person: the slow end of what the rules of bruno2017 range over. The slowest that they give
anybody is 0.278 m/s; with that, who is reached through a narrow place could be greeted 0.2 s late."""
LAST_M = 1.2
"""The least that is driven so slowly: from 1.5 m to the shortest distance that may be wanted."""
SAMPLE_M = 0.05
"""Between the points of a route at which its distance to the person is taken."""
SETTLING_S = 3.0
"""To come to rest and to turn to the person."""
PASSING_M = 1.2
"""The farthest that the rules of bruno2017 let anybody be passed."""
DISTANCES_M = (0.8, 0.5, 1.1)
BEARINGS_DEG = (0.0, 45.0, -45.0, 90.0, -90.0)
"""Where the robot is taken to stop: the first of these that is free, in front before beside the person."""
ALL_DISTANCES_M = tuple(k * 0.05 for k in range(6, 25))
ALL_BEARINGS_DEG = tuple(5.0 * k for k in range(-18, 19))
"""Where none is: the first of these, the nearest to the person first."""


class Journey(NamedTuple):
    """What the time of a way depends on."""

    length_m: float
    slow_m: float = LAST_M
    """As much of the length as is driven within 1.5 m of the body of the person who is visited."""

    def seconds(self, attend_s: float = 0.0) -> float:
        """How long it takes, with settling at its end and watching how the person takes it."""
        fast_m = max(0.0, self.length_m - self.slow_m)
        return fast_m / CRUISE_M_S + self.slow_m / SLOWEST_M_S + SETTLING_S + attend_s


class TravelDistances:
    """From the start, everybody and every place to everybody and every place else, by routes.

    Args:
        scene: Where the robot starts.
        route_map: The routes that it may take: where these lead past people, so do the ways.
        people: Who may be visited, each with where the robot may stand before them: it is sent there, in
            thought, only if no place is free in steps of 5 cm and 5 deg, which are everybody's, or if that
            one is cut off from where it comes from or goes, as one side of a person may be.
        kept: Where the robot stands to fetch things, by the place's name.
    """

    def __init__(
        self,
        scene: Scene,
        route_map: RouteMap,
        people: Mapping[str, Sequence[XY]],
        kept: Mapping[str, Pose],
    ) -> None:
        start, everybody = scene.robot.pose.xy, route_map.surroundings.people
        self._map = route_map.with_people(
            tuple(replace(person, personal_distance_m=PASSING_M) for person in everybody)
        )
        self._people: dict[str | None, Person] = {person.name: person for person in everybody}
        self._at: dict[str | None, Sequence[XY]] = {None: (start,)}
        self._at |= {
            name: (*islice(_places(name, start, self._map), 1), *own) for name, own in people.items()
        }
        self._at |= {name: (pose.xy,) for name, pose in kept.items()}

    def measured(self, way: Way) -> Journey | None:
        """A way along its route; None if no route leads there."""
        origin, goal = way
        person = self._people.get(goal)
        for here, there in product(self._at[origin], self._at[goal]):
            route = self._map.route(here, there)
            if route is not None:
                slow_m = LAST_M if person is None else max(LAST_M, self._near_m(route, person))
                least = self._least(way)
                return Journey(max(route.length_m, least.length_m if least else 0.0), slow_m)
        return None

    def all_measured(self) -> dict[Way, Journey]:
        """Every way by its route."""
        return self._all(self.measured)

    def least(self) -> dict[Way, Journey]:
        """Of every way a length and a time that it does not undercut."""
        return self._all(self._least)

    def _least(self, way: Way) -> Journey | None:
        """The length from the first places that are joined."""
        origin, goal = way
        for here, there in product(self._at[origin], self._at[goal]):
            least_m = self._map.least_length(here, there)
            if least_m is not None:
                return Journey(least_m)
        return None

    def _near_m(self, route: Route, person: Person) -> float:
        """How much of a route is within `NEAR_PEOPLE_M` of a person's body [m]."""
        count = max(1, math.ceil(route.length_m / SAMPLE_M))
        piece_m = route.length_m / count
        points = np.array([route.at((k + 0.5) * piece_m) for k in range(count)])
        reach_m = NEAR_PEOPLE_M + person.radius_m + self._map.surroundings.robot_radius_m
        return piece_m * int((np.hypot(*(points - person.xy).T) <= reach_m).sum())

    def _all(self, journey_of: Callable[[Way], Journey | None]) -> dict[Way, Journey]:
        return {
            (origin, goal): journey
            for origin, goal in product(self._at, self._at)
            if goal is not None and origin != goal
            if (journey := journey_of((origin, goal))) is not None
        }


def _places(name: str, start: XY, route_map: RouteMap) -> Iterator[XY]:
    place, ways = route_map.surroundings, route_map.to(name)
    usual = ((distance_m, bearing_deg) for bearing_deg, distance_m in product(BEARINGS_DEG, DISTANCES_M))
    for pairs in (list(usual), list(product(ALL_DISTANCES_M, ALL_BEARINGS_DEG))):
        spots = [spot_pose(place, name, *pair).xy for pair in pairs]
        free = place.are_free(spots, visited=name).tolist()
        yield from (xy for xy, ok in zip(spots, free, strict=True) if ok and ways.reaches(start, xy))
