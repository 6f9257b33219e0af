"""A map: a place without robot and people, from which scenes are made."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import TypeVar

from comity_fis.errors import closest
from comity_sim2d.kinds import require_kinds
from comity_sim2d.maps.doorways import turned
from comity_sim2d.scene.area import Area, Location
from comity_sim2d.scene.door import Door
from comity_sim2d.scene.group import Group
from comity_sim2d.scene.passers_by import PassersBy
from comity_sim2d.scene.person import Person
from comity_sim2d.scene.robot_body import RobotBody
from comity_sim2d.scene.room import Furniture, Room, Wall
from comity_sim2d.scene.scene import Scene, Side
from comity_sim2d.scene_error import SceneError, require_text, require_tuple

NamedT = TypeVar("NamedT", Area, Location)
AS_DRAWN: Mapping[str, bool] = MappingProxyType({})


@dataclass(frozen=True, slots=True)
class PlaceMap:
    """The static obstacles of a place, and the names of its parts."""

    name: str
    room: Room
    """The floor: the union of the areas."""
    areas: tuple[Area, ...] = ()
    walls: tuple[Wall, ...] = ()
    doors: tuple[Door, ...] = ()
    furniture: tuple[Furniture, ...] = ()
    locations: tuple[Location, ...] = ()
    about: str = ""

    def __post_init__(self) -> None:
        require_text("map", "name", self.name)
        require_kinds(self.name, room=(self.room, Room), about=(self.about, str))
        for field, kind in {
            "areas": Area,
            "walls": Wall,
            "doors": Door,
            "furniture": Furniture,
            "locations": Location,
        }.items():
            require_tuple(self.name, field, getattr(self, field), kind, field)

    def scene(
        self,
        robot: RobotBody,
        people: tuple[Person, ...] = (),
        groups: tuple[Group, ...] = (),
        passers_by: PassersBy | None = None,
        keep_to: Side = "right",
    ) -> Scene:
        """The scene of this place with a robot, people, groups of people and passers-by.

        Raises:
            SceneError: If one of them cannot stand at the given place.
        """
        return Scene(
            room=self.room,
            robot=robot,
            people=people,
            groups=groups,
            passers_by=passers_by,
            keep_to=keep_to,
            walls=self.walls,
            furniture=self.furniture,
            doors=self.doors,
            areas=self.areas,
            locations=self.locations,
        )

    def with_doors(self, states: Mapping[str, bool] = AS_DRAWN) -> PlaceMap:
        """The map with some doors opened or shut.

        Args:
            states: Whether a door is open, by its name.

        Raises:
            SceneError: For an unknown door, or an opening that is to be shut.
        """
        require_kinds(self.name, states=(states, Mapping))
        known = [door.name for door in self.doors]
        for name in states:
            if name not in known:
                raise SceneError(
                    entity=f"door {name}",
                    expected=f"a door of the map {self.name}",
                    got=repr(name),
                    remedy=closest(name, known),
                )
        return replace(self, doors=turned(self.doors, states))

    def location(self, name: str) -> Location:
        """The location of that name.

        Raises:
            SceneError: If there is none.
        """
        return _named(self.locations, name, f"a location of the map {self.name}")

    def area(self, name: str) -> Area:
        """The room of that name.

        Raises:
            SceneError: If there is none.
        """
        return _named(self.areas, name, f"a room of the map {self.name}")


def _named(things: tuple[NamedT, ...], name: str, expected: str) -> NamedT:
    for thing in things:
        if thing.name == name:
            return thing
    known = [thing.name for thing in things]
    raise SceneError(entity=name, expected=expected, got=repr(name), remedy=closest(name, known))
