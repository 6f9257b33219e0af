"""What is answered about one person: their facts, and the years of a life."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import date
from typing import Literal

from pydantic import Field

from comity.answers.base import Answer
from comity.answers.inference import Inputs, ShownValueAnswer
from comity_fis.inference.value import Origin


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
