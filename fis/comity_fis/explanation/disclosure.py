"""What a rule that fired rests on: on what is known, or only on what nobody disclosed.

An undisclosed input is 1 everywhere, so that a rule that reads nothing else holds to degree 1: possible, and
supported by nothing. An explanation of rules needs to tell the two apart.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass

from comity_fis.defuzzification.curve import Choice
from comity_fis.inference.composition import TIE
from comity_fis.inference.known import Known
from comity_fis.inference.value import FiredRule, ParameterValue
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


@dataclass(frozen=True, slots=True)
class Outvoting:
    """What was not disclosed and yet decides, against the rules that rest on disclosed facts alone."""

    rules: tuple[FiredRule, ...]
    """Those that decide, strongest first; each reads something that was not disclosed."""
    hidden: tuple[str, ...]
    """The variables that they read and that were not disclosed, in the order of the rulebook."""
    outvoted: FiredRule
    """The strongest rule that rests on disclosed facts alone."""


def outvoting(value: ParameterValue, inputs: Mapping[str, Known | None]) -> Outvoting | None:
    """The rules over undisclosed facts without which disclosed ones would make something else lead.

    None where disclosed facts lead by themselves, and where no rule rests on them alone.

    Args:
        value: That rules gave.
        inputs: By variable, as for `kept_back`.
    """
    if not value.decided_by_rules:
        return None
    open_to = value.desirability.memberships if isinstance(value.desirability, Choice) else None
    fired = [(one, term) for one in value.fired for term in _concluded(one, value.name, open_to)]
    told = [(one, term) for one, term in fired if not kept_back(one.rule, inputs)]
    if not told:
        return None
    best, top = (max(one.strength for one, _ in among) for among in (told, fired))
    leading = {term for one, term in told if best - one.strength < TIE}
    # A word that only ties with what disclosed facts say decides, too: the neutral one stands then.
    least = best - TIE if isinstance(value.value, str) else max(best + TIE, top - TIE)
    decide = [(one, term) for one, term in fired if kept_back(one.rule, inputs) and one.strength > least]
    if len(leading) > 1 and value.value == value.neutral:
        return None  # disclosed facts tie by themselves
    if not decide or value.value in leading or not leading.isdisjoint(term for _, term in decide):
        return None
    read = {name for one, _ in decide for name in kept_back(one.rule, inputs)}
    return Outvoting(
        tuple(dict.fromkeys(one for one, _ in decide)), tuple(n for n in inputs if n in read), told[0][0]
    )


def _concluded(one: FiredRule, parameter: str, open_to: Collection[str] | None) -> list[str]:
    """The terms that a rule gives a parameter, but for those that are excluded."""
    return [
        is_.term
        for is_ in one.rule.consequents
        if is_.name == parameter and (open_to is None or is_.term in open_to)
    ]
