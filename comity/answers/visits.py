"""What `comity visits` answers: many meetings with one person."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from comity.answers.base import Answer
from comity_fis.learning.signals import Signal


class MeetingAnswer(Answer):
    """One of many visits to the same person."""

    visit: int = Field(description="From 1.")
    days: int = Field(description="Since the first.")
    distance_liked_m: float = Field(description="The middle of what the simulated person likes; hidden.")
    distance_model_m: float = Field(description="What culture and situation give.")
    interval_m: tuple[float, float] = Field(
        description="Where the robot believed the liked distance with 90 % probability, before the visit; "
        "no nearer than safety allows."
    )
    distance_wanted_m: float = Field(description="Where the robot wanted to stop.")
    distance_reached_m: float | None = Field(description="Where the robot stood when it docked.")
    error_m: float | None = Field(description="Reached minus liked.")
    shown: Signal | None = Field(description="What the simulated person truly did.")
    noticed: Signal | None = Field(description="What the robot noticed.")


class VisitsAnswer(Answer):
    """`comity visits --json`."""

    profile: str
    rulebook: str
    seed: int
    every_days: int
    likes_m: tuple[float, float] = Field(description="The simulated person's comfort interval.")
    method: Literal["episodes"] = Field(description="Every visit was an episode in the world.")
    known_before: int = Field(description="Observations remembered from earlier meetings.")
    remembered_as: str | None = Field(
        description="The name in the store, where --keep wrote it there; else null."
    )
    days_to_come: int = Field(description="Visits that were simulated on days after today.")
    visits: tuple[MeetingAnswer, ...]
