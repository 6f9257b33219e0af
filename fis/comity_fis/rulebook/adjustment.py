"""Adjusts inferred values by the situation and by learning, and limits them to allowed and safe ranges.

`value = safety(setting, or culture + situation + learnt)`. A person's explicit request is changed only by
safety (`composition.asked_number`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from comity_fis.defuzzification.curve import Choice, Curve
from comity_fis.defuzzification.moved_curve import MovedCurve
from comity_fis.inference.value import Contribution, Origin, ParameterValue
from comity_fis.learning.learnt import Learnt
from comity_fis.membership.interval import Interval
from comity_fis.variables.parameter import NumericParameter, Parameter


def adjusted(
    value: ParameterValue, parameter: Parameter, shift: ParameterValue | None, learnt: Learnt | None
) -> ParameterValue:
    """A value shifted by the situation and by learning, within the requestable and the safe range.

    The shifts are summed before limits apply, so their order does not matter. The desirability curve shifts
    along with the value. Settings and categories are not shifted.

    Args:
        value: The inferred value, the neutral value, or a setting.
        parameter: Its parameter.
        shift: Shift by the situation; None for none.
        learnt: Correction learnt from encounters with the person; None for none.
    """
    if not isinstance(parameter, NumericParameter) or value.asked_for:
        return value
    steps = _steps(shift, learnt)
    if not steps:
        return value
    wanted = value.number + sum(_number(step) for step in steps)
    limits = _limits(parameter, wanted, _last_origin(steps, value.origin))
    result = parameter.safe.clamp(parameter.ask.clamp(wanted))
    return replace(
        value,
        value=result,
        spread=value.spread if learnt is None else learnt.spread,
        origin=_last_origin((*steps, *limits), value.origin),
        contributions=(*value.contributions, *steps, *limits),
        desirability=_moved(value, parameter, result),
        note="; ".join(filter(None, (value.note, *(limit.text for limit in limits)))),
        shift=shift,
    )


def _steps(shift: ParameterValue | None, learnt: Learnt | None) -> list[Contribution]:
    steps = []
    if shift is not None:
        steps.append(Contribution("situation", shift.value, shift.start.text))
    if learnt is not None:
        steps.append(learnt.contribution)
    return steps


def _limits(parameter: NumericParameter, wanted: float, mover: Origin) -> list[Contribution]:
    """The reductions by the two ranges; the first is attributed to what shifted the value that far."""
    asked = parameter.ask.clamp(wanted)
    safe = parameter.safe.clamp(asked)
    limits = []
    if asked != wanted:
        text = f"kept within what may be asked for, {_end(parameter.ask, wanted)} {parameter.unit}"
        limits.append(Contribution(mover, asked - wanted, text))
    if safe != asked:
        text = f"safety allows {_end(parameter.safe, asked)} {parameter.unit}"
        limits.append(Contribution("safety", safe - asked, text))
    return limits


def _end(interval: Interval, beyond: float) -> str:
    return f"at least {interval.low:g}" if beyond < interval.low else f"at most {interval.high:g}"


def _last_origin(steps: Sequence[Contribution], otherwise: Origin) -> Origin:
    """Origin of the last step that changed something."""
    for step in reversed(steps):
        if step.value != 0:
            return step.origin
    return otherwise


def _moved(value: ParameterValue, parameter: NumericParameter, result: float) -> Curve:
    curve = value.desirability
    assert not isinstance(curve, Choice), "only numbers are moved"
    if result == value.number:
        return curve
    limits = Interval(
        parameter.safe.clamp(parameter.ask.low),
        parameter.safe.clamp(parameter.ask.high),
    )
    return MovedCurve(curve, result - value.number, limits)


def _number(step: Contribution) -> float:
    assert not isinstance(step.value, str), "only numbers are moved"
    return step.value
