"""The lines of an explanation: numbers and changes as people say them; text and picture share them."""

from __future__ import annotations

from math import ceil, floor, inf, isinf, log10
from typing import TYPE_CHECKING

from comity.report.text import number, step, terms_in_words, words
from comity.report.values.inference import speaks
from comity_fis import rests_on_facts

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from comity_fis import (
        Counterfactual,
        Explanation,
        FiredRule,
        Flip,
        ParameterValue,
        RuleAccount,
        Sensitivity,
    )

NAMED = 3
"""Categories that are named one by one; of more, the first and how many."""


def fine(value: float, unit: str | None, digits: int = 1) -> str:
    """A part of a value: metres as centimetres, everything else one digit finer than the value."""
    if unit == "m":
        return f"{_rounded(100 * value, digits)} cm"
    text = _rounded(value, digits if unit == "deg" else digits + 2)
    return f"{text} {unit}" if unit and unit != "1" else text


def _rounded(value: float, digits: int) -> str:
    return f"{round(value, digits) + 0.0:.{digits}f}"


def steps(value: ParameterValue) -> str:
    """What a value is made of: `culture 0.847 m, situation -0.192 m`."""
    return ", ".join(
        f"{part.origin} {step(part.value, value.unit, first=part is value.start)}"
        for part in value.contributions
    )


def difference(to: float | str, value: ParameterValue) -> str:
    """From the value that stands to another one."""
    if isinstance(to, str) or isinstance(value.value, str):
        return "the same" if to == value.value else "another"
    change = to - value.value
    text = fine(change, value.unit)
    if text == fine(0.0, value.unit):
        return "the same" if change == 0 else "hardly any"
    return text if change < 0 else f"+{text}"


def units_of(explanation: Explanation) -> Mapping[str, str | None]:
    """The units of what can change the value, by variable."""
    return {variable.name: variable.unit for variable in explanation.variables}


def speaking(fired: Iterable[FiredRule], explanation: Explanation, digits: int = 3) -> str:
    """`rule 16 (1.000)`, or `rule 16 (1.000, formality not disclosed)`, one after the other."""
    said = (speaks(one, explanation.inputs, digits).split(", ", 1) for one in fired)
    return ", ".join(f"{rule} ({strength})" for rule, strength in said)


def stated(given: float | Sequence[str], unit: str | None = None) -> str:
    """A number with its unit, or categories that give the same."""
    if isinstance(given, float | int):
        return f"{given:g} {unit}" if unit else f"{given:g}"
    if len(given) <= NAMED:
        return ", ".join(map(words, given))
    return f"any of {len(given)} others ({given[0]}, ...)"


def ordered_rules(explanation: Explanation) -> list[RuleAccount]:
    """The rules that fired: first those that rest on something disclosed, each kind strongest first."""
    inputs = explanation.inputs
    return sorted(explanation.rules, key=lambda account: not rests_on_facts(account.rule, inputs))


def rule_row(account: RuleAccount, value: ParameterValue) -> tuple[str, ...]:
    """Number, term, strength, share, contribution, and what would be without it."""
    middle = (
        (f"{100 * account.share:.1f} %", fine(account.contribution, value.unit))
        if account.share is not None and account.contribution is not None
        else ()
    )
    there = account.without
    neutral = f", the neutral value: {there.note}" if there.origin == "neutral" else ""
    without = number(there.value, value.unit)
    if change := difference(there.value, value):
        without = change if change == "the same" else f"{without} ({change})"
    return (
        str(account.rule.number),
        terms_in_words(account.terms),
        f"{account.strength:.3f}",
        *middle,
        without + neutral,
    )


def derivative_row(one: Sensitivity, value: ParameterValue) -> tuple[str, str]:
    """The input, and what a small change of it does."""
    per = f"per {one.unit.removesuffix('s')}" if one.unit else "per unit"
    name = f"{words(one.input)} {stated(one.at, one.unit)}"
    if one.flat:
        over = f", from {one.flat_over.low:.4g} to {one.flat_over.high:.4g}" if one.flat_over else ""
        return name, f"flat here{over}"
    if one.derivative is not None:
        side = " (the domain ends here)" if one.below is None or one.above is None else ""
        return name, f"{_slope(one.derivative, value.unit)} {per}{side}"
    return name, f"a corner: {_side(one.below, value, per)} below, {_side(one.above, value, per)} above"


def _side(slope: float | None, value: ParameterValue, per: str) -> str:
    if slope is None:
        return "nothing"
    return "a jump" if isinf(slope) else "flat" if slope == 0 else f"{_slope(slope, value.unit)} {per}"


def _slope(slope: float, unit: str | None) -> str:
    return ("+" if slope > 0 else "") + fine(slope, unit, 3)


def alternative_row(other: Counterfactual, value: ParameterValue, unit: str | None) -> tuple[str, ...]:
    """The input, what it would be, what that gives, how far off that is, and for a number what leads."""
    given = number(other.value.value, value.unit)
    row = (words(other.input), stated(other.given, unit), given, difference(other.value.value, value))
    if isinstance(value.value, str):
        return row
    neutral = "none, the neutral value stands" if other.value.origin == "neutral" else "none"
    return (*row, terms_in_words(other.leads) or neutral)


def flip_rows(explanation: Explanation) -> list[tuple[str, str]]:
    """`individualism 67 → 46.5`, and what that makes of it; numbers first, the smallest change first."""
    units = units_of(explanation)
    rows = [
        (
            f"{words(flip.input)} {flip.now:g} → {_with(units.get(flip.input), beyond(flip))}",
            flip_text(flip, explanation),
        )
        for flip in explanation.flips
    ]
    for other in explanation.alternatives:
        now = explanation.inputs[other.input]
        if other.flips and explanation.decided_by_rules and isinstance(other.given, tuple):
            before = "not disclosed" if now is None else str(now)
            rows.append(
                (f"{words(other.input)} {before} → {stated(other.given)}", flip_text(other, explanation))
            )
    return rows


def _with(unit: str | None, text: str) -> str:
    return f"{text} {unit}" if unit else text


def flip_text(there: Flip | Counterfactual, explanation: Explanation) -> str:
    """`makes close lead instead of medium (0.738 m there)`."""
    given = number(there.value.value, there.value.unit)
    if not there.leads:
        return f"leaves no rule to decide; the neutral value {given} stands"
    if isinstance(there.value.value, str):
        return f"gives {given} instead of {number(explanation.value.value)}"
    before = f" instead of {terms_in_words(explanation.leading)}" if explanation.leading else ""
    return f"makes {terms_in_words(there.leads)} lead{before} ({given} there)"


def beyond(flip: Flip) -> str:
    """The place rounded to a thousandth of the way or finer, away from where the input is now."""
    width = abs(flip.to - flip.now) / flip.change if flip.change else inf
    digits = max(0, 3 - round(log10(width))) if 0 < width < inf else 3
    scale = 10**digits
    rounded = (floor if flip.to < flip.now else ceil)(flip.to * scale) / scale
    return f"{rounded:g}"
