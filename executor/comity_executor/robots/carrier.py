"""What a behaviour tree needs of a robot that brings things; a robot without hands does without."""

from __future__ import annotations

from typing import Protocol, runtime_checkable

PICK_UP, HAND_OVER = "pick_up", "hand_over"
"""The acts (`ActGoal`) that such a robot knows, each with a thing."""


@runtime_checkable
class Carrier(Protocol):
    """The part of a robot that fetches things: it knows the motion goal `go_to`, and the two acts."""

    def carried(self) -> str | None:
        """What the robot has in its hands; None: nothing."""
        ...
