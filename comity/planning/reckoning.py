"""How long the robot takes from one person to the next, reckoned so that culture has no say in it.

A deadline that some people's taste could break would decide who is served, and so would the price of a way
that bends around somebody who likes to be passed at a distance. So the robot is sent, in thought, to the same
distance from everybody, passes everybody at the same distance, and comes near as slowly as any rule may
want. What the plan promises is therefore late rather than early.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import islice, product, starmap
from typing import TYPE_CHECKING

from comity_domain import Way
from comity_sim2d import spot_pose

if TYPE_CHECKING:
    from comity_sim2d import Pose, RouteMap, Scene

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
        scene: Where the robot starts.
        route_map: The routes that it may take: where these lead past people, so do the ways.
        people: Who may be visited, each with where the robot may stand before them: it is sent there, in
            thought, only if no place is free in steps of 5 cm and 5 deg, which are everybody's, or if that
            one is cut off from where it comes from or goes, as one side of somebody may be.
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
        self._at: dict[str | None, Sequence[XY]] = {None: (start,)}
        self._at |= {
            name: (*islice(_places(name, start, self._map), 1), *own) for name, own in people.items()
        }
        self._at |= {name: (pose.xy,) for name, pose in kept.items()}

    def length_m(self, way: Way) -> float | None:
        """The length of a way; None where there is none."""
        length_m = self._between(way, self._map.length)
        return None if length_m is None else max(length_m, self._least_m(way) or 0.0)

    def lengths_m(self) -> dict[Way, float]:
        """The length of every way."""
        return self._all(self.length_m)

    def least_m(self) -> dict[Way, float]:
        """Of every way a length that it does not undercut."""
        return self._all(self._least_m)

    def _least_m(self, way: Way) -> float | None:
        return self._between(way, self._map.least_length)

    def _between(self, way: Way, length_of: Callable[[XY, XY], float | None]) -> float | None:
        """The length from the first places that are joined."""
        origin, goal = way
        lengths = starmap(length_of, product(self._at[origin], self._at[goal]))
        return next((length for length in lengths if length is not None), None)

    def _all(self, length_of: Callable[[Way], float | None]) -> dict[Way, float]:
        return {
            (origin, goal): length
            for origin, goal in product(self._at, self._at)
            if goal is not None and origin != goal
            if (length := length_of((origin, goal))) is not None
        }


def seconds(length_m: float, attend_s: float = 0.0) -> float:
    """What a way takes, with coming near at its end and watching how the person takes it."""
    return max(0.0, length_m - LAST_M) / CRUISE_M_S + LAST_M / SLOWEST_M_S + SETTLING_S + attend_s


def _places(name: str, start: XY, route_map: RouteMap) -> Iterator[XY]:
    place, ways = route_map.surroundings, route_map.to(name)
    for pairs in (product(DISTANCES_M, BEARINGS_DEG), product(ALL_DISTANCES_M, ALL_BEARINGS_DEG)):
        spots = [spot_pose(place, name, *pair).xy for pair in pairs]
        free = place.are_free(spots, visited=name).tolist()
        yield from (xy for xy, ok in zip(spots, free, strict=True) if ok and ways.reaches(start, xy))
