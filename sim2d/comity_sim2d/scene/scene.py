"""A scene: a room with its things and people, and the robot at its start. Frozen, and checked when built."""

from __future__ import annotations

from collections.abc import Container, Iterable
from dataclasses import dataclass, replace
from typing import Literal, get_args

from comity_sim2d.kinds import require_kinds
from comity_sim2d.scene.area import Area, Location
from comity_sim2d.scene.door import Door
from comity_sim2d.scene.group import Group, check_members
from comity_sim2d.scene.o_space import OSpace, o_space_of_those_left
from comity_sim2d.scene.passers_by import PassersBy
from comity_sim2d.scene.person import Person, find_person
from comity_sim2d.scene.robot_body import RobotBody
from comity_sim2d.scene.room import Furniture, Room, Wall
from comity_sim2d.scene.scene_check import check_scene
from comity_sim2d.scene_error import require_one_of, require_tuple

Side = Literal["right", "left"]
SIDES: tuple[Side, ...] = get_args(Side)


@dataclass(frozen=True, slots=True)
class Scene:
    """The initial state of a world.

    Raises:
        SceneError: If an entity cannot stand at its place; its `entity` says which.
    """

    room: Room
    robot: RobotBody
    people: tuple[Person, ...] = ()
    walls: tuple[Wall, ...] = ()
    furniture: tuple[Furniture, ...] = ()
    groups: tuple[Group, ...] = ()
    """People who stand together."""
    passers_by: PassersBy | None = None
    """The passers-by."""
    keep_to: Side = "right"
    """Side on which people evade one another if both are equally good."""
    doors: tuple[Door, ...] = ()
    """Doors in their initial state, each in a gap of the walls."""
    areas: tuple[Area, ...] = ()
    """Named parts of the floor; they are no obstacles."""
    locations: tuple[Location, ...] = ()
    """Named points."""

    def __post_init__(self) -> None:
        require_kinds("scene", room=(self.room, Room), robot=(self.robot, RobotBody))
        require_kinds("scene", passers_by=(self.passers_by, PassersBy | None))
        for name, kind, what in (
            ("people", Person, "people"),
            ("walls", Wall, "walls"),
            ("furniture", Furniture, "furniture"),
            ("groups", Group, "groups"),
            ("doors", Door, "doors"),
            ("areas", Area, "areas"),
            ("locations", Location, "locations"),
        ):
            require_tuple("scene", name, getattr(self, name), kind, what)
        require_one_of("scene", "keep_to", self.keep_to, SIDES)
        check_members(self.groups, [person.name for person in self.people])
        check_scene(self)

    def without(self, names: Container[str]) -> Scene:
        """The same without some people: groups shrink, and one with fewer than two people ends."""
        groups = (group.without(names) for group in self.groups)
        return replace(
            self,
            people=tuple(person for person in self.people if person.name not in names),
            groups=tuple(group for group in groups if group is not None),
        )

    @property
    def o_spaces(self) -> tuple[OSpace, ...]:
        """The o-spaces of the groups at the start, in their order."""
        return tuple(group.o_space(self.people) for group in self.groups)

    def o_spaces_among(self, people: Iterable[Person]) -> tuple[OSpace, ...]:
        """The o-spaces for other positions of people: only of members who have not left their group."""
        there = tuple(people)
        left = (o_space_of_those_left(group.those_of(self.people), there) for group in self.groups)
        return tuple(space for space in left if space is not None)

    def person(self, name: str) -> Person:
        """The person of that name.

        Raises:
            ValueError: If there is none.
        """
        return find_person(self.people, name)
