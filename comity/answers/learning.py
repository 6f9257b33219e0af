"""What `comity learn` answers: what a table proposes, and how it stands to what is simpler."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from pydantic import Field

from comity.answers.base import Answer


class LearntRuleAnswer(Answer):
    """A rule that rows propose."""

    rule: str
    conclusion: str
    mean: float = Field(description="Of what they said, weighted, in the parameter's unit.")
    support: float = Field(description="People behind it, each by the degree to which they belong here.")
    agreement: float = Field(description="Mean degree of their values in the conclusion, in [0, 1].")
    weight: float = Field(description="Of the rule, in (0, 1): support / (support + 1).")
    thin: bool = Field(description="Whether too few people are behind it: it is not proposed then.")


class GroupPriorAnswer(Answer):
    """One culture, after its people were asked."""

    people: int
    mean: float = Field(description="Of its people's means, in the parameter's unit, less the situation.")
    value: float = Field(description="What to expect of a new person, drawn towards everybody's.")
    standard_error: float = Field(description="Of the mean.")
    thin: bool = Field(description="Whether too few people are behind it: it gets no rule then.")


class PriorAnswer(Answer):
    """What to expect of people, partially pooled. All in the parameter's unit."""

    before: float = Field(description="The neutral value that stood.")
    everybody: float = Field(description="Of a person whose culture is unknown, or was not asked.")
    groups: Mapping[str, GroupPriorAnswer] = Field(description="By culture.")
    between_groups: float = Field(description="Standard deviation.")
    between_people: float = Field(
        description="The same, of people of one culture: of the rows, with the declared spread counted in."
    )
    seen_between_people: float | None = Field(
        description="The same by the rows alone; null: no culture has two people."
    )
    declared_spread: float = Field(description="Of the rulebook, before the rows; it counts as some people.")
    within_person: float | None = Field(
        description="The same, of one person's answers; null: nobody gave two"
    )
    trust_in_one_answer: float | None = Field(
        description="The share that a person's one answer has in what is expected of them, in [0, 1]."
    )
    individuals: Mapping[str, float] = Field(
        description="By participant (`study/participant`), what to expect of them again; empty where nobody "
        "gave two answers. Nothing of it is written into a rulebook."
    )


class ErrorAnswer(Answer):
    """How far one contender is off what it has not seen."""

    mean_absolute_error: float = Field(description="Of each unit's rows, then of the units.")
    units: int = Field(description="Participants, studies or rows of which it says anything.")


class ErrorDifferenceAnswer(Answer):
    """One contender's error less another's, on the rows of which both say something."""

    difference: float = Field(description="Below 0 where the first is nearer to what people said.")
    low: float | None = Field(description="Of the 95 % interval, paired bootstrap; null: too few units.")
    high: float | None
    units: int
    verdict: Literal["better", "worse", "not told apart"]


class LearnAnswer(Answer):
    """`comity learn --json`."""

    file: str
    rulebook: str
    parameter: str
    unit: str
    rows: int
    other_rows: int = Field(description="Rows on other parameters, which are not used.")
    people: int
    studies: int
    unstated: int = Field(
        description="Rows that do not say between which points they measured: taken as the parameter is."
    )
    unused: tuple[str, ...] = Field(description="Headings that say nothing to this rulebook.")
    inputs: tuple[str, ...] = Field(description="Variables that rules may read.")
    lacking_inputs: int = Field(
        description="Rows that no rule is learnt from: an input is not known, or has no term."
    )
    rules: tuple[LearntRuleAnswer, ...] = Field(description="Best supported first.")
    prior: PriorAnswer | None = Field(description="Null where no row names its participant.")
    constant: float = Field(description="The mean of all rows, in the parameter's unit.")
    left_out: Literal["participant", "study", "row"]
    units: int
    errors: Mapping[str, ErrorAnswer] = Field(description="By contender.")
    differences: Mapping[str, Mapping[str, ErrorDifferenceAnswer]] = Field(
        description="By proposal (rules, prior), then by the contender that it is compared with."
    )
    in_the_way: Mapping[str, tuple[str, ...]] = Field(
        description="By proposal, what is simpler and not beaten by it; empty: the proposal stands."
    )
    stands: Literal["rules", "prior"] | None = Field(description="The best proposal with nothing in its way.")
    written: Literal["rules", "prior"] | None
    files: tuple[str, ...]
