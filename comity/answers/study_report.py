"""What `comity study report`, `compare` and `show` answer."""

from __future__ import annotations

from collections.abc import Mapping

from pydantic import Field

from comity.answers.base import Answer

UNIT = Field(description="1 for a share or a count.")
SAID = Field(description="What differences between profiles are, and what they are not.")


class EstimateAnswer(Answer):
    """A mean over individuals and rooms, in the unit of what it is the mean of."""

    mean: float
    low: float | None = Field(
        description="End of the 95 % interval, which resamples individuals and rooms; null where one "
        "individual in one room leaves nothing to resample."
    )
    high: float | None
    monte_carlo_error: float | None = Field(
        description="Standard error of the mean from seeds alone; null where nothing was repeated."
    )
    episodes: int = Field(description="Episodes, or pairs of them, that have a value.")
    individuals: int
    rooms: int


class StudyLevelAnswer(Answer):
    """An outcome at one level of a factor."""

    outcome: str
    unit: str = UNIT
    factor: str
    level: str
    estimate: EstimateAnswer | None = Field(description="Null where no episode has the outcome there.")


class StudyDifferenceAnswer(Answer):
    """How an outcome differs between two levels, within the same individual, room and seed."""

    outcome: str
    unit: str = UNIT
    group: str | None = Field(description="Null for all groups together.")
    first: float = Field(description="Mean at the first level.")
    second: float
    difference: EstimateAnswer = Field(description="Second minus first.")


class StudyCompareAnswer(Answer):
    """`comity study compare --json`."""

    study: str
    statement: str = SAID
    factor: str
    first: str
    second: str
    pairs: int = Field(description="Pairs of visits that differ in the factor alone.")
    differences: tuple[StudyDifferenceAnswer, ...]


class ShortfallAnswer(Answer):
    """What a group misses by one parameter: 0 is best."""

    parameter: str
    unit: str = UNIT
    rulebook: str
    group: str
    missed: EstimateAnswer


class ServedWorseAnswer(Answer):
    """Which group misses most by a parameter, beside the one that misses least."""

    parameter: str
    unit: str = UNIT
    rulebook: str
    worst: str
    worst_missed: float
    best: str
    best_missed: float
    told_apart: bool = Field(description="Whether the two intervals lie apart.")


class IndividualServedAnswer(Answer):
    """An individual that was met outside its comfort."""

    individual: str
    group: str
    rulebook: str
    outside_comfort_m: float


class UnusualVisitAnswer(Answer):
    """A row of the table to look at: `comity study show DIR --row N` plays it again."""

    row: int
    scenario: str
    condition: str
    individual: str = Field(description="The person of the scenario where there is no individual.")
    seed: str
    what: str
    why: str
    page: str | None = Field(
        description="Of its episode, from the report's folder; null if not played again."
    )


class StudyReportAnswer(Answer):
    """`comity study report --json`."""

    study: str
    statement: str = SAID
    page: str
    figures: tuple[str, ...]
    visits: int = Field(description="Rows that are compared.")
    left_out: int = Field(description="Rows of people who are no individuals of the population.")
    individuals: int
    rooms: int
    seeds: int
    conditions: int
    meanings: Mapping[str, str] = Field(description="By outcome and by parameter.")
    levels: tuple[StudyLevelAnswer, ...]
    comparisons: tuple[StudyCompareAnswer, ...]
    shortfalls: tuple[ShortfallAnswer, ...]
    served_worse: tuple[ServedWorseAnswer, ...]
    individuals_served_worst: tuple[IndividualServedAnswer, ...]
    failures: int
    first_failures: tuple[UnusualVisitAnswer, ...]
    outliers: int
    farthest_outliers: tuple[UnusualVisitAnswer, ...]


class StudyShowAnswer(Answer):
    """`comity study show --json`."""

    study: str
    statement: str = SAID
    row: int
    episode: str = Field(description="The run folder.")
    page: str
    outcome: str
    trace_sha256: str
    same: bool = Field(description="Whether that is the digest in the table.")
    differs: str | None = Field(description="What is not as it was when the study ran; null where all is.")
