"""The answer of `comity explain --json`."""

from __future__ import annotations

from math import isinf
from typing import TYPE_CHECKING, Any

from comity.answers.explanation import (
    AlternativeInputAnswer,
    CategoryAnswer,
    DerivativeAnswer,
    ExplainAnswer,
    FlipAnswer,
    ReadAnswer,
    RuleStrengthAnswer,
    SourcedRuleAnswer,
)
from comity.answers.inference import GradedRuleAnswer, GradedShiftAnswer, OffRuleAnswer
from comity.report.values.inference import inputs_answer, value_fields
from comity_fis.explanation.removal import Without

if TYPE_CHECKING:
    from comity_fis import Explanation, FiredRule, ParameterValue, Rule, RuleAccount, Sensitivity
    from comity_fis.explanation.explanation import CategoryAccount


def explain_answer(explanation: Explanation) -> ExplainAnswer:
    """The answer of `comity explain --json`."""
    value, inputs, unasked = explanation.value, inputs_answer(explanation.inputs), explanation.unasked
    return ExplainAnswer(
        **value_fields(value),
        shift=graded_shift(value.shift) if value.shift else None,
        rulebook=explanation.rulebook,
        parameter=value.name,
        inputs=inputs,
        leading=explanation.leading,
        rules=tuple(map(_rule, explanation.rules)),
        off=tuple(OffRuleAnswer(number=one.number, rule=one.text, **_grade(one)) for one in explanation.off),
        categories=tuple(map(_category, explanation.categories)),
        reads=tuple(
            ReadAnswer(parameter=read.name, value=read.value, unit=read.unit, origin=read.origin)
            for read in explanation.reads
        ),
        derivatives=tuple(map(_derivative, explanation.sensitivities)),
        alternatives=tuple(
            AlternativeInputAnswer(
                input=one.input,
                now=inputs[one.input],
                given=one.given,
                value=one.value.value,
                origin=one.value.origin,
                leading=one.leads,
                flips=one.flips,
            )
            for one in explanation.alternatives
        ),
        flips=tuple(
            FlipAnswer(
                input=one.input,
                now=one.now,
                to=one.to,
                change=one.change,
                leading=one.leads,
                value=one.value.value,
            )
            for one in explanation.flips
        ),
        without_setting=Without(unasked.value, unasked.origin, unasked.note) if unasked else None,
    )


def _category(category: CategoryAccount) -> CategoryAnswer:
    return CategoryAnswer(
        category=category.name,
        desirability=category.desirability,
        permitted=category.permitted,
        requires=str(category.requires) if category.requires else None,
        rules=tuple(
            RuleStrengthAnswer(number=one.rule.number, strength=one.strength) for one in category.fired
        ),
    )


def graded_shift(shift: ParameterValue) -> GradedShiftAnswer:
    """By how much the situation moved a value, with its rules."""
    return GradedShiftAnswer(value=shift.number, rules=tuple(map(graded_rule, shift.fired)))


def graded_rule(fired: FiredRule) -> GradedRuleAnswer:
    """A rule that fired, with its source and grade."""
    return GradedRuleAnswer(**_graded(fired))


def _graded(fired: FiredRule | RuleAccount) -> dict[str, Any]:
    rule = fired.rule
    return {"number": rule.number, "rule": rule.text, "strength": fired.strength, **_grade(rule)}


def _grade(rule: Rule) -> dict[str, Any]:
    return {
        "source": rule.source,
        "evidence": rule.evidence,
        "counter_evidence": rule.counter_evidence or None,
    }


def _rule(account: RuleAccount) -> SourcedRuleAnswer:
    return SourcedRuleAnswer(
        **_graded(account),
        terms=account.terms,
        share=account.share,
        contribution=account.contribution,
        without=account.without,
    )


def _derivative(one: Sensitivity) -> DerivativeAnswer:
    jumps_below, jumps_above = (side is not None and isinf(side) for side in (one.below, one.above))
    return DerivativeAnswer(
        input=one.input,
        at=one.at,
        unit=one.unit,
        derivative=one.derivative,
        below=None if jumps_below else one.below,
        above=None if jumps_above else one.above,
        kink=one.kink,
        jumps=(*(("below",) if jumps_below else ()), *(("above",) if jumps_above else ())),
        flat=one.flat,
        flat_over=one.flat_over.ends if one.flat_over else None,
    )
