"""The shape of the answers of `comity evaluate` and `comity audit`; `comity schema` prints these too."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from comity_fis.audit.accuracy import StudyAccuracy
from comity_fis.audit.agreement import StudyAgreement
from comity_fis.inference.value import Origin
from comity_fis.record import Record


@dataclass(frozen=True, slots=True, kw_only=True)
class MeasuredRowAnswer(Record):
    """One measured row beside what the rulebook says."""

    line: int
    study: str
    source: str
    facts: Mapping[str, float | str]
    measured: float | str
    """In the parameter's unit."""
    between: Literal["surface", "centre"] | None
    """Points of the bodies that a distance was measured between; null: not stated."""
    partner: Literal["robot", "person"]
    n: int | None
    sd: float | None
    standard_error: float | None
    predicted: float | str
    """In the parameter's unit and convention."""
    spread: float | None
    origin: Origin
    errors: Mapping[str, float]
    """By reading, predicted less measured; empty for a nominal parameter."""
    note: str


@dataclass(frozen=True, slots=True, kw_only=True)
class NumbersAnswer(Record):
    """All rows on a numeric parameter."""

    unit: str
    measured: Literal["surface", "centre"] | None
    """The rulebook's convention."""
    equality_band: float
    """The largest difference that counts as none."""
    rows: tuple[MeasuredRowAnswer, ...]
    readings: Mapping[Literal["surface", "centre", "as_stated"], Mapping[str, StudyAccuracy]]
    """How rows are read that do not say between which points they measured; then by study."""


@dataclass(frozen=True, slots=True, kw_only=True)
class WordsAnswer(Record):
    """All rows on a nominal parameter."""

    rows: tuple[MeasuredRowAnswer, ...]
    studies: Mapping[str, StudyAgreement]


@dataclass(frozen=True, slots=True, kw_only=True)
class EvaluateAnswer(Record):
    """`comity evaluate --json`."""

    rulebook: str
    file: str
    rows: int
    rows_without_score: int
    """Rows of a culture to which no table gives a score."""
    unused: tuple[str, ...]
    """Headings that say nothing to this rulebook."""
    robot_radius_m: float
    person_radius_m: float
    numbers: Mapping[str, NumbersAnswer]
    """By numeric parameter."""
    words: Mapping[str, WordsAnswer]
    """By nominal parameter."""
    files: tuple[str, ...]
