"""What `comity visits` answers: many meetings with one person."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from comity_fis.learning.signals import Signal
from comity_fis.record import Record


@dataclass(frozen=True, slots=True, kw_only=True)
class MeetingAnswer(Record):
    """One of many visits to the same person."""

    visit: int
    """From 1."""
    days: int
    """Since the first."""
    distance_liked_m: float
    """The middle of what the simulated person likes; hidden."""
    distance_model_m: float
    """What culture and situation give."""
    interval_m: tuple[float, float]
    """Where the robot believed the liked distance with 90 % probability, before the visit; no nearer than
    safety allows."""
    distance_target_m: float
    """Where the robot wanted to stop."""
    distance_actual_m: float | None
    """Where the robot stood when it docked."""
    error_m: float | None
    """Actual minus liked."""
    shown: Signal | None
    """What the simulated person truly did."""
    noticed: Signal | None
    """What the robot noticed."""
    distance_wanted_m: float | None = None
    """The older name of `distance_target_m`; gone with the next release."""
    distance_reached_m: float | None = None
    """The older name of `distance_actual_m`; gone with the next release."""

    def __post_init__(self) -> None:
        """Give the older names their values."""
        object.__setattr__(self, "distance_wanted_m", self.distance_target_m)
        object.__setattr__(self, "distance_reached_m", self.distance_actual_m)


@dataclass(frozen=True, slots=True, kw_only=True)
class VisitsAnswer(Record):
    """`comity visits --json`."""

    profile: str
    rulebook: str
    seed: int
    every_days: int
    likes_m: tuple[float, float]
    """The simulated person's comfort interval."""
    method: Literal["episodes"]
    """Every visit was an episode in the world."""
    known_before: int
    """Observations remembered from earlier meetings."""
    remembered_as: str | None
    """The name in the store, where --keep wrote it there; else null."""
    days_to_come: int
    """Visits that were simulated on days after today."""
    visits: tuple[MeetingAnswer, ...]
