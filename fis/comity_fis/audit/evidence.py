"""Evidence by grade: what the rules of a rulebook rest on."""

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
    """The rules of one rulebook, by how well they are supported."""

    grades: Mapping[Evidence, tuple[int, ...]]
    """Numbers of the rules that decide something, by grade, strongest grade first."""
    off: Mapping[Evidence, tuple[int, ...]]
    """Numbers of the rules that are there and decide nothing."""
    parameters: Mapping[str, Mapping[Evidence, int]]
    """By parameter, how many rules of each grade decide it."""
    with_counter_evidence: int
    """Deciding rules that name what speaks against them."""


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
    """The numbers of the rules that are on."""
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
