"""Currently active faults, by subject; their effects follow from them.

A robot with a fault of its `BASE` stands, whatever its wheels are commanded. With a fault of its `VOICE` it
falls silent at once. With a fault of its `SENSORS` it sees no one, and stands until it does: it could not see
what it drives into. A fault of the `PATH`, of a person or of a door has no effect of its own: it is stored so
that the robot can name the cause of a disturbance.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True, slots=True)
class Subject:
    """The subject of a fault. A person or a door may have any name, `base` included."""

    kind: Literal["part", "person", "door"]
    name: str


BASE, VOICE, SENSORS = Subject("part", "base"), Subject("part", "voice"), Subject("part", "sensors")
PATH = Subject("part", "way")


def part(name: str) -> Subject:
    """A part of the robot, or its path, by the name that the executor asks for."""
    return Subject("part", name)


def person(name: str) -> Subject:
    """A person of the scene."""
    return Subject("person", name)


def door(name: str) -> Subject:
    """A door of the map."""
    return Subject("door", name)


class ActiveFaults:
    """The active faults; a subject may have several, and the same one twice."""

    def __init__(self) -> None:
        self._texts: dict[Subject, list[str]] = {}

    def begin(self, subject: Subject, text: str) -> None:
        """Begin a fault of a subject, described by a text."""
        self._texts.setdefault(subject, []).append(text)

    def end(self, subject: Subject, text: str) -> None:
        """End a fault.

        Raises:
            ValueError: If it has not begun.
        """
        self._texts.get(subject, []).remove(text)

    def of(self, subject: Subject) -> str | None:
        """The faults of a subject, in words; None if there are none."""
        texts = self._texts.get(subject)
        return "; ".join(dict.fromkeys(texts)) if texts else None
