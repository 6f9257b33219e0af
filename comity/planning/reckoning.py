"""How long the robot takes from one person to the next, reckoned so that culture has no say in it.

A deadline that some people's taste could break would decide who is served, and so would the price of a way
that bends around somebody who likes to be passed at a distance. So the robot is sent, in thought, to the same
distance from everybody, passes everybody at the same distance, and comes near as slowly as any rule may
want. What the plan promises is therefore late rather than early.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from itertools import product
from typing import TYPE_CHECKING

from comity_domain import Way
from comity_sim2d import RouteMap, spot_pose

if TYPE_CHECKING:
    from comity_sim2d import Pose, Scene

XY = tuple[float, float]

CRUISE_M_S = 0.6
"""On the way: the base's 0.7 m/s, with its speeding up and slowing down."""
LAST_M, SLOWEST_M_S = 1.2, 0.2
"""The last stretch, at the slow end of what the rules of bruno2017 range over. The slowest that they give
anybody is 0.278 m/s; with that, who is reached through a narrow place could be greeted 0.2 s late."""
SETTLING_S = 3.0
"""To come to rest and to turn to the person."""
PASSING_M = 1.2
"""The farthest that the rules of bruno2017 let anybody be passed."""
DISTANCES_M = (0.8, 0.5, 1.1)
BEARINGS_DEG = (0.0, 45.0, -45.0, 90.0, -90.0)
"""Where the robot is taken to stop: the first of these that is free."""
ALL_DISTANCES_M = tuple(k * 0.05 for k in range(6, 25))
ALL_BEARINGS_DEG = tuple(5.0 * k for k in range(-18, 19))
"""Where none is: the first of these, the nearest to the person first."""


class Ways:
    """From the start, everybody and every place to everybody and every place else, by routes.

    Args:
        scene: Where everybody stands.
        people: Who may be visited, each with where the robot may stand before them: it is sent there, in
            thought, only if no place is free in steps of 5 cm and 5 deg, which are everybody's.
        kept: Where the robot stands to fetch things, by the place's name.
    """

    def __init__(self, scene: Scene, people: Mapping[str, XY], kept: Mapping[str, Pose]) -> None:
        start = scene.robot.pose.xy
        alike = tuple(replace(person, personal_distance_m=PASSING_M) for person in scene.people)
        self._map = RouteMap(replace(scene, people=alike))
        places = {name: next(_places(name, start, self._map), own) for name, own in people.items()}
        places |= {name: pose.xy for name, pose in kept.items()}
        self._at: dict[str | None, XY] = {None: start} | dict(places)

    def length_m(self, way: Way) -> float | None:
        """The length of a way; None where there is none."""
        origin, goal = way
        return self._map.length(self._at[origin], self._at[goal])

    def lengths_m(self) -> dict[Way, float]:
        """The length of every way."""
        return self._all(self._map.length)

    def least_m(self) -> dict[Way, float]:
        """Of every way a length that it does not undercut."""
        return self._all(self._map.least_length)

    def _all(self, length_of: Callable[[XY, XY], float | None]) -> dict[Way, float]:
        return {
            (origin, goal): length
            for origin, here in self._at.items()
            for goal, there in self._at.items()
            if goal is not None and origin != goal
            if (length := length_of(here, there)) is not None
        }


def seconds(length_m: float, attend_s: float = 0.0) -> float:
    """What a way takes, with coming near at its end and watching how the person takes it."""
    return max(0.0, length_m - LAST_M) / CRUISE_M_S + LAST_M / SLOWEST_M_S + SETTLING_S + attend_s


def _places(name: str, start: XY, route_map: RouteMap) -> Iterator[XY]:
    place = route_map.surroundings
    for pairs in (product(DISTANCES_M, BEARINGS_DEG), product(ALL_DISTANCES_M, ALL_BEARINGS_DEG)):
        spots = [spot_pose(place, name, *pair).xy for pair in pairs]
        free = place.are_free(spots, visited=name).tolist()
        yield from (xy for xy, ok in zip(spots, free, strict=True) if ok and route_map.reaches(start, xy))
