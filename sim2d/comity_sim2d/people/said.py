"""What people in the world say to the robot."""

from __future__ import annotations

from dataclasses import dataclass

GO_AHEAD = "Yes, please go ahead."
"""Answer of a person who lets the robot pass."""


@dataclass(frozen=True, slots=True)
class Said:
    """An utterance of a person, as the robot hears it."""

    t: float
    """When it was said [s]."""
    person: str
    """The speaker: the robot recognises people by voice as it does by sight."""
    text: str
