"""What `comity study collect` and `comity study score` answer."""

from __future__ import annotations

from typing import Literal

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
