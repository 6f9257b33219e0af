"""The protocol for robots that fetch objects; a robot without hands does not need it."""

from __future__ import annotations

from typing import Protocol, runtime_checkable

PICK_UP, HAND_OVER = "pick_up", "hand_over"
"""The acts (`ActGoal`) of such a robot, each with an object."""


@runtime_checkable
class Carrier(Protocol):
    """The part of a robot that fetches objects: it supports the motion goal `go_to` and the two acts."""

    def carried(self) -> str | None:
        """The object in the robot's hands; None if they are free."""
        ...
