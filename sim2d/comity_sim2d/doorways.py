"""The doors of a world as they are now: which are shut, when that changed, and who stands in one."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import TYPE_CHECKING

from comity_fis.errors import closest
from comity_sim2d.obstacles import floor_plan

if TYPE_CHECKING:
    from comity_sim2d.clock import Clock
    from comity_sim2d.door import Door
    from comity_sim2d.obstacles import FloorPlan
    from comity_sim2d.pose import XY
    from comity_sim2d.scene import Scene

Disc = tuple[str, "XY", float]
"""Whose body it is, its centre and its radius [m]."""
AS_THEY_ARE: Mapping[str, bool] = MappingProxyType({})


@dataclass(frozen=True, slots=True)
class DoorTurn:
    """A door that was opened or shut."""

    t: float
    """When [s]."""
    door: str
    is_open: bool
    """From then on."""


class Doorways:
    """The doors of one world."""

    def __init__(self, scene: Scene, clock: Clock) -> None:
        self._scene = scene
        self._clock = clock
        self._doors = {door.name: door for door in scene.doors}
        self.turns: list[DoorTurn] = []

    @property
    def doors(self) -> tuple[Door, ...]:
        """All of them as they are now."""
        return tuple(self._doors.values())

    @property
    def plan(self) -> FloorPlan:
        """The floor plan as it is now."""
        return floor_plan(self._scene, self.doors)

    def turn(self, name: str, *, is_open: bool, bodies: Iterable[Disc]) -> Door | None:
        """Open or shut a door.

        Args:
            name: Of the door.
            is_open: What it is to be.
            bodies: What must not be in the way of its leaf when it shuts.

        Returns:
            The door as it is now; None where it was so already.

        Raises:
            ValueError: Where there is no such door, it has no leaf, or somebody stands in it.
        """
        (door,) = turned((self._find(name),), {name: is_open})
        if door == self._doors[name]:
            return None
        if not is_open:
            for who, xy, radius_m in bodies:
                if _distance_m(door, xy) < radius_m + door.thickness_m / 2:
                    raise ValueError(f"the door {name!r} cannot be shut: {who} stands in it")
        self._doors[name] = door
        self.turns.append(DoorTurn(self._clock.now_s, name, is_open))
        return door

    def _find(self, name: str) -> Door:
        if name not in self._doors:
            raise ValueError(f"no door {name!r} in the scene. {closest(name, self._doors)}")
        return self._doors[name]


def turned(doors: Iterable[Door], states: Mapping[str, bool] = AS_THEY_ARE) -> tuple[Door, ...]:
    """The doors with other states.

    Args:
        doors: All of them.
        states: Whether a door is open, by name; those that are not named stay as they are.

    Raises:
        ValueError: For a shut opening, which has no leaf.
    """
    return tuple(replace(door, is_open=states.get(door.name, door.is_open)) for door in doors)


def _distance_m(door: Door, xy: XY) -> float:
    from shapely import LineString, Point

    return float(LineString([door.start, door.end]).distance(Point(xy)))
