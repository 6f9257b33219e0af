"""What the names of a scenario must agree on; every complaint names its line."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

from comity_fis import InputError, Where, unknown_word
from comity_sim2d.scene.group import Group, check_members
from comity_sim2d.scene_error import SceneError


class FilePlaces(Protocol):
    """Where in a file something is written."""

    def __call__(self, *location: str | int) -> Where:
        """The place of a value."""
        ...


@dataclass(frozen=True, slots=True)
class NameCheck:
    """The names of one scenario.

    Args:
        people: Everybody in it.
        where: Their places in the file.
    """

    people: Collection[str]
    where: FilePlaces

    def goals(self, greeted: Iterable[tuple[int, str]]) -> None:
        """Refuse greetings of nobody, and two of one person.

        Args:
            greeted: People whom the goals greet, each with its place in the list.
        """
        seen: set[str] = set()
        for i, name in greeted:
            self._require(name, "goals", i, "greet")
            if name in seen:
                raise InputError(
                    expected="each person once",
                    got=f"{name!r} again",
                    remedy="Remove one of the two goals.",
                    where=self.where("goals", i, "greet"),
                )
            seen.add(name)

    def already(self, greeted: Iterable[str]) -> None:
        """Refuse facts about nobody."""
        for i, name in enumerate(greeted):
            self._require(name, "already", i, "greeted")

    def happening(self, key: str, people: Iterable[str | None]) -> None:
        """Refuse changes or faults about nobody in the scenario.

        Args:
            key: The list in the file.
            people: The person each of its entries is about; None where it is about nobody.
        """
        for i, name in enumerate(people):
            if name is not None:
                self._require(name, key, i, "person")

    def groups(self, groups: Mapping[str, Sequence[str]]) -> None:
        """Refuse groups of nobody or of one person, and people in two groups."""
        for group, members in groups.items():
            for i, member in enumerate(members):
                self._require(member, "groups", group, i)
        try:
            check_members([Group(name, tuple(members)) for name, members in groups.items()], self.people)
        except SceneError as error:
            raise error.at(self.where("groups", error.entity)) from None

    def _require(self, name: str, *location: str | int) -> None:
        if name not in self.people:
            raise unknown_word("a person from `people`", name, self.people, where=self.where(*location))
