"""Evidence by grade: how well the rules of a rulebook are supported."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, get_args

from comity_fis.record import Record
from comity_fis.rules.rule import Evidence

if TYPE_CHECKING:
    from comity_fis.rulebook.rulebook import Rulebook


@dataclass(frozen=True, slots=True, kw_only=True)
class EvidenceCount(Record):
    """The rules of one rulebook, by grade of evidence."""

    grades: Mapping[Evidence, tuple[int, ...]]
    """Numbers of active rules by grade, strongest grade first."""
    off: Mapping[Evidence, tuple[int, ...]]
    """Numbers of inactive rules by grade."""
    parameters: Mapping[str, Mapping[Evidence, int]]
    """By parameter, number of active rules of each grade."""
    with_counter_evidence: int
    """Number of active rules with counter-evidence."""


def count_evidence(rulebook: Rulebook) -> EvidenceCount:
    """Count the rules by grade."""
    deciding = deciding_rules(rulebook)
    parameters: dict[str, dict[Evidence, int]] = {name: {} for name in rulebook.parameters}
    for rule in rulebook.rules:
        for name in dict.fromkeys(is_.name for is_ in rule.consequents):
            if rule.number in deciding and name in parameters:
                parameters[name][rule.evidence] = parameters[name].get(rule.evidence, 0) + 1
    return EvidenceCount(
        grades=_by_grade(rulebook, deciding, decides=True),
        off=_by_grade(rulebook, deciding, decides=False),
        parameters=parameters,
        with_counter_evidence=sum(
            bool(rule.counter_evidence) for rule in rulebook.rules if rule.number in deciding
        ),
    )


def deciding_rules(rulebook: Rulebook) -> frozenset[int]:
    """Numbers of the active rules."""
    return frozenset(rule.number for rule in rulebook.rules if rule.enabled)


def _by_grade(
    rulebook: Rulebook, deciding: frozenset[int], *, decides: bool
) -> dict[Evidence, tuple[int, ...]]:
    found = {
        grade: tuple(
            rule.number
            for rule in rulebook.rules
            if rule.evidence == grade and (rule.number in deciding) == decides
        )
        for grade in get_args(Evidence)
    }
    return {grade: numbers for grade, numbers in found.items() if numbers}
