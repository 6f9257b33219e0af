"""The current state of a world's doors: open or shut, when that changed, and who stands in one."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import TYPE_CHECKING

from comity_sim2d.kinds import TRUTH, require_kinds, require_numbers
from comity_sim2d.scene.obstacles import floor_plan
from comity_sim2d.scene_error import require_text, unknown

if TYPE_CHECKING:
    from comity_sim2d.clock import Clock
    from comity_sim2d.pose import XY
    from comity_sim2d.scene.door import Door
    from comity_sim2d.scene.obstacles import FloorPlan
    from comity_sim2d.scene.room import Furniture
    from comity_sim2d.scene.scene import Scene

Disc = tuple[str, "XY", float]
"""Name of a body, its centre and its radius [m]."""
AS_THEY_ARE: Mapping[str, bool] = MappingProxyType({})


@dataclass(frozen=True, slots=True)
class DoorTurn:
    """The opening or shutting of a door."""

    t: float
    """Time [s]."""
    door: str
    is_open: bool
    """State from then on."""

    def __post_init__(self) -> None:
        require_text("door turn", "door", self.door)
        require_numbers("door turn", t=self.t)
        require_kinds("door turn", is_open=(self.is_open, TRUTH))


class Doorways:
    """The doors of one world."""

    def __init__(self, scene: Scene, clock: Clock) -> None:
        self._scene = scene
        self._clock = clock
        self._doors = {door.name: door for door in scene.doors}
        self.turns: list[DoorTurn] = []

    @property
    def doors(self) -> tuple[Door, ...]:
        """All doors in their current state."""
        return tuple(self._doors.values())

    @property
    def plan(self) -> FloorPlan:
        """The current floor plan."""
        return floor_plan(self._scene, self.doors)

    def turn(self, name: str, *, is_open: bool, bodies: Iterable[Disc]) -> Door | None:
        """Open or shut a door.

        Args:
            name: Name of the door.
            is_open: The new state.
            bodies: Bodies that must not be in the way of its leaf when it shuts.

        Returns:
            The door in its new state; None if nothing changed.

        Raises:
            ValueError: If there is no such door, it has no leaf, or a person or object stands in it.
        """
        (door,) = turned((self._find(name),), {name: is_open})
        if door == self._doors[name]:
            return None
        if not is_open:
            there = furniture_in(door, self._scene.furniture) or _body_in(door, bodies)
            if there is not None:
                raise ValueError(f"the door {name!r} cannot be shut: {there} stands in it")
        self._doors[name] = door
        self.turns.append(DoorTurn(self._clock.now_s, name, is_open))
        return door

    def _find(self, name: str) -> Door:
        if not isinstance(name, str) or name not in self._doors:
            raise unknown("a door of the scene", name, self._doors)
        return self._doors[name]


def turned(doors: Iterable[Door], states: Mapping[str, bool] = AS_THEY_ARE) -> tuple[Door, ...]:
    """The doors in other states.

    Args:
        doors: All of them.
        states: Whether a door is open, by name; doors that are not named keep their state.

    Raises:
        ValueError: If an opening, which has no leaf, is to be shut.
    """
    return tuple(replace(door, is_open=states.get(door.name, door.is_open)) for door in doors)


def furniture_in(door: Door, furniture: Iterable[Furniture]) -> str | None:
    """The name, in messages, of furniture that a door's leaf would hit; None if it can shut."""
    from shapely import LineString, Polygon

    leaf = LineString([door.start, door.end])
    inside = (
        piece.called for piece in furniture if leaf.distance(Polygon(piece.corners)) < door.thickness_m / 2
    )
    return next(inside, None)


def _body_in(door: Door, bodies: Iterable[Disc]) -> str | None:
    from shapely import LineString, Point

    leaf = LineString([door.start, door.end])
    inside = (
        who for who, xy, radius_m in bodies if leaf.distance(Point(xy)) < radius_m + door.thickness_m / 2
    )
    return next(inside, None)
