"""What was wanted and what was reached beside one person."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Ring:
    """One visit, as pictures show it."""

    person: str
    wanted_m: float
    """Between the nearest points of the two bodies."""
    reached_m: float | None = None
    """None where the robot did not get there."""
    bearing_deg: float = 0.0
    """The wanted bearing: it marks the chosen side."""
    label: str | None = None
    """Words for the card, such as the person's profile or the reason for a deviation."""
    time_s: float | None = None
    """When the robot stood there; None: when its first act towards the person began, or at the end."""
