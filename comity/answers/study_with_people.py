"""What `comity study clips`, `collect`, `score` and `fields` answer."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import Field

from comity.answers.base import Answer


class SubscaleAnswer(Answer):
    """One subscale over all sheets."""

    subscale: str
    items: tuple[str, ...]
    needed: int = Field(description="Answers that a sheet must have for a score.")
    scored: int = Field(description="Sheets with a score.")
    mean: float | None = Field(description="Of all scores.")
    alpha: float | None = Field(description="Cronbach's; null for one item, or where all sums are the same.")
    alpha_low: float | None = Field(description="End of the 95 % interval, which resamples participants.")
    alpha_high: float | None
    sheets: int = Field(description="Sheets without a missing answer, which alpha is taken from.")
    participants: int = Field(description="Whose sheets these are.")


class SheetScoresAnswer(Answer):
    """The scores of one participant under one condition, subscales in their order."""

    participant: str
    condition: str = Field(description="Empty where the answers name none.")
    scores: tuple[float | None, ...] = Field(description="Null where too few items were answered.")
    answered: tuple[int, ...]


class StudyScoreAnswer(Answer):
    """`comity study score --json`."""

    questionnaire: str
    source: str
    answers: str = Field(description="The file that was scored.")
    participants: int
    conditions: tuple[str, ...]
    missing: int = Field(description="Answers that the sheets lack.")
    subscales: tuple[SubscaleAnswer, ...]
    sheets: tuple[SheetScoresAnswer, ...]
    unused: tuple[str, ...] = Field(description="Columns of the answers that were not used.")
    files: tuple[str, ...]


class StudyCollectAnswer(Answer):
    """`comity study collect --json`."""

    study: str
    participant: str
    group: str
    conditions: tuple[str, ...] = Field(description="In the order in which the participant meets them.")
    status: Literal["done", "stopped", "refused", "withdrawn"] = Field(
        description="`refused`: no consent, and nothing is stored; `withdrawn`: all answers were deleted."
    )
    written: int = Field(description="Answers that this command wrote, or deleted.")
    left: int = Field(description="Questions that no answer stands to.")
    files: tuple[str, ...]


class ClipAnswer(Answer):
    """One film."""

    clip: str = Field(description="The opaque name of its files.")
    value: Any = Field(description="Of the parameter.")
    outcome: str
    length_s: float = Field(description="Of the episode, simulated.")
    trace_sha256: str


class ConfoundAnswer(Answer):
    """A quantity that differs between the films, besides the parameter."""

    person: str = Field(description="Empty for the whole episode.")
    quantity: str = Field(description="As in the columns of a study.")
    unit: str
    values: tuple[float | str | None, ...] = Field(description="Of each film.")
    difference: float | None = Field(description="Largest minus smallest; null where one is no number.")
    definition: str


class StudyClipsAnswer(Answer):
    """`comity study clips --json`."""

    scenario: str
    parameter: str = Field(description="Its path in the scenario.")
    speed: float = Field(description="Simulated seconds per second, the same for all films.")
    clips: tuple[ClipAnswer, ...] = Field(description="In the order of their names, which says nothing.")
    confounds: tuple[ConfoundAnswer, ...] = Field(description="Duration, path, speed and gaze first.")
    folder: str
    files: tuple[str, ...]


class ReportedFieldAnswer(Answer):
    """One field of a report."""

    section: str
    field: str
    value: str | None = Field(description="As Markdown; null where the lab has to fill it in.")
    asks: str | None = Field(description="What the lab is to write.")


class StudyFieldsAnswer(Answer):
    """`comity study fields --json`."""

    study: str
    filled: int
    blank: int
    fields: tuple[ReportedFieldAnswer, ...]
    file: str | None
