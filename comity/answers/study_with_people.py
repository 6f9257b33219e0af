"""What `comity study clips`, `collect`, `score` and `fields` answer."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

from comity_fis.record import Record


@dataclass(frozen=True, slots=True, kw_only=True)
class SubscaleAnswer(Record):
    """One subscale over all sheets."""

    subscale: str
    items: tuple[str, ...]
    needed: int
    """Answers that a sheet must have for a score."""
    scored: int
    """Sheets with a score."""
    mean: float | None
    """Of all scores."""
    alpha: float | None
    """Cronbach's; null for one item, or where all sums are the same."""
    alpha_low: float | None
    """End of the 95 % interval, which resamples participants."""
    alpha_high: float | None
    sheets: int
    """Sheets without a missing answer, which alpha is taken from."""
    participants: int
    """Whose sheets these are."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SheetScoresAnswer(Record):
    """The scores of one participant under one condition, subscales in their order."""

    participant: str
    condition: str
    """Empty where the answers name none."""
    scores: tuple[float | None, ...]
    """Null where too few items were answered."""
    answered: tuple[int, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class StudyScoreAnswer(Record):
    """`comity study score --json`."""

    questionnaire: str
    source: str
    answers: str
    """The file that was scored."""
    participants: int
    conditions: tuple[str, ...]
    missing: int
    """Answers that the sheets lack."""
    subscales: tuple[SubscaleAnswer, ...]
    sheets: tuple[SheetScoresAnswer, ...]
    unused: tuple[str, ...]
    """Columns of the answers that were not used."""
    files: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class StudyCollectAnswer(Record):
    """`comity study collect --json`."""

    study: str
    participant: str
    group: str
    conditions: tuple[str, ...]
    """In the order in which the participant meets them."""
    status: Literal["done", "stopped", "refused", "withdrawn"]
    """`refused`: no consent, and nothing is stored; `withdrawn`: all answers were deleted."""
    written: int
    """Answers that this command wrote, or deleted."""
    left: int
    """Questions that no answer stands to."""
    files: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class ClipAnswer(Record):
    """One film."""

    clip: str
    """The opaque name of its files."""
    value: Any
    """Of the parameter."""
    outcome: str
    length_s: float
    """Of the episode, simulated."""
    trace_sha256: str


@dataclass(frozen=True, slots=True, kw_only=True)
class ConfoundAnswer(Record):
    """A quantity that differs between the films, besides the parameter."""

    person: str
    """Empty for the whole episode."""
    quantity: str
    """As in the columns of a study."""
    unit: str
    values: tuple[float | str | None, ...]
    """Of each film."""
    difference: float | None
    """Largest minus smallest; null where one is no number."""
    definition: str


@dataclass(frozen=True, slots=True, kw_only=True)
class StudyClipsAnswer(Record):
    """`comity study clips --json`."""

    scenario: str
    parameter: str
    """Its path in the scenario."""
    speed: float
    """Simulated seconds per second, the same for all films."""
    clips: tuple[ClipAnswer, ...]
    """In the order of their names, which says nothing."""
    confounds: tuple[ConfoundAnswer, ...]
    """Duration, path, speed and gaze first."""
    folder: str
    files: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class ReportedFieldAnswer(Record):
    """One field of a report."""

    section: str
    field: str
    value: str | None
    """As Markdown; null where the lab has to fill it in."""
    asks: str | None
    """What the lab is to write."""
    applies: bool
    """False where the study cannot have it, as a simulated one has no recruitment: `value` says why."""


@dataclass(frozen=True, slots=True, kw_only=True)
class StudyFieldsAnswer(Record):
    """`comity study fields --json`."""

    study: str
    filled: int
    blank: int
    inapplicable: int
    """Fields that a study of this kind does not have."""
    fields: tuple[ReportedFieldAnswer, ...]
    file: str | None
