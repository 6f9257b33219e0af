"""The path of a person who is sent somewhere: all of it, or up to a closed door."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from comity_sim2d import Route, RouteMap
from comity_sim2d.pose import XY
from comity_sim2d.scene.obstacles import FloorPlan, floor_plan
from comity_sim2d.scene.surroundings import Surroundings

if TYPE_CHECKING:
    from comity_sim2d import Person, World
    from comity_sim2d.scene.door import Door

DOOR_GAP_M = 0.10
"""Distance from a door's leaf at which a person waits [m], unless it was shut right before them (our
choice)."""
BRUSHES_M = 0.04
"""Minimum clearance to a leaf [m] below which a person is blocked by it; paths keep slightly more."""
STEP_M = 0.01
"""Spacing of the points at which a path is checked against door leaves [m]."""


@dataclass(frozen=True, slots=True)
class SentWay:
    """A path, and its open part."""

    route: Route
    """Path to the destination, around walls and furniture."""
    open_m: float
    """Length of the open part [m]."""
    door: Door | None = None
    """The closed door at its end; None if the path is open."""


def sent_way(
    person: Person,
    to_m: XY,
    world: World,
    *,
    others: tuple[Person, ...] = (),
    before: Iterable[XY] = (),
) -> SentWay | None:
    """The path of a person from their position, with the present states of doors.

    If closed doors block every path, it is the previous path, or that with the initial states of doors, up to
    the first closed door.

    Args:
        person: The person, at their present position.
        to_m: Destination [m].
        world: The world, with its doors.
        others: People to walk around; for all others and the robot they wait.
        before: Points of the rest of the previous path [m].

    Returns:
        None if something other than closed doors blocks every path.
    """
    plan = floor_plan(world.scene, world.doors)
    route = way_of(person, to_m, plan, others)
    if route is not None:
        return SentWay(route, route.length_m)
    if others and way_of(person, to_m, plan) is not None:
        return None
    barred = tuple(before)
    route = Route(barred) if barred else way_of(person, to_m, floor_plan(world.scene))
    return None if route is None else up_to_a_door(route, world.doors, person.radius_m)


def up_to_a_door(route: Route, doors: Iterable[Door], radius_m: float) -> SentWay | None:
    """The part of a path before its first closed door; None without one.

    Args:
        route: A path, possibly through doors.
        doors: Doors in their present states.
        radius_m: Radius of the person [m].
    """
    from shapely import LineString, distance, points

    marks_m = np.linspace(0.0, route.length_m, round(route.length_m / STEP_M) + 2)
    at = points([route.at(float(mark_m)) for mark_m in marks_m])
    found: tuple[int, int, Door] | None = None
    for door in (door for door in doors if not door.is_open):
        gaps_m = distance(at, LineString([door.start, door.end])) - door.thickness_m / 2 - radius_m
        through = np.flatnonzero((gaps_m < BRUSHES_M) & (gaps_m < gaps_m[0]))  # may walk away from it
        if through.size and (found is None or through[0] < found[0]):
            clear = np.flatnonzero(gaps_m[: through[0]] >= DOOR_GAP_M)
            found = int(through[0]), int(clear[-1]) if clear.size else 0, door
    return None if found is None else SentWay(route, float(marks_m[found[1]]), found[2])


def way_of(person: Person, to_m: XY, plan: FloorPlan, others: tuple[Person, ...] = ()) -> Route | None:
    """The path of a person through a place, or None.

    Args:
        person: The person, at their present position.
        to_m: Destination [m].
        plan: The floor plan, with its walls and furniture.
        others: People to walk around; for all others and the robot they wait.
    """
    route = RouteMap(Surroundings(plan, others, person.radius_m)).route(person.xy, to_m)
    if route is None or plan.wall_between(*route.points[:2]) is not None:
        return None  # a start in a margin is moved to the nearest free point, even on the other side
    return route
