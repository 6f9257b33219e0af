"""The way of a person who is sent somewhere: all of it, or up to a door that is shut."""

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
"""Whoever waits for a door stands so far from its leaf, unless it was shut before their nose (our choice)."""
BRUSHES_M = 0.04
"""Who would come nearer to a leaf than this gets through it: ways keep a little farther off."""
STEP_M = 0.01
"""A way is held against the leaves of doors at points so far apart."""


@dataclass(frozen=True, slots=True)
class SentWay:
    """A way, and how much of it is open."""

    route: Route
    """To where they are sent, around walls and furniture."""
    open_m: float
    """So far they get."""
    door: Door | None = None
    """What they wait for there; None: it is open to its end."""


def sent_way(
    person: Person,
    to_m: XY,
    world: World,
    *,
    others: tuple[Person, ...] = (),
    before: Iterable[XY] = (),
) -> SentWay | None:
    """The way of a person from where they are, with the doors as they are now.

    Where shut doors bar every way, it is the one that they were going, or would if no door had turned since
    the start, up to the first door on it that is shut.

    Args:
        person: Who is sent, where they stand now.
        to_m: Where to.
        world: With its doors.
        others: Who is gone around, too; all others and the robot are waited for.
        before: What is left of the way that they were going: its points.

    Returns:
        None where no way leads there that only doors bar.
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
    """As much of a way as is open before the first shut door on it; None where none is on it.

    Args:
        route: That may lead through doors.
        doors: As they are.
        radius_m: Of who goes there.
    """
    from shapely import LineString, distance, points

    marks_m = np.linspace(0.0, route.length_m, round(route.length_m / STEP_M) + 2)
    at = points([route.at(float(mark_m)) for mark_m in marks_m])
    found: tuple[int, int, Door] | None = None
    for door in (door for door in doors if not door.is_open):
        gaps_m = distance(at, LineString([door.start, door.end])) - door.thickness_m / 2 - radius_m
        through = np.flatnonzero((gaps_m < BRUSHES_M) & (gaps_m < gaps_m[0]))  # who is near may go away
        if through.size and (found is None or through[0] < found[0]):
            clear = np.flatnonzero(gaps_m[: through[0]] >= DOOR_GAP_M)
            found = int(through[0]), int(clear[-1]) if clear.size else 0, door
    return None if found is None else SentWay(route, float(marks_m[found[1]]), found[2])


def way_of(person: Person, to_m: XY, plan: FloorPlan, others: tuple[Person, ...] = ()) -> Route | None:
    """The way of a person through a place; None where there is none.

    Args:
        person: Who walks, from where they stand.
        to_m: Where to.
        plan: Its walls and furniture are gone around.
        others: Who is gone around, too; all others and the robot are waited for.
    """
    route = RouteMap(Surroundings(plan, others, person.radius_m)).route(person.xy, to_m)
    if route is None or plan.wall_between(*route.points[:2]) is not None:
        return None  # who stands in a margin is led to the nearest free place, on the other side even
    return route
