"""The value without each rule, one at a time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from comity_fis.explanation.what_if import WhatIf
from comity_fis.inference.value import Origin
from comity_fis.record import Record


@dataclass(frozen=True, slots=True)
class Without(Record):
    """The value if the rulebook lacked a rule."""

    value: float | str
    origin: Origin
    note: str


def without_each(question: WhatIf) -> Mapping[int, Without]:
    """The parameter's value without each of its fired rules, by rule number."""
    found = {}
    for number in (firing.rule.number for firing in question.now.fired):
        rest = tuple(rule for rule in question.rulebook.rules if rule.number != number)
        there = question.asked_of(replace(question.rulebook, rules=rest))
        found[number] = Without(there.value, there.origin, there.note)
    return found
