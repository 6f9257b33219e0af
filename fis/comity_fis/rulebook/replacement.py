"""Replaces a rule by another one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from comity_fis.errors import InputError, shown
from comity_fis.rulebook.situation import refuse_person_in_shift
from comity_fis.rules.grammar import parse_rule
from comity_fis.rules.rule import Rule
from comity_fis.variables.parameter import Parameter
from comity_fis.variables.variable import Variable


def replaced_rule(
    rules: Sequence[Rule],
    variables: Mapping[str, Variable],
    parameters: Mapping[str, Parameter],
    number: int,
    rule: Rule | str,
) -> Rule:
    """The new rule, with the number of the one that it replaces.

    Args:
        rules: Rules of the rulebook.
        variables: Variables of the rulebook.
        parameters: Parameters of the rulebook.
        number: Number of the rule to replace, from 1.
        rule: The new rule, or its text.

    Raises:
        InputError: There is no rule of that number, or the text is invalid.
    """
    if not isinstance(number, int) or isinstance(number, bool) or not 1 <= number <= len(rules):
        raise InputError(
            expected=f"the number of a rule, 1..{len(rules)}",
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
    known = {**variables, **parameters}
    antecedent, consequents = parse_rule(
        rule,
        inputs={name: read.terms for name, read in known.items()},
        outputs={name: parameter.conclusions for name, parameter in parameters.items()},
    )
    refuse_person_in_shift(antecedent, consequents, variables, parameters)
    return Rule(
        number=number,
        text=rule,
        antecedent=antecedent,
        consequents=consequents,
        sources=(),
        evidence="design",
        note=f"Stands in for: {rules[number - 1].text}",
    )
