"""A rule that takes another one's place."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from comity_fis.errors import InputError, shown
from comity_fis.rulebook.situation import refuse_person_in_shift
from comity_fis.rules.grammar import parse_rule
from comity_fis.rules.rule import Rule

if TYPE_CHECKING:
    from comity_fis.rulebook.rulebook import Rulebook


def replaced_rule(rulebook: Rulebook, number: int, rule: Rule | str) -> Rule:
    """The new rule with a number of the rulebook.

    Raises:
        InputError: if there is no rule of that number, or the text cannot be read.
    """
    if not isinstance(number, int) or isinstance(number, bool) or not 1 <= number <= len(rulebook.rules):
        raise InputError(
            expected=f"the number of a rule, 1..{len(rulebook.rules)}",
            got=shown(number),
            remedy="Rules are counted from 1, in the rulebook's order.",
        )
    if isinstance(rule, Rule):
        return replace(rule, number=number)
    if not isinstance(rule, str):
        raise InputError(
            expected="a rule or its text",
            got=shown(rule),
            remedy="Write it out: if ... then ...",
        )
    known = {**rulebook.variables, **rulebook.parameters}
    antecedent, consequents = parse_rule(
        rule,
        inputs={name: read.terms for name, read in known.items()},
        outputs={name: parameter.conclusions for name, parameter in rulebook.parameters.items()},
    )
    refuse_person_in_shift(antecedent, consequents, rulebook.variables, rulebook.parameters)
    return Rule(
        number=number,
        text=rule,
        antecedent=antecedent,
        consequents=consequents,
        sources=(),
        evidence="design",
        note=f"Stands in for: {rulebook.rules[number - 1].text}",
    )
