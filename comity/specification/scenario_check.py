"""Consistency of the names in a scenario; every error names its line."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

from comity_fis import InputError, Where, unknown_word
from comity_sim2d.scene.group import Group, check_members
from comity_sim2d.scene_error import SceneError


class FilePlaces(Protocol):
    """Positions in a file."""

    def __call__(self, *location: str | int) -> Where:
        """Position of a value."""
        ...


@dataclass(frozen=True, slots=True)
class NameCheck:
    """The names of one scenario.

    Args:
        people: All people in the scenario.
        where: Positions in the file.
    """

    people: Collection[str]
    where: FilePlaces

    def goals(self, greeted: Iterable[tuple[int, str]]) -> None:
        """Refuse greetings of unknown people, and duplicate greetings.

        Args:
            greeted: People whom the goals greet, each with the goal's index.
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
        """Refuse facts about unknown people."""
        for i, name in enumerate(greeted):
            self._require(name, "already", i, "greeted")

    def happening(self, key: str, people: Iterable[str | None]) -> None:
        """Refuse changes or faults about unknown people.

        Args:
            key: Key of the list in the file.
            people: The person of each entry; None if it concerns no person.
        """
        for i, name in enumerate(people):
            if name is not None:
                self._require(name, key, i, "person")

    def groups(self, groups: Mapping[str, Sequence[str]]) -> None:
        """Refuse groups with unknown people or a single member, and people in two groups."""
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
