"""Positions from which a group can be greeted at once: all members see and hear the robot."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING

from comity_domain import Company, Spot
from comity_fis.proxemics import COMFORT_M, WIDEST_DEG
from comity_sim2d import Pose, docked
from comity_sim2d.pose import XY

if TYPE_CHECKING:
    from comity_sim2d import RouteMap


FARTHEST_M = 2.1
"""The end of the close phase of social distance (Hall 1966); that a greeting carries so far is our choice."""
NO_LIMITS: Mapping[str, float] = MappingProxyType({})


def companies(
    groups: Mapping[str, Sequence[str]],
    route_map: RouteMap,
    spots: Mapping[Spot, XY],
    widest_deg: Mapping[str, float] = NO_LIMITS,
) -> tuple[Company, ...]:
    """The groups as companies of those members who can be visited.

    Args:
        groups: Members by the group's name.
        route_map: The place, and who stands where.
        spots: Where the robot may stand beside each person.
        widest_deg: How far round from where they face the robot may stand, by person; 90 degrees of others.
    """
    there = {spot.place for spot in spots}
    present = {name: tuple(member for member in group if member in there) for name, group in groups.items()}
    return tuple(
        Company(name, members, dict(_overlooks(members, route_map, spots, widest_deg)))
        for name, members in present.items()
        if len(members) > 1
    )


def _overlooks(
    members: Sequence[str],
    route_map: RouteMap,
    spots: Mapping[Spot, XY],
    widest_deg: Mapping[str, float],
) -> Iterator[tuple[Spot, Mapping[str, float]]]:
    for spot, xy in spots.items():
        if spot.place in members:
            others = [member for member in members if member != spot.place]
            nearness = {
                name: _distance_m(name, xy, route_map, widest_deg.get(name, WIDEST_DEG)) for name in others
            }
            near = {name: distance for name, distance in nearness.items() if distance is not None}
            if len(near) == len(others):
                yield spot, near


def _distance_m(name: str, xy: XY, route_map: RouteMap, widest_deg: float) -> float | None:
    """How far a person is from the robot; None where they do not see it or are not within earshot."""
    place = route_map.surroundings
    person = place.person(name)
    stands = docked(Pose(*xy, 0.0), place.robot_radius_m, person)
    sees = abs(stands.bearing_deg) <= widest_deg and place.plan.wall_between(person.xy, xy) is None
    near = COMFORT_M <= stands.distance_m <= FARTHEST_M or math.isclose(stands.distance_m, COMFORT_M)
    return stands.distance_m if sees and near else None
