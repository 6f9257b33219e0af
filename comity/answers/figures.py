"""What `comity draw`, `comity figures` and `comity metrics` answer."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from comity_fis.record import Record


@dataclass(frozen=True, slots=True, kw_only=True)
class DrawAnswer(Record):
    """What `comity draw` says."""

    file: str
    name: str
    kind: Literal["map", "scenario"]


@dataclass(frozen=True, slots=True, kw_only=True)
class FigureAnswer(Record):
    """One figure of a run."""

    run: str
    scenario: str
    rulebook: str
    seed: int
    person: str | None
    """Null for a figure of the whole episode."""
    profile: str | None
    metric: str
    value: float
    unit: str
    """1 for a share or a count."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DefinitionAnswer(Record):
    """What a metric means."""

    unit: str
    means: str
    source: str
    per: Literal["run", "visit", "person"]
    """`visit`: of a person to visit; `person`: of any person of the scenario."""


@dataclass(frozen=True, slots=True, kw_only=True)
class MetricsAnswer(Record):
    """`comity metrics --json`."""

    figures: tuple[FigureAnswer, ...]
    """Run by run; what has no value is left out."""
    by_profile: Mapping[str, Mapping[str, float]]
    """Mean of each figure of a person over all people of a profile in these runs."""
    definitions: Mapping[str, DefinitionAnswer]
