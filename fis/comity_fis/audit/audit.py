"""The audit of a rulebook: its evidence, coverage, contradictions, and effects on people."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity_fis.audit.attributes import attributes
from comity_fis.audit.conflicts import Conflict, conflicts
from comity_fis.audit.coverage import Coverage, coverage
from comity_fis.audit.evidence import EvidenceCount, count_evidence
from comity_fis.audit.findings import HeldToFindings, held_to, shipped_findings
from comity_fis.audit.sweep import decided_by, sweep
from comity_fis.audit.treatment import Effect, Pairs, effect, pairs
from comity_fis.record import Record
from comity_fis.variables.own_words import CULTURE
from comity_fis.variables.parameter import NumericParameter

if TYPE_CHECKING:
    from comity_fis.rulebook.rulebook import Rulebook

COMPARED = (CULTURE, "gender")
"""Attributes for which every pair of values is compared."""


@dataclass(frozen=True, slots=True)
class Audit(Record):
    """All results of an audit of one rulebook."""

    rulebook: str
    evidence: EvidenceCount
    coverage: Coverage
    conflicts: tuple[Conflict, ...]
    effects: tuple[Effect, ...]
    """By parameter, for each attribute that can change it; all others change nothing."""
    pairs: tuple[Pairs, ...]
    """By parameter, for nationality and gender if they can change it."""
    findings: HeldToFindings
    empty_terms: Mapping[str, tuple[str, ...]]
    """By parameter, terms that are 0 everywhere in its range, so rules that conclude them have no effect."""


def audit(rulebook: Rulebook) -> Audit:
    """Run all audits of a rulebook; deterministic, and without data about people."""
    known = attributes(rulebook)
    effects: list[Effect] = []
    compared: list[Pairs] = []
    for name, parameter in rulebook.parameters.items():
        decides = decided_by(rulebook, name, known)
        for attribute in decides.values():
            others = [other for other in decides.values() if other is not attribute]
            swept = sweep(rulebook, name, attribute, others)
            effects.append(effect(parameter, swept))
            if attribute.name in COMPARED:
                compared.append(pairs(parameter, swept))
    return Audit(
        rulebook=rulebook.name,
        evidence=count_evidence(rulebook),
        coverage=coverage(rulebook, known),
        conflicts=conflicts(rulebook, known),
        effects=tuple(effects),
        pairs=tuple(compared),
        findings=held_to(rulebook, shipped_findings(), known),
        empty_terms={
            name: parameter.empty_terms
            for name, parameter in rulebook.parameters.items()
            if isinstance(parameter, NumericParameter) and parameter.empty_terms
        },
    )
