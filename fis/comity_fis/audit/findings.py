"""Ordinal findings: what studies report about order, and whether a rulebook has it the same way."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING, Literal, cast

from comity_fis.audit.coverage import said
from comity_fis.audit.order import OrderCounts, Verdict, counted, equality_band, verdict
from comity_fis.record import Record
from comity_fis.variables.parameter import NumericParameter

if TYPE_CHECKING:
    from comity_fis.audit.attributes import Attribute
    from comity_fis.inference.value import ParameterValue
    from comity_fis.rulebook.rulebook import Rulebook

Relation = Literal[">", "="]


@dataclass(frozen=True, slots=True)
class StudyGroup(Record):
    """One of two groups, by one fact about its people."""

    attribute: str
    value: str

    def __str__(self) -> str:
        return self.value


@dataclass(frozen=True, slots=True, kw_only=True)
class StudyFinding(Record):
    """What one study found about two groups."""

    key: str
    """Of the study."""
    source: str
    parameter: str
    larger: StudyGroup
    relation: Relation
    """`=`: no difference was found."""
    smaller: StudyGroup
    measure: str
    n: str
    across: bool
    """Whether the two numbers come from different studies."""
    read: str
    """What of the source was read."""
    reservation: str
    """Why no rulebook can be held to it; empty where one can."""

    def __str__(self) -> str:
        return f"{self.larger} {self.relation} {self.smaller}"


@dataclass(frozen=True, slots=True)
class FindingCheck(Record):
    """A rulebook held to one finding."""

    finding: StudyFinding
    verdict: Verdict | None
    """None where it cannot be held to it."""
    larger: float | None
    """What the rulebook says of people of whom only the group is known, in the parameter's unit."""
    smaller: float | None
    unit: str | None
    rules: tuple[int, ...]
    """Numbers of the rules that decided the two values."""
    reason: str
    """Why it cannot be held to it; empty where it can."""


@dataclass(frozen=True, slots=True)
class HeldToFindings(Record):
    """A rulebook held to all findings."""

    rows: tuple[FindingCheck, ...]
    counts: OrderCounts
    """Of distinct pairs of groups, each once in whatever order, however many studies report on it; where they
    disagree the pair counts as most of them have it, and as different where they are equally many."""
    within: OrderCounts
    """The same by those findings alone whose two numbers come from one study."""
    by_attribute: Mapping[str, OrderCounts]
    """The same as `counts`, by what the two groups differ in."""
    findings_by_attribute: Mapping[str, OrderCounts]
    """Of single findings, each once, also where studies disagree on a pair; by what the groups differ in."""
    disputed: tuple[tuple[StudyGroup, StudyGroup], ...]
    """Pairs of which studies report different orders."""
    untested: int
    """Distinct pairs that this rulebook cannot be held to."""


@cache
def shipped_findings() -> tuple[StudyFinding, ...]:
    """The findings that come with the package, in the table's order."""
    text = files("comity_fis").joinpath("data/findings.csv").read_text(encoding="utf-8")
    rows = csv.DictReader(line for line in text.splitlines() if not line.startswith("#"))
    return tuple(
        StudyFinding(
            key=row["key"],
            source=row["source"],
            parameter=row["parameter"],
            larger=_group(row["larger"]),
            relation=cast(Relation, row["relation"]),
            smaller=_group(row["smaller"]),
            measure=row["measure"],
            n=row["n"],
            across=row["across"] == "yes",
            read=row["read"],
            reservation=row["held"],
        )
        for row in rows
    )


def held_to(
    rulebook: Rulebook, findings: Iterable[StudyFinding], known: Mapping[str, Attribute]
) -> HeldToFindings:
    """Hold a rulebook to findings, row by row.

    Args:
        rulebook: The rules.
        findings: For example the shipped ones.
        known: The rulebook's attributes.
    """
    rows = tuple(_held(rulebook, finding, known) for finding in findings)
    tested = _by_pair(row for row in rows if row.verdict is not None)
    within = _by_pair(row for row in rows if row.verdict is not None and not row.finding.across)
    stands = [_most_found(about) for about in tested.values()]
    return HeldToFindings(
        rows=rows,
        counts=_counts(stands),
        within=_counts(map(_most_found, within.values())),
        by_attribute={
            name: _counts(row for row in stands if row.finding.larger.attribute == name)
            for name in dict.fromkeys(row.finding.larger.attribute for row in stands)
        },
        findings_by_attribute={
            name: _counts(row for row in rows if row.finding.larger.attribute == name)
            for name in dict.fromkeys(row.finding.larger.attribute for row in stands)
        },
        disputed=tuple(
            (about[0].finding.larger, about[0].finding.smaller)
            for about in tested.values()
            if len(set(map(_found, about))) > 1
        ),
        untested=len(_by_pair(rows).keys() - tested.keys()),
    )


def _counts(rows: Iterable[FindingCheck]) -> OrderCounts:
    return counted(row.verdict for row in rows if row.verdict is not None)


def _by_pair(rows: Iterable[FindingCheck]) -> dict[tuple[str, frozenset[StudyGroup]], list[FindingCheck]]:
    """The findings on every pair of groups, in whatever order a study names the two."""
    pairs: dict[tuple[str, frozenset[StudyGroup]], list[FindingCheck]] = {}
    for row in rows:
        finding = row.finding
        pairs.setdefault((finding.parameter, frozenset((finding.larger, finding.smaller))), []).append(row)
    return pairs


def _most_found(about: Sequence[FindingCheck]) -> FindingCheck:
    """The finding on one pair that stands for all of them."""
    found = [_found(row) for row in about]
    most = max(found, key=lambda group: (found.count(group), group is not None, str(group)))
    return about[found.index(most)]


def _found(row: FindingCheck) -> StudyGroup | None:
    """The group that has more; None where both were found alike."""
    return row.finding.larger if row.finding.relation == ">" else None


def _held(rulebook: Rulebook, finding: StudyFinding, known: Mapping[str, Attribute]) -> FindingCheck:
    parameter = rulebook.parameters.get(finding.parameter)
    if reason := finding.reservation or _lacking(rulebook, finding, known):
        return FindingCheck(finding, None, None, None, None, (), reason)
    assert isinstance(parameter, NumericParameter)
    larger = _of_group(rulebook, finding.parameter, finding.larger, known)
    smaller = _of_group(rulebook, finding.parameter, finding.smaller, known)
    found = 1 if finding.relation == ">" else 0
    return FindingCheck(
        finding=finding,
        verdict=verdict(found, larger.number - smaller.number, equality_band(parameter)),
        larger=larger.number,
        smaller=smaller.number,
        unit=parameter.unit,
        rules=tuple(sorted({fired.rule.number for value in (larger, smaller) for fired in value.fired})),
        reason="",
    )


def _lacking(rulebook: Rulebook, finding: StudyFinding, known: Mapping[str, Attribute]) -> str:
    """What the rulebook does not know; empty where it knows all that is compared."""
    if not isinstance(rulebook.parameters.get(finding.parameter), NumericParameter):
        return f"the rulebook has no numeric parameter {finding.parameter}"
    for group in (finding.larger, finding.smaller):
        if group.attribute not in known:
            return f"the rulebook knows no {group.attribute}"
        if group.value not in known[group.attribute].labels:
            return f"the rulebook knows no {group.attribute} {group.value}"
    return ""


def _of_group(
    rulebook: Rulebook, parameter: str, group: StudyGroup, known: Mapping[str, Attribute]
) -> ParameterValue:
    attribute = known[group.attribute]
    return rulebook.infer(said(rulebook, attribute, attribute.labels.index(group.value)))[parameter]


def _group(text: str) -> StudyGroup:
    attribute, _, value = text.partition("=")
    return StudyGroup(attribute, value)
