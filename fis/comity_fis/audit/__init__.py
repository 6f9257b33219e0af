"""Auditing a rulebook: `audit(load_rulebook("bruno2017"))`.

An audit needs no data about people and does not judge what is right for them: it shows what a rulebook is
based on and what it does, so that its users can judge.
"""

from comity_fis.audit.attributes import Attribute, attributes
from comity_fis.audit.audit import Audit, audit
from comity_fis.audit.conflicts import Conflict, conflicts
from comity_fis.audit.coverage import Coverage, Reached, coverage
from comity_fis.audit.evidence import EvidenceCount, count_evidence
from comity_fis.audit.findings import (
    FindingCheck,
    HeldToFindings,
    StudyFinding,
    StudyGroup,
    held_to,
    shipped_findings,
)
from comity_fis.audit.sweep import Sweep, decided_by, sweep
from comity_fis.audit.treatment import Effect, Pairs, UnequalPair, effect, pairs

__all__ = [
    "Attribute",
    "Audit",
    "Conflict",
    "Coverage",
    "Effect",
    "EvidenceCount",
    "FindingCheck",
    "HeldToFindings",
    "Pairs",
    "Reached",
    "StudyFinding",
    "StudyGroup",
    "Sweep",
    "UnequalPair",
    "attributes",
    "audit",
    "conflicts",
    "count_evidence",
    "coverage",
    "decided_by",
    "effect",
    "held_to",
    "pairs",
    "shipped_findings",
    "sweep",
]
