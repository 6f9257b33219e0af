"""What `comity draw`, `comity figures` and `comity metrics` answer."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from pydantic import Field

from comity.answers.base import Answer


class DrawAnswer(Answer):
    """What `comity draw` says."""

    file: str
    name: str
    kind: Literal["map", "scenario"]


class FigureAnswer(Answer):
    """One figure of a run."""

    run: str
    scenario: str
    rulebook: str
    seed: int
    person: str | None = Field(description="Null for a figure of the whole episode.")
    profile: str | None
    metric: str
    value: float
    unit: str = Field(description="1 for a share or a count.")


class DefinitionAnswer(Answer):
    """What a metric means."""

    unit: str
    means: str
    source: str
    per: Literal["run", "visit", "person"] = Field(
        description="`visit`: of a person to visit; `person`: of any person of the scenario."
    )


class MetricsAnswer(Answer):
    """`comity metrics --json`."""

    figures: tuple[FigureAnswer, ...] = Field(description="Run by run; what has no value is left out.")
    by_profile: Mapping[str, Mapping[str, float]] = Field(
        description="Mean of each figure of a person over all people of a profile in these runs."
    )
    definitions: Mapping[str, DefinitionAnswer]
