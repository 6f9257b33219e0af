"""Faults that are active now, by what they concern; their effects follow from them.

A robot whose `BASE` has a fault stands where it is, whatever the wheels receive. One whose `VOICE` has a
fault falls silent in mid-word. One whose `SENSORS` have a fault sees no person, and stands until it does: it
could not see what it drives into. A fault on the `PATH`, of a person or of a door changes nothing by itself:
it is stored so that the robot can name the cause of a disturbance.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True, slots=True)
class Subject:
    """What a fault concerns. A person or a door may be called anything, `base` included."""

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
    """Those of now; a subject may have several, and the same one twice."""

    def __init__(self) -> None:
        self._texts: dict[Subject, list[str]] = {}

    def begin(self, subject: Subject, text: str) -> None:
        """Something is wrong with a subject from now on; the text says what."""
        self._texts.setdefault(subject, []).append(text)

    def end(self, subject: Subject, text: str) -> None:
        """It is over.

        Raises:
            ValueError: if it did not begin.
        """
        self._texts.get(subject, []).remove(text)

    def of(self, subject: Subject) -> str | None:
        """What is wrong with a subject, in words; None where nothing is."""
        texts = self._texts.get(subject)
        return "; ".join(dict.fromkeys(texts)) if texts else None
