"""What is answered about one person: their facts, and the years of a life."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import date
from typing import Literal

from pydantic import Field

from comity.answers.base import Answer
from comity.answers.inference import Inputs, ShownValueAnswer
from comity.answers.run import SettledAnswer
from comity_fis.inference.value import Origin
from comity_fis.learning.signals import Signal


class ProfileAnswer(Answer):
    """`comity profile show --json`."""

    name: str
    place: Literal["shipped", "kept", "file"]
    file: str
    at: date | None = Field(description="The day of the facts; null where none depends on it.")
    declared: Mapping[str, object] = Field(description="The profile as it is written.")
    learnt: Mapping[str, object] | None = Field(description="What meetings taught, as it is kept.")
    consents: tuple[Mapping[str, str], ...] = Field(
        default=(), description="What the person agreed to, as it is kept; empty where nothing was recorded."
    )
    rulebook: str
    inputs: Inputs
    notes: tuple[str, ...]
    parameters: Mapping[str, ShownValueAnswer]


class ObservationAnswer(Answer):
    """One thing that was seen or heard at a meeting."""

    name: str
    day: date
    situation: Mapping[str, str | float]
    signal: Signal
    how: Literal["said", "seen"] = Field(description="Whether the person put it in words.")
    distance_m: float = Field(description="Where the robot stood, between the bodies.")
    model_m: float = Field(description="What culture and situation alone gave then.")


class ObserveAnswer(Answer):
    """`comity profile observe --json`."""

    observed: tuple[ObservationAnswer, ...] = Field(description="What was written down.")
    undone: tuple[ObservationAnswer, ...] = Field(description="What was taken back.")
    values: Mapping[str, SettledAnswer] = Field(
        description="By person: how near the robot comes from now on, in the situation of the last of these."
    )
    notes: tuple[str, ...] = Field(description="Of meetings before the person had agreed to learn.")


class YearValueAnswer(Answer):
    """A parameter in one year."""

    value: float | str
    unit: str | None
    spread: float | None
    origin: Origin


class YearAnswer(Answer):
    """The end of one year of a life."""

    at: date
    changed: tuple[str, ...] = Field(description="Facts that are others than a year before.")
    inputs: Inputs
    parameters: Mapping[str, YearValueAnswer]


class LifeAnswer(Answer):
    """`comity profile show --years --json`."""

    name: str
    rulebook: str
    years: tuple[YearAnswer, ...]
    picture: str | None
