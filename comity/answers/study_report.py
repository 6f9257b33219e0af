"""What `comity study report`, `compare` and `show` answer."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from comity_fis.record import Record


@dataclass(frozen=True, slots=True, kw_only=True)
class EstimateAnswer(Record):
    """A mean over individuals and rooms, in the unit of what it is the mean of."""

    mean: float
    low: float | None
    """End of the 95 % interval, which resamples individuals, rooms and seeds; null where one of each leaves
    nothing to resample."""
    high: float | None
    monte_carlo_error: float | None
    """Standard error of the mean from seeds alone; null where nothing was repeated."""
    episodes: int
    """Episodes, or pairs of them, that have a value."""
    individuals: int
    rooms: int
    seeds: int


@dataclass(frozen=True, slots=True, kw_only=True)
class StudyLevelAnswer(Record):
    """An outcome at one level of a factor."""

    outcome: str
    unit: str
    """1 for a share or a count."""
    factor: str
    level: str
    estimate: EstimateAnswer | None
    """Null where no episode has the outcome there."""


@dataclass(frozen=True, slots=True, kw_only=True)
class StudyDifferenceAnswer(Record):
    """How an outcome differs between two levels, within the same individual, room and seed."""

    outcome: str
    unit: str
    """1 for a share or a count."""
    group: str | None
    """Null for all groups together."""
    first: float
    """Mean at the first level."""
    second: float
    difference: EstimateAnswer
    """Second minus first."""


@dataclass(frozen=True, slots=True, kw_only=True)
class StudyCompareAnswer(Record):
    """`comity study compare --json`."""

    study: str
    statement: str
    """What differences between profiles are, and what they are not."""
    factor: str
    first: str
    second: str
    pairs: int
    """Pairs of visits that differ in the factor alone."""
    differences: tuple[StudyDifferenceAnswer, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class ShortfallAnswer(Record):
    """What a group misses by one parameter: 0 is best."""

    parameter: str
    unit: str
    """1 for a share or a count."""
    rulebook: str
    group: str
    missed: EstimateAnswer


@dataclass(frozen=True, slots=True, kw_only=True)
class ServedWorseAnswer(Record):
    """Which group misses most by a parameter, beside the one that misses least."""

    parameter: str
    unit: str
    """1 for a share or a count."""
    rulebook: str
    worst: str
    worst_missed: float
    best: str
    best_missed: float
    told_apart: bool
    """Whether the two intervals lie apart."""


@dataclass(frozen=True, slots=True, kw_only=True)
class IndividualServedAnswer(Record):
    """An individual that was met outside its comfort."""

    individual: str
    group: str
    rulebook: str
    outside_comfort_m: float


@dataclass(frozen=True, slots=True, kw_only=True)
class UnusualVisitAnswer(Record):
    """A row of the table to look at: `comity study show DIR --row N` plays it again."""

    row: int
    scenario: str
    condition: str
    individual: str
    """The person of the scenario where there is no individual."""
    seed: str
    what: str
    why: str
    alike: int
    """Visits of the table with the same trace, of which an outlier stands for all; 1 of a failure."""
    page: str | None
    """Of its episode, from the report's folder; null if not played again."""


@dataclass(frozen=True, slots=True, kw_only=True)
class StudyReportAnswer(Record):
    """`comity study report --json`."""

    study: str
    statement: str
    """What differences between profiles are, and what they are not."""
    page: str
    figures: tuple[str, ...]
    visits: int
    """Rows that are compared."""
    left_out: int
    """Rows of people who are no individuals of the population."""
    individuals: int
    rooms: int
    seeds: int
    conditions: int
    meanings: Mapping[str, str]
    """By outcome and by parameter."""
    levels: tuple[StudyLevelAnswer, ...]
    comparisons: tuple[StudyCompareAnswer, ...]
    shortfalls: tuple[ShortfallAnswer, ...]
    served_worse: tuple[ServedWorseAnswer, ...]
    individuals_served_worst: tuple[IndividualServedAnswer, ...]
    failures: int
    first_failures: tuple[UnusualVisitAnswer, ...]
    """All of them, the first in the table first."""
    outliers: int
    """Different traces that have one."""
    farthest_outliers: tuple[UnusualVisitAnswer, ...]
    """All of them, the farthest first."""


@dataclass(frozen=True, slots=True, kw_only=True)
class StudyShowAnswer(Record):
    """`comity study show --json`."""

    study: str
    statement: str
    """What differences between profiles are, and what they are not."""
    row: int
    episode: str
    """The run folder."""
    page: str
    outcome: str
    trace_sha256: str
    same: bool
    """Whether that is the digest in the table."""
    differs: str | None
    """What is not as it was when the study ran; null where all is."""
