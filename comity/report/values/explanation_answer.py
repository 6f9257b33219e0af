"""The answer of `comity explain --json`."""

from __future__ import annotations

from math import isinf
from typing import TYPE_CHECKING

from comity.answers import ExplainAnswer
from comity_fis.inference.value import plain

if TYPE_CHECKING:
    from comity_fis import Explanation, FiredRule, ParameterValue, Rule, RuleAccount, Sensitivity
    from comity_fis.explanation.explanation import CategoryAccount
    from comity_fis.explanation.removal import Without
    from comity_fis.explanation.what_if import Counterfactual, Flip


def explain_answer(explanation: Explanation) -> ExplainAnswer:
    """The answer of `comity explain --json`."""
    value = explanation.value
    return ExplainAnswer.model_validate(
        {
            **value.as_json(),
            "shift": graded_shift(value.shift) if value.shift else None,
            "rulebook": explanation.rulebook,
            "parameter": value.name,
            "inputs": {name: plain(known) for name, known in explanation.inputs.items()},
            "leading": explanation.leading,
            "rules": [_rule(account) for account in explanation.rules],
            "off": [{"number": rule.number, "rule": rule.text, **_grade(rule)} for rule in explanation.off],
            "categories": [_category(category) for category in explanation.categories],
            "reads": [
                {"parameter": read.name, "value": read.value, "unit": read.unit, "origin": read.origin}
                for read in explanation.reads
            ],
            "derivatives": [_derivative(one) for one in explanation.sensitivities],
            "alternatives": [
                {"now": plain(explanation.inputs[other.input]), **_alternative(other)}
                for other in explanation.alternatives
            ],
            "flips": [_flip(flip) for flip in explanation.flips],
            "without_setting": _otherwise(explanation.unasked) if explanation.unasked else None,
        }
    )


def _category(category: CategoryAccount) -> dict[str, object]:
    return {
        "category": category.name,
        "desirability": category.desirability,
        "permitted": category.permitted,
        "requires": str(category.requires) if category.requires else None,
        "rules": [{"number": fired.rule.number, "strength": fired.strength} for fired in category.fired],
    }


def _alternative(other: Counterfactual) -> dict[str, object]:
    return {
        "input": other.input,
        "given": other.given,
        "value": other.value.value,
        "origin": other.value.origin,
        "leading": other.leads,
        "flips": other.flips,
    }


def _flip(flip: Flip) -> dict[str, object]:
    return {
        "input": flip.input,
        "now": flip.now,
        "to": flip.to,
        "change": flip.change,
        "leading": flip.leads,
        "value": flip.value.value,
    }


def graded_shift(shift: ParameterValue) -> dict[str, object]:
    """By how much the situation moved a value, with its rules."""
    return {"value": shift.value, "rules": [graded_rule(fired) for fired in shift.fired]}


def graded_rule(fired: FiredRule | RuleAccount) -> dict[str, object]:
    """A rule that fired, with its source and grade."""
    rule = fired.rule
    return {
        "number": rule.number,
        "rule": rule.text,
        "strength": fired.strength,
        **_grade(rule),
    }


def _grade(rule: Rule) -> dict[str, object]:
    return {
        "source": rule.source,
        "evidence": rule.evidence,
        "counter_evidence": rule.counter_evidence or None,
    }


def _rule(account: RuleAccount) -> dict[str, object]:
    return {
        **graded_rule(account),
        "terms": account.terms,
        "share": account.share,
        "contribution": account.contribution,
        "without": _otherwise(account.without),
    }


def _otherwise(there: Without | ParameterValue) -> dict[str, object]:
    return {"value": there.value, "origin": there.origin, "note": there.note}


def _derivative(one: Sensitivity) -> dict[str, object]:
    sides = {"below": one.below, "above": one.above}
    jumps = [name for name, side in sides.items() if side is not None and isinf(side)]
    return {
        "input": one.input,
        "at": one.at,
        "unit": one.unit,
        "derivative": one.derivative,
        **{name: None if name in jumps else side for name, side in sides.items()},
        "kink": one.kink,
        "jumps": jumps,
        "flat": one.flat,
        "flat_over": one.flat_over.ends if one.flat_over else None,
    }
