"""Faults, as the tree meets them: an exception that is raised on purpose, and what a robot knows of itself.

A robot that can tell what is wrong with it names the fault behind a failure in the trace. It need not be able
to: a failure has its reading in any case, `no progress towards johanna for 3 s`.
"""

from __future__ import annotations

from typing import Protocol, runtime_checkable

BASE, VOICE, SENSORS, WAY = "base", "voice", "sensors", "way"
"""The parts that a robot is asked for."""


class FaultError(Exception):
    """Something that a schedule of faults made go wrong; its text is the fault."""


@runtime_checkable
class Diagnosed(Protocol):
    """The part of a robot that knows what is wrong with it."""

    def trouble(self, part: str) -> str | None:
        """What is wrong with a part now, or with the path, in words; None where nothing is."""
        ...

    def trouble_with(self, person: str) -> str | None:
        """What is wrong with a person, whatever their name is; None where nothing is."""
        ...


def trouble_of(robot: object, *parts: str) -> str | None:
    """The first trouble with some parts of a robot, if it knows of one."""
    if not isinstance(robot, Diagnosed):
        return None
    return next((trouble for part in parts if (trouble := robot.trouble(part))), None)


def trouble_with(robot: object, *people: str) -> str | None:
    """The first trouble with some people, if the robot knows of one."""
    if not isinstance(robot, Diagnosed):
        return None
    return next((trouble for person in people if (trouble := robot.trouble_with(person))), None)
