"""What people in the world say to the robot."""

from __future__ import annotations

from dataclasses import dataclass

GO_AHEAD = "Yes, please go ahead."
"""Answer of a person who lets the robot pass."""


@dataclass(frozen=True, slots=True)
class Said:
    """Words, as they reach the robot's ears."""

    t: float
    """When they were said."""
    person: str
    """The robot knows people by their voices as it knows them by sight."""
    text: str
