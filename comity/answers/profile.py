"""What is answered about one person: their facts, and the years of a life."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import date
from typing import Literal

from comity.answers.inference import Inputs, SettledAnswer, ShownValueAnswer
from comity_fis.inference.value import Origin
from comity_fis.learning.signals import Signal
from comity_fis.record import Record


@dataclass(frozen=True, slots=True, kw_only=True)
class ProfileAnswer(Record):
    """`comity profile show --json`."""

    name: str
    place: Literal["shipped", "kept", "file"]
    file: str
    at: date | None
    """The day of the facts; null where none depends on it."""
    declared: Mapping[str, object]
    """The profile as it is written."""
    learnt: Mapping[str, object] | None
    """What meetings taught, as it is kept."""
    consents: tuple[Mapping[str, str], ...] = ()
    """What the person agreed to, as it is kept; empty where nothing was recorded."""
    rulebook: str
    inputs: Inputs
    """Null: not disclosed. Two numbers: anything between them."""
    notes: tuple[str, ...]
    parameters: Mapping[str, ShownValueAnswer]


@dataclass(frozen=True, slots=True, kw_only=True)
class ObservationAnswer(Record):
    """One thing that was seen or heard at a meeting."""

    name: str
    day: date
    situation: Mapping[str, str | float]
    signal: Signal
    how: Literal["said", "seen"]
    """Whether the person put it in words."""
    distance_m: float
    """Where the robot stood, between the bodies."""
    model_m: float
    """What culture and situation alone gave then."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ObserveAnswer(Record):
    """`comity profile observe --json`."""

    observed: tuple[ObservationAnswer, ...]
    """What was written down."""
    undone: tuple[ObservationAnswer, ...]
    """What was taken back."""
    values: Mapping[str, SettledAnswer]
    """By person: how near the robot comes from now on, in the situation of the last of these."""
    notes: tuple[str, ...]
    """Of meetings before the person had agreed to learn."""


@dataclass(frozen=True, slots=True, kw_only=True)
class YearValueAnswer(Record):
    """A parameter in one year."""

    value: float | str
    unit: str | None
    spread: float | None
    origin: Origin


@dataclass(frozen=True, slots=True, kw_only=True)
class YearAnswer(Record):
    """The end of one year of a life."""

    at: date
    changed: tuple[str, ...]
    """Facts that are others than a year before."""
    inputs: Inputs
    """Null: not disclosed. Two numbers: anything between them."""
    parameters: Mapping[str, YearValueAnswer]


@dataclass(frozen=True, slots=True, kw_only=True)
class LifeAnswer(Record):
    """`comity profile show --years --json`."""

    name: str
    rulebook: str
    years: tuple[YearAnswer, ...]
    picture: str | None


@dataclass(frozen=True, slots=True, kw_only=True)
class AskAnswer(Record):
    """`comity profile ask --json`."""

    name: str
    parameter: Literal["conversational_distance"]
    answer_m: float | None
    """Null where it was left open, or taken back with `unknown`."""
    counts_as: Literal["setting", "observation"] | None
    """Null where the question was left open."""
    at: date
    """The day of the answer."""
    situation: Mapping[str, str | float]
    """In which an observation counts."""
    value: SettledAnswer | None
    """How near the robot comes from now on, and why."""
