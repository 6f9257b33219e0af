"""People who stand together, as an F-formation (Kendon 1990, "Conducting Interaction", chapter 7)."""

from __future__ import annotations

from collections.abc import Collection, Container, Iterable
from dataclasses import dataclass, replace

from comity_fis.errors import closest
from comity_sim2d.scene.o_space import OSpace, o_space, those_left
from comity_sim2d.scene.person import Person
from comity_sim2d.scene_error import SceneError, require_text, require_tuple


@dataclass(frozen=True, slots=True)
class Group:
    """At least two people, by name; the o-space that they keep open follows from their poses."""

    name: str
    members: tuple[str, ...]

    def __post_init__(self) -> None:
        require_text("group", "name", self.name)
        require_tuple(self.name, "members", self.members, str, "names")
        if len(set(self.members)) < 2:
            raise SceneError(
                entity=self.name,
                field="members",
                expected="a group of at least two people",
                got=f"{', '.join(self.members) or 'nobody'}",
                remedy="Add the others who stand there, or remove the group.",
            )

    def o_space(self, people: Iterable[Person]) -> OSpace:
        """The o-space of the members at their current poses."""
        return o_space(self.those_of(people))

    def those_of(self, people: Iterable[Person]) -> tuple[Person, ...]:
        """The members among some people."""
        return tuple(person for person in people if person.name in self.members)

    def of_those_left(self, before: Iterable[Person], now: Iterable[Person]) -> Group | None:
        """The group without members who have left; None if fewer than two remain."""
        left = tuple(person.name for person in those_left(self.those_of(before), now))
        return replace(self, members=left) if len(left) > 1 else None

    def without(self, names: Container[str]) -> Group | None:
        """The group without some people; None if fewer than two remain."""
        left = tuple(member for member in self.members if member not in names)
        return replace(self, members=left) if len(left) > 1 else None


def check_members(groups: Iterable[Group], names: Collection[str]) -> None:
    """Reject groups of unknown people, and people in two groups.

    Args:
        groups: The groups.
        names: Names of the people in the scene.

    Raises:
        SceneError: For the first such group.
    """
    grouped: dict[str, str] = {}
    for group in groups:
        for member in group.members:
            if member not in names:
                raise SceneError(
                    entity=group.name,
                    field="members",
                    expected="people of the scene",
                    got=repr(member),
                    remedy=closest(member, names),
                )
            if member in grouped:
                both = f"in {grouped[member]!r} and {group.name!r}"
                raise SceneError(
                    entity=group.name,
                    field="members",
                    expected="nobody in two groups, and nobody twice in one",
                    got=f"{member!r} {both if grouped[member] != group.name else f'twice in {group.name!r}'}",
                    remedy="Keep one of them.",
                )
            grouped[member] = group.name
