"""Route lengths between all positions: measured, or quick lower bounds, and how to measure the rest."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import cache
from typing import TYPE_CHECKING

from comity_domain import START, Leg, Spot, Survey, Way
from comity_sim2d.pose import XY

if TYPE_CHECKING:
    from comity.planning.travel_distances import Journey, TravelDistances
    from comity_sim2d import RouteMap, Scene


class Lengths:
    """The routes between the spots of a request, and the ways without culture.

    Args:
        scene: Where everybody stands.
        route_map: Its routes.
        spots: Where the robot may stand.
        ways: Between people and places; None where nothing hangs on them.
        attend_s: How long the robot watches how each person takes its coming.
    """

    def __init__(
        self,
        scene: Scene,
        route_map: RouteMap,
        spots: Mapping[Spot, XY],
        ways: TravelDistances | None,
        attend_s: float,
    ) -> None:
        self._map = route_map
        self._at = {START: scene.robot.pose.xy, **spots}
        self._ways = ways
        self._attend_s = attend_s
        self._legs_m: dict[Leg, float | None] = {}
        self._measured: dict[Way, Journey | None] = {}

    def travel(self, *, least: bool) -> dict[Leg, float]:
        """Route lengths from the robot's start and from every spot to every spot of another person [m].

        Args:
            least: Bounds in their place.
        """
        length_of: Callable[[XY, XY], float | None] = (
            cache(self._map.least_length) if least else self._map.length
        )
        return {
            (origin, goal): length
            for origin, here in self._at.items()
            for goal, there in self._at.items()
            if goal != START and (origin == START or origin.place != goal.place)
            if (length := length_of(here, there)) is not None
        }

    def ways(self, *, least: bool) -> dict[Way, Journey]:
        """The ways without culture.

        Args:
            least: Bounds in their place.
        """
        if self._ways is None:
            return {}
        return self._ways.least() if least else self._ways.all_measured()

    def survey(self, legs: Iterable[Leg], ways: Iterable[Way]) -> Survey:
        """How to measure those of which only bounds are known."""
        return Survey(
            legs=frozenset(legs),
            ways=frozenset(ways),
            leg_m=self._leg_m,
            way=self._way,
        )

    def _leg_m(self, leg: Leg) -> float | None:
        if leg not in self._legs_m:
            start, end = leg
            self._legs_m[leg] = self._map.length(self._at[start], self._at[end])
        return self._legs_m[leg]

    def _way(self, way: Way) -> tuple[float, float] | None:
        if way not in self._measured:
            self._measured[way] = None if self._ways is None else self._ways.measured(way)
        journey = self._measured[way]
        return None if journey is None else (journey.length_m, journey.seconds(self._attend_s))
