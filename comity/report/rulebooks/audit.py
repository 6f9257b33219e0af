"""The audit of a rulebook, in words and tables."""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING, get_args

from comity.report.difference import difference, share
from comity.report.text import number, table, words, words_of
from comity_fis import NumericParameter
from comity_fis.audit.audit import Audit
from comity_fis.audit.order import BAND_M
from comity_fis.rules.rule import Evidence
from comity_fis.validation.complaint import counted

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence

    from rich.console import RenderableType

    from comity_fis import Rulebook
    from comity_fis.audit import Audit, Coverage, Effect, FindingCheck, Pairs, Reached
    from comity_fis.audit.order import OrderCounts

LABELS_SHOWN = 6
"""Values in one cell; of more, their number is enough."""
CALLED = {"culture": "nationality"}
"""Attributes that the audit calls by what they are used for."""


def audit_text(audit: Audit, rulebook: Rulebook) -> Iterator[RenderableType]:
    """The same, for a person to read.

    Args:
        audit: What was found.
        rulebook: What was audited, for units and for the rules' own words.
    """
    yield (
        f"Rulebook {audit.rulebook}: {counted(len(rulebook.rules), 'rule')} on "
        f"{counted(len(rulebook.parameters), 'parameter')}"
    )
    yield "What it rests on and what it does. Whether that is right for anybody, people have to say."
    yield from _evidence(audit)
    yield from _coverage(audit.coverage)
    yield from _conflicts(audit)
    yield from _empty_terms(audit)
    yield from _effects(audit.effects, rulebook)
    yield from _pairs(audit.pairs, rulebook)
    yield from _findings(audit)


def _evidence(audit: Audit) -> Iterator[RenderableType]:
    evidence = audit.evidence
    grades = get_args(Evidence)
    rows = [
        (words(name), *(str(count.get(grade, "-")) for grade in grades))
        for name, count in evidence.parameters.items()
    ]
    total = [str(len(evidence.grades.get(grade, ())) or "-") for grade in grades]
    yield "\nRules by evidence"
    yield table([*rows, ("all rules", *total)], head=("parameter", *grades))
    deciding = sum(map(len, evidence.grades.values()))
    yield f"  {evidence.with_counter_evidence} of {deciding} name what speaks against them."
    if evidence.off:
        off = ", ".join(f"{len(numbers)} {grade}" for grade, numbers in evidence.off.items())
        yield f"  There and not in use: {off}."


def _coverage(coverage: Coverage) -> Iterator[RenderableType]:
    yield "\nWhom it covers"
    yield (
        f"  {coverage.cultures} of the {coverage.scored} rows of the table of scores change something when "
        "nothing else is known"
        + (f"; rules name {', '.join(coverage.named)}." if coverage.named else "; no rule names a culture.")
    )
    if coverage.cultures:
        yield "  Somebody from elsewhere is met as if nothing was known of their culture."
    if coverage.unruled:
        yield f"  Nothing decides {words_of(coverage.unruled)}: everybody gets the neutral value."
    yield "\nWhen one fact alone is known, the neutral value stands for"
    rows: list[tuple[str, str, str]] = []
    for parameter, facts in groupby(coverage.alone, key=lambda one: one.parameter):
        rows.append((words(parameter), "", ""))
        rows += [
            (f"  {words(one.attribute)}", f"{len(one.neutral)} of {one.values}", _some(one)) for one in facts
        ]
    yield table(rows)


def _some(reached: Reached) -> str:
    return ", ".join(map(words, reached.neutral)) if len(reached.neutral) <= LABELS_SHOWN else ""


def _conflicts(audit: Audit) -> Iterator[RenderableType]:
    yield "\nRules that contradict each other"
    if not audit.conflicts:
        yield "  No two rules hold to more than a half for one person and conclude what excludes each other."
        return
    rows: list[tuple[str, ...]] = []
    for parameter, own in groupby(audit.conflicts, key=lambda one: one.parameter):
        rows.append((words(parameter), "", "", ""))
        rows += [
            (
                f"  {one.first} {words(one.first_term)}, {one.second} {words(one.second_term)}",
                f"{one.people} of {one.tried}",
                f"{one.strength:.2f}",
                ", ".join(map(words, one.example.values())),
            )
            for one in own
        ]
    yield table(rows, head=("rules", "people", "up to", "for example"))
    yield "  Both hold to more than a half for so many of the people tried, the weaker one up to so far."


def _empty_terms(audit: Audit) -> Iterator[RenderableType]:
    if audit.empty_terms:
        yield "\nTerms that are 0 everywhere in their range; rules that conclude them change nothing"
        yield table(
            [(words(name), ", ".join(map(words, terms))) for name, terms in audit.empty_terms.items()]
        )


def _effects(effects: Sequence[Effect], rulebook: Rulebook) -> Iterator[RenderableType]:
    yield "\nHow far one attribute alone moves a parameter"
    rows: list[tuple[str, ...]] = []
    for parameter, own in groupby(effects, key=lambda one: one.parameter):
        rows.append((words(parameter), "", "", ""))
        for one in own:
            unit = _unit(rulebook, parameter)
            largest = (
                difference(one.largest, unit, sign=False) if one.words is None else counted(one.words, "word")
            )
            relative = "" if one.relative is None else f" ({share(one.relative)})"
            rows.append(
                (
                    f"  {words(one.attribute)}",
                    largest + relative,
                    difference(one.median, unit, sign=False),
                    f"{share(one.changed)} of {one.people}{'' if one.complete else ' (sample)'}",
                )
            )
    yield table(rows, head=("", "largest", "median", "moves people"))
    yield "  In brackets the share of what the rules can give. What is not listed changes nothing."


def _pairs(pairs: Sequence[Pairs], rulebook: Rulebook) -> Iterator[RenderableType]:
    yield "\nPeople who differ in nationality alone, or in gender alone"
    if not pairs:
        yield "  Neither decides anything: they are treated alike."
        return
    rows: list[tuple[str, ...]] = []
    for parameter, own in groupby(pairs, key=lambda one: one.parameter):
        rows.append((words(parameter), "", "", "", ""))
        rows += [_pairs_row(one, _unit(rulebook, parameter)) for one in own]
    yield table(rows, head=("", "pairs", "treated differently", "largest", "median"))
    yield from _examples(pairs, rulebook)


def _pairs_row(one: Pairs, unit: str | None) -> tuple[str, ...]:
    return (
        f"  {CALLED.get(one.attribute, words(one.attribute))}",
        f"{one.pairs}{'' if one.complete else ' (sample)'}",
        share(one.differing),
        difference(one.largest, unit, sign=False),
        difference(one.median, unit, sign=False),
    )


def _examples(pairs: Sequence[Pairs], rulebook: Rulebook) -> Iterator[RenderableType]:
    yield "\nThe pair with the largest difference, or the first that differs"
    rows = []
    for one in pairs:
        if (example := one.example) is not None:
            unit = _unit(rulebook, one.parameter)
            same = ", ".join(f"{words(name)} {words(value)}" for name, value in example.otherwise.items())
            rows.append(
                (
                    words(one.parameter),
                    f"{words(example.first)} {number(example.first_value, unit)}, "
                    f"{words(example.second)} {number(example.second_value, unit)}",
                    same,
                )
            )
    yield table(rows)


def _findings(audit: Audit) -> Iterator[RenderableType]:
    findings = audit.findings
    yield f"\nOrdinal findings (differences of up to {100 * BAND_M:.0f} cm count as none)"
    held = [row for row in findings.rows if row.verdict is not None]
    if held:
        yield table(
            [
                (
                    row.finding.key,
                    f"{row.finding}{' (across studies)' if row.finding.across else ''}",
                    f"{row.larger:.3f}, {row.smaller:.3f} {row.unit}",
                    str(row.verdict),
                )
                for row in held
            ],
            head=("study", "found", "rulebook", "verdict"),
        )
    yield f"  Each pair once: {_order(findings.counts)}."
    for name, counts in findings.by_attribute.items():
        single = findings.findings_by_attribute[name]
        of_all = f"; of {single.pairs} single findings {_order(single)}" if single != counts else ""
        yield f"  By {CALLED.get(name, words(name))}: {_order(counts)}{of_all}."
    if findings.within.pairs != findings.counts.pairs:
        yield f"  Without pairs across studies: {_order(findings.within)}."
    if findings.disputed:
        named = "; ".join(f"{first} and {second}" for first, second in findings.disputed)
        yield f"  Studies disagree on {named}: counted as most of them have it."
    against = [row for row in held if row.verdict == "contradicting"]
    if against:
        yield f"  Against findings stand rules {_rules(against)}."
    yield f"\n{counted(findings.untested, 'pair')} that it cannot be held to"
    yield table(_reasons(findings.rows).items())


def _order(counts: OrderCounts) -> str:
    return f"{counts.agreeing} agree, {counts.contradicting} contradict, {counts.equal} are made equal"


def _rules(rows: Iterable[FindingCheck]) -> str:
    return ", ".join(str(number) for number in sorted({number for row in rows for number in row.rules}))


def _reasons(rows: Iterable[FindingCheck]) -> Mapping[str, str]:
    """By reason, the findings."""
    reasons: dict[str, str] = {}
    for row in rows:
        if row.reason:
            found = f"{row.finding.key} ({row.finding})"
            reasons[row.reason] = f"{reasons[row.reason]}; {found}" if row.reason in reasons else found
    return reasons


def _unit(rulebook: Rulebook, parameter: str) -> str | None:
    declared = rulebook.parameters[parameter]
    return declared.unit if isinstance(declared, NumericParameter) else None
