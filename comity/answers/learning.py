"""What `comity learn` answers: what a table proposes, and how it stands to what is simpler."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from comity_fis.record import Record


@dataclass(frozen=True, slots=True, kw_only=True)
class LearntRuleAnswer(Record):
    """A rule that rows propose."""

    rule: str
    conclusion: str
    mean: float
    """Of what they said, weighted, in the parameter's unit."""
    support: float
    """People behind it, each by the degree to which they belong here."""
    agreement: float
    """Mean degree of their values in the conclusion, in [0, 1]."""
    weight: float
    """Of the rule, in (0, 1): support / (support + 1)."""
    thin: bool
    """Whether too few people are behind it: it is not proposed then."""


@dataclass(frozen=True, slots=True, kw_only=True)
class GroupPriorAnswer(Record):
    """One culture, after its people were asked."""

    people: int
    mean: float
    """Of its people's means, in the parameter's unit, less the situation."""
    value: float
    """What to expect of a new person, drawn towards everybody's."""
    standard_error: float
    """Of the mean."""
    thin: bool
    """Whether too few people are behind it: it gets no rule then."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PriorAnswer(Record):
    """What to expect of people, partially pooled. All in the parameter's unit."""

    before: float
    """The neutral value that stood."""
    everybody: float
    """Of a person whose culture is unknown, or was not asked."""
    groups: Mapping[str, GroupPriorAnswer]
    """By culture."""
    between_groups: float
    """Standard deviation."""
    between_people: float
    """The same, of people of one culture: of the rows, with the declared spread counted in."""
    seen_between_people: float | None
    """The same by the rows alone; null: no culture has two people."""
    declared_spread: float
    """Of the rulebook, before the rows; it counts as some people."""
    within_person: float | None
    """The same, of one person's answers; null: nobody gave two"""
    trust_in_one_answer: float | None
    """The share that a person's one answer has in what is expected of them, in [0, 1]."""
    individuals: Mapping[str, float]
    """By participant (`study/participant`), what to expect of them again; empty where nobody gave two
    answers. Nothing of it is written into a rulebook."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ErrorAnswer(Record):
    """How far one contender is off what it has not seen."""

    mean_absolute_error: float
    """Of each unit's rows, then of the units."""
    units: int
    """Participants, studies or rows of which it says anything."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ErrorDifferenceAnswer(Record):
    """One contender's error less another's, on the rows of which both say something."""

    difference: float
    """Below 0 where the first is nearer to what people said."""
    low: float | None
    """Of the 95 % interval, paired bootstrap; null: too few units."""
    high: float | None
    units: int
    verdict: Literal["better", "worse", "not told apart"]


@dataclass(frozen=True, slots=True, kw_only=True)
class LearnAnswer(Record):
    """`comity learn --json`."""

    file: str
    rulebook: str
    parameter: str
    unit: str
    rows: int
    other_rows: int
    """Rows on other parameters, which are not used."""
    people: int
    studies: int
    unstated: int
    """Rows that do not say between which points they measured: taken as the parameter is."""
    unused: tuple[str, ...]
    """Headings that say nothing to this rulebook."""
    inputs: tuple[str, ...]
    """Variables that rules may read."""
    lacking_inputs: int
    """Rows that no rule is learnt from: an input is not known, or has no term."""
    rules: tuple[LearntRuleAnswer, ...]
    """Best supported first."""
    prior: PriorAnswer | None
    """Null where no row names its participant."""
    constant: float
    """The mean of all rows, in the parameter's unit."""
    left_out: Literal["participant", "study", "row"]
    units: int
    errors: Mapping[str, ErrorAnswer]
    """By contender."""
    differences: Mapping[str, Mapping[str, ErrorDifferenceAnswer]]
    """By proposal (rules, prior), then by the contender that it is compared with."""
    in_the_way: Mapping[str, tuple[str, ...]]
    """By proposal, what is simpler and not beaten by it; empty: the proposal stands."""
    stands: Literal["rules", "prior"] | None
    """The best proposal with nothing in its way."""
    written: Literal["rules", "prior"] | None
    files: tuple[str, ...]
