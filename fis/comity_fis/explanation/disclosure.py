"""Distinguishes fired rules supported by known inputs from those that read only unknown ones.

An unknown input is 1 everywhere, so a rule that reads nothing else fires with possibility 1, supported by
nothing. Explanations need to tell the two apart.
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
    """The variables read by a rule that are unknown, in the order of its text.

    Args:
        rule: Any rule.
        inputs: Known values, None for unknown ones; a missing name, such as a parameter's, is not an input of
            the person.
    """
    return tuple(name for name in rule.reads if inputs.get(name, "") is None)


def rests_on_facts(rule: Rule, inputs: Mapping[str, Known | None]) -> bool:
    """Whether a rule reads any known input."""
    return len(kept_back(rule, inputs)) < len(rule.reads)


def facts_first(fired: Iterable[FiredRule], inputs: Mapping[str, Known | None]) -> tuple[FiredRule, ...]:
    """Rules that read known inputs before those that do not, each in their given order."""
    return tuple(sorted(fired, key=lambda firing: not rests_on_facts(firing.rule, inputs)))


@dataclass(frozen=True, slots=True)
class Outvoting:
    """Rules on unknown inputs that decide a value against the rules that read only known inputs."""

    rules: tuple[FiredRule, ...]
    """The deciding rules, strongest first; each reads an unknown input."""
    hidden: tuple[str, ...]
    """The unknown variables that they read, in the order of the rulebook."""
    outvoted: FiredRule
    """The strongest rule that reads only known inputs."""


def outvoting(value: ParameterValue, inputs: Mapping[str, Known | None]) -> Outvoting | None:
    """The rules on unknown inputs without which known inputs would give another dominant term.

    None if known inputs dominate anyway, or no rule reads only known inputs.

    Args:
        value: A value that rules gave.
        inputs: Inputs by variable, as for `kept_back`.
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
    # A category that only ties with known inputs also decides: the neutral category then wins.
    least = best - TIE if isinstance(value.value, str) else max(best + TIE, top - TIE)
    decide = [(one, term) for one, term in fired if kept_back(one.rule, inputs) and one.strength > least]
    if len(leading) > 1 and value.value == value.neutral:
        return None  # known inputs tie among themselves
    if not decide or value.value in leading or not leading.isdisjoint(term for _, term in decide):
        return None
    read = {name for one, _ in decide for name in kept_back(one.rule, inputs)}
    return Outvoting(
        tuple(dict.fromkeys(one for one, _ in decide)), tuple(n for n in inputs if n in read), told[0][0]
    )


def _concluded(one: FiredRule, parameter: str, open_to: Collection[str] | None) -> list[str]:
    """The terms that a rule concludes for a parameter, except excluded ones."""
    return [
        is_.term
        for is_ in one.rule.consequents
        if is_.name == parameter and (open_to is None or is_.term in open_to)
    ]
