"""What a rule that fired rests on: on what is known, or only on what nobody disclosed.

An undisclosed input is 1 everywhere, so that a rule that reads nothing else holds to degree 1: possible, and
supported by nothing. Whoever tells people about rules needs to tell the two apart.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from comity_fis.inference.possibility import Known
from comity_fis.inference.value import FiredRule
from comity_fis.rules.rule import Rule


def kept_back(rule: Rule, inputs: Mapping[str, Known | None]) -> tuple[str, ...]:
    """The variables in a rule that were not disclosed, in the order of its text.

    Args:
        rule: Any rule.
        inputs: What is known, with None for what is not; a name that is missing, such as a parameter's, is
            not a person's to disclose.
    """
    return tuple(name for name in rule.reads if inputs.get(name, "") is None)


def rests_on_facts(rule: Rule, inputs: Mapping[str, Known | None]) -> bool:
    """Whether a rule reads anything that is known."""
    return len(kept_back(rule, inputs)) < len(rule.reads)


def facts_first(fired: Iterable[FiredRule], inputs: Mapping[str, Known | None]) -> tuple[FiredRule, ...]:
    """The same rules: those that rest on facts before those that nothing speaks for, each in their order."""
    return tuple(sorted(fired, key=lambda firing: not rests_on_facts(firing.rule, inputs)))
