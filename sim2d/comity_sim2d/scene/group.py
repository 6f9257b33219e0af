"""People who stand together, as an F-formation (Kendon 1990, "Conducting Interaction", chapter 7)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Iterable
from dataclasses import dataclass, replace

from comity_fis.errors import closest
from comity_sim2d.scene.o_space import OSpace, o_space, those_left
from comity_sim2d.scene.person import Person
from comity_sim2d.scene_error import SceneError, require_text, require_tuple


@dataclass(frozen=True, slots=True)
class Group:
    """At least two people, by their names; the space that they keep open follows from where they stand."""

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
                got=f"{len(set(self.members))}",
                remedy="Add the others who stand there, or remove the group.",
            )

    def o_space(self, people: Iterable[Person]) -> OSpace:
        """The space between the members, where those people stand now."""
        return o_space(self.those_of(people))

    def those_of(self, people: Iterable[Person]) -> tuple[Person, ...]:
        """The members among some people."""
        return tuple(person for person in people if person.name in self.members)

    def of_those_left(self, before: Iterable[Person], now: Iterable[Person]) -> Group | None:
        """The group that is left when members have gone elsewhere; None of one alone."""
        left = tuple(person.name for person in those_left(self.those_of(before), now))
        return replace(self, members=left) if len(left) > 1 else None

    def without(self, names: Container[str]) -> Group | None:
        """The group that is left when some people are gone; None of one alone."""
        left = tuple(member for member in self.members if member not in names)
        return replace(self, members=left) if len(left) > 1 else None


def check_groups(groups: tuple[Group, ...], people: Iterable[Person]) -> None:
    """Refuse groups of people who are not there, or who are in two groups.

    Raises:
        SceneError: For the first of them.
    """
    names = [person.name for person in people]
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
    for name, times in Counter(member for group in groups for member in group.members).items():
        if times > 1:
            raise SceneError(
                entity=name,
                field="members",
                expected="nobody in two groups, and nobody twice in one",
                got=f"{name!r} {times} times",
                remedy="Keep them in one group.",
            )
