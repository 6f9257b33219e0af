"""Doors in walls: each door cuts a gap out of its wall."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from comity_sim2d.pose import XY
from comity_sim2d.scene.area import Area
from comity_sim2d.scene.door import LEAF_M, Door
from comity_sim2d.scene.room import Room, Wall
from comity_sim2d.scene_error import SceneError

OFF_M = 0.05
"""Maximum distance of a door's centre from the centre line of its wall [m] (our choice: a typo, not another
wall)."""

ASIDE_M = 0.2
"""Distance from a door's centre at which the room next to it is looked up [m]."""


@dataclass(frozen=True, slots=True)
class WantedDoor:
    """A door whose wall is not yet known."""

    name: str
    at: XY
    """Its centre [m]."""
    width_m: float
    is_open: bool = True
    kind: str = "hinged"


@dataclass(frozen=True, slots=True)
class _Gap:
    """A door's gap: start and end along the wall, from the wall's start [m]."""

    wanted: WantedDoor
    wall: Wall
    low_m: float
    high_m: float


def cut_doors(
    walls: Sequence[Wall], wanted: Sequence[WantedDoor], room: Room
) -> tuple[tuple[Wall, ...], tuple[Door, ...]]:
    """The walls without the gaps, and the doors in them, in the input order.

    Raises:
        SceneError: For a door that is in no inner wall, does not fit into it, or overlaps another.
    """
    gaps = [_gap(door, walls, room) for door in wanted]
    cut: list[Wall] = []
    for wall in walls:
        inside = sorted((gap for gap in gaps if gap.wall is wall), key=lambda gap: gap.low_m)
        for one, other in pairwise(inside):
            if other.low_m < one.high_m:
                raise _overlap(one, other)
        cut.extend(_pieces(wall, inside) if inside else [wall])
    return tuple(cut), tuple(_door(gap) for gap in gaps)


def swinging_inwards(doors: Sequence[Door], areas: Sequence[Area]) -> tuple[Door, ...]:
    """The doors, hung so that each swings, to its left, into the smaller of the two adjacent rooms."""
    from shapely import Polygon

    rooms = np.array([Polygon(area.corners) for area in areas])
    return tuple(_swinging_inwards(door, rooms) for door in doors)


def _swinging_inwards(door: Door, rooms: NDArray[np.object_]) -> Door:
    (ax, ay), (bx, by) = door.start, door.end
    x, y, share = (ax + bx) / 2, (ay + by) / 2, ASIDE_M / math.dist(door.start, door.end)
    dx, dy = share * (ay - by), share * (bx - ax)
    left, right = _floor_m2((x + dx, y + dy), rooms), _floor_m2((x - dx, y - dy), rooms)
    return door if left <= right else replace(door, start=door.end, end=door.start)


def _floor_m2(at: XY, rooms: NDArray[np.object_]) -> float:
    """Area of the smallest room that contains a point [m^2]; infinite outside all rooms."""
    from shapely import area, contains_xy

    return float(area(rooms[contains_xy(rooms, *at)]).min(initial=math.inf))


def _gap(door: WantedDoor, walls: Sequence[Wall], room: Room) -> _Gap:
    wall = min(walls, key=lambda wall: _off_m(wall, door.at), default=None)
    if wall is None or _off_m(wall, door.at) > OFF_M:
        raise _not_in_a_wall(door, wall, room)
    along, length = _along_m(wall, door.at), math.dist(wall.start, wall.end)
    low, high = along - door.width_m / 2, along + door.width_m / 2
    if low < -1e-6 or high > length + 1e-6:
        raise _too_wide(door, wall, along, length)
    return _Gap(door, wall, low, high)


def _pieces(wall: Wall, gaps: Sequence[_Gap]) -> list[Wall]:
    """The rest of a wall: its ends are round, so each piece stops half its thickness before a gap."""
    length, half = math.dist(wall.start, wall.end), wall.thickness_m / 2
    ends = [0.0, *(mark for gap in gaps for mark in (gap.low_m - half, gap.high_m + half)), length]
    spans = zip(ends[::2], ends[1::2], strict=True)
    return [
        replace(wall, start=_at(wall, low), end=_at(wall, high)) for low, high in spans if high - low > 1e-6
    ]


def _door(gap: _Gap) -> Door:
    wanted, wall = gap.wanted, gap.wall
    return Door(
        name=wanted.name,
        start=_at(wall, gap.low_m),
        end=_at(wall, gap.high_m),
        is_open=wanted.is_open,
        kind=wanted.kind,
        thickness_m=min(LEAF_M, wall.thickness_m),
    )


def _along_m(wall: Wall, at: XY) -> float:
    (ax, ay), (bx, by) = wall.start, wall.end
    length = math.dist(wall.start, wall.end)
    return ((at[0] - ax) * (bx - ax) + (at[1] - ay) * (by - ay)) / length


def _off_m(wall: Wall, at: XY) -> float:
    along = min(max(_along_m(wall, at), 0.0), math.dist(wall.start, wall.end))
    return math.dist(at, _at(wall, along))


def _at(wall: Wall, along_m: float) -> XY:
    (ax, ay), (bx, by) = wall.start, wall.end
    share = along_m / math.dist(wall.start, wall.end)
    return (round(ax + share * (bx - ax), 6), round(ay + share * (by - ay), 6))


def _not_in_a_wall(door: WantedDoor, wall: Wall | None, room: Room) -> SceneError:
    from shapely import Point, Polygon

    where = f"({door.at[0]:g}, {door.at[1]:g})"
    if Polygon(room.corners, room.holes).boundary.distance(Point(door.at)) <= OFF_M:
        got, remedy = f"{where} in the outer wall, which leads out of the map", "Move it, or leave it out."
    elif wall is None:
        got, remedy = f"{where} on a map without inner walls", "Add the wall, or leave the door out."
    else:
        got = f"{where}, which is {_off_m(wall, door.at):.2f} m from the nearest, {called(wall)}"
        near = _at(wall, min(max(_along_m(wall, door.at), 0.0), math.dist(wall.start, wall.end)))
        remedy = f"Move it onto the wall: ({near[0]:g}, {near[1]:g}) is."
    return SceneError(
        entity=f"door {door.name}",
        field="at_m",
        expected="its middle on an inner wall",
        got=got,
        remedy=remedy,
    )


def _too_wide(door: WantedDoor, wall: Wall, along_m: float, length_m: float) -> SceneError:
    fits = 2.0 * min(along_m, length_m - along_m)
    return SceneError(
        entity=f"door {door.name}",
        field="width_m",
        expected=f"a door that fits into {called(wall)}, {length_m:g} m long",
        got=f"{door.width_m:g} m wide, {min(along_m, length_m - along_m):g} m from the wall's end",
        remedy=f"Make it at most {fits:g} m wide there, or move it."
        if fits > 0.0
        else "Move it along the wall.",
    )


def _overlap(one: _Gap, other: _Gap) -> SceneError:
    return SceneError(
        entity=f"door {other.wanted.name}",
        field="at_m",
        expected="doors side by side",
        got=f"one that overlaps the door {one.wanted.name!r} by {one.high_m - other.low_m:.2f} m",
        remedy="Move one of them, or make it narrower.",
    )


def called(wall: Wall) -> str:
    """The name of a wall in messages."""
    (ax, ay), (bx, by) = wall.start, wall.end
    return f"{wall.name or 'the wall'} from ({ax:g}, {ay:g}) to ({bx:g}, {by:g})"
