"""The shape of the answers of `comity evaluate` and `comity audit`; `comity schema` prints these too."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from pydantic import Field

from comity.answers import Answer
from comity_fis.audit.order import Verdict
from comity_fis.inference.value import Origin
from comity_fis.rules.rule import Evidence


class RankCorrelationAnswer(Answer):
    """Spearman's, of predicted and measured."""

    value: float
    rows: int
    low: float | None = Field(description="Of the 95 % interval; null for fewer than four rows.")
    high: float | None


class OrderAnswer(Answer):
    """Pairs, each counted once."""

    agreeing: int
    contradicting: int
    equal: int = Field(description="A difference was found, and the rulebook makes none.")


class MeasuredRowAnswer(Answer):
    """One measured row beside what the rulebook says."""

    line: int
    study: str
    source: str
    facts: Mapping[str, float | str]
    measured: float | str = Field(description="In the parameter's unit.")
    between: Literal["surface", "centre"] | None = Field(
        description="Points of the bodies that a distance was measured between; null: not stated."
    )
    partner: Literal["robot", "person"]
    n: int | None
    sd: float | None
    standard_error: float | None
    predicted: float | str = Field(description="In the parameter's unit and convention.")
    spread: float | None
    origin: Origin
    errors: Mapping[str, float] = Field(
        description="By reading, predicted less measured; empty for a nominal parameter."
    )
    note: str


class StudyAccuracyAnswer(Answer):
    """One study under one reading. Errors in the parameter's unit."""

    rows: int
    mean_absolute_error: float
    bias: float
    neutral: float = Field(description="Mean absolute error of the parameter's neutral value.")
    constant: float | None = Field(
        description="Mean absolute error of the mean of the other rows; null for a single row."
    )
    line: float | None = Field(
        description="Of a straight line over individualism through the other rows; null where they make none."
    )
    rank_correlation: RankCorrelationAnswer | None = Field(description="Null where all are alike.")
    order: OrderAnswer


class NumbersAnswer(Answer):
    """All rows on a numeric parameter."""

    unit: str
    measured: Literal["surface", "centre"] | None = Field(description="The rulebook's convention.")
    equality_band: float = Field(description="The largest difference that counts as none.")
    rows: tuple[MeasuredRowAnswer, ...]
    readings: Mapping[Literal["surface", "centre", "as_stated"], Mapping[str, StudyAccuracyAnswer]] = Field(
        description="How rows are read that do not say between which points they measured; then by study."
    )


class StudyAgreementAnswer(Answer):
    """One study on a nominal parameter."""

    rows: int
    hits: int
    constant_hits: int | None = Field(description="Of the most frequent word of the other rows.")


class WordsAnswer(Answer):
    """All rows on a nominal parameter."""

    rows: tuple[MeasuredRowAnswer, ...]
    studies: Mapping[str, StudyAgreementAnswer]


class EvaluateAnswer(Answer):
    """`comity evaluate --json`."""

    rulebook: str
    file: str
    rows: int
    rows_without_score: int = Field(description="Rows of a culture to which no table gives a score.")
    unused: tuple[str, ...] = Field(description="Headings that say nothing to this rulebook.")
    robot_radius_m: float
    person_radius_m: float
    numbers: Mapping[str, NumbersAnswer] = Field(description="By numeric parameter.")
    words: Mapping[str, WordsAnswer] = Field(description="By nominal parameter.")
    files: tuple[str, ...]


class EvidenceAnswer(Answer):
    """What the rules rest on."""

    grades: Mapping[Evidence, tuple[int, ...]] = Field(
        description="Numbers of the rules that decide something."
    )
    off: Mapping[Evidence, tuple[int, ...]] = Field(description="Numbers of the rules that decide nothing.")
    parameters: Mapping[str, Mapping[Evidence, int]]
    with_counter_evidence: int


class ReachedAnswer(Answer):
    """People of whom one fact alone is known."""

    parameter: str
    attribute: str
    values: int
    neutral: tuple[str, ...] = Field(description="Values with which the neutral value stands.")


class CoverageAnswer(Answer):
    """Whom the rules know anything about."""

    scored: int = Field(description="Rows of the table of scores.")
    cultures: int = Field(description="Of them, those that change something when nothing else is known.")
    named: tuple[str, ...] = Field(description="Cultures that a rule names.")
    alone: tuple[ReachedAnswer, ...]
    unread: Mapping[str, tuple[str, ...]] = Field(description="By parameter, what changes nothing about it.")
    unruled: tuple[str, ...] = Field(description="Parameters that nothing decides.")


class ConflictAnswer(Answer):
    """Two rules that hold to more than a half for somebody, and conclude what excludes each other."""

    parameter: str
    first: int
    second: int
    first_term: str
    second_term: str
    people: int
    tried: int
    strength: float = Field(description="Of the weaker rule, where it is largest.")
    example: Mapping[str, str]


class EffectAnswer(Answer):
    """What one attribute can do to one parameter."""

    parameter: str
    attribute: str
    people: int
    complete: bool = Field(description="Whether these are all combinations of levels, and not a sample.")
    changed: float = Field(description="Share of people whose treatment depends on it.")
    largest: float | None = Field(description="Range, in the parameter's unit; null for words.")
    median: float | None
    relative: float | None = Field(description="The largest as a share of what the rules can give.")
    words: int | None = Field(description="Most different words that one person can get.")


class ExampleAnswer(Answer):
    """Two people who differ in one attribute alone."""

    first: str
    second: str
    otherwise: Mapping[str, str]
    first_value: float | str
    second_value: float | str


class PairsAnswer(Answer):
    """All pairs of people who differ in one attribute alone."""

    parameter: str
    attribute: str
    pairs: int
    complete: bool
    differing: float
    largest: float | None
    median: float | None
    example: ExampleAnswer | None


class GroupAnswer(Answer):
    """One of two groups that a study compared."""

    attribute: str
    value: str


class FindingAnswer(Answer):
    """What a study found about order."""

    key: str
    source: str
    parameter: str
    larger: GroupAnswer
    relation: Literal[">", "="]
    smaller: GroupAnswer
    measure: str
    n: str
    across: bool = Field(description="Whether the two numbers come from different studies.")
    read: str
    reservation: str


class HeldAnswer(Answer):
    """A rulebook held to one finding."""

    finding: FindingAnswer
    verdict: Verdict | None = Field(description="Null where the rulebook cannot be held to it.")
    larger: float | None
    smaller: float | None
    unit: str | None
    rules: tuple[int, ...]
    reason: str


class FindingsAnswer(Answer):
    """A rulebook held to all findings."""

    rows: tuple[HeldAnswer, ...]
    counts: OrderAnswer = Field(description="Of distinct pairs, each once in whatever order.")
    within: OrderAnswer = Field(description="The same without pairs across studies.")
    by_attribute: Mapping[str, OrderAnswer] = Field(description="Of distinct pairs, as `counts`.")
    findings_by_attribute: Mapping[str, OrderAnswer] = Field(
        description="Of single findings, also where studies disagree on a pair."
    )
    disputed: tuple[tuple[GroupAnswer, GroupAnswer], ...] = Field(
        description="Pairs of which studies report different orders; each counts as most of them have it."
    )
    untested: int


class AuditAnswer(Answer):
    """`comity audit --json`."""

    rulebook: str
    evidence: EvidenceAnswer
    coverage: CoverageAnswer
    conflicts: tuple[ConflictAnswer, ...]
    effects: tuple[EffectAnswer, ...]
    pairs: tuple[PairsAnswer, ...]
    findings: FindingsAnswer
    empty_terms: Mapping[str, tuple[str, ...]] = Field(
        description="By parameter, terms that are 0 everywhere in its range: their rules change nothing."
    )
