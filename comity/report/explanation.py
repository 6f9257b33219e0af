"""One value, from what was disclosed over the rules that fired to the number, and what would change it."""

from __future__ import annotations

from math import isinf
from typing import TYPE_CHECKING

from comity.answers import ExplainAnswer
from comity.report.explanation_words import (
    alternative_row,
    derivative_row,
    flip_rows,
    rule_row,
)
from comity.report.text import number, stated, table, words
from comity_fis.value import plain

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rich.console import RenderableType

    from comity_fis import CategoryAccount, Explanation, ParameterValue, RuleAccount, Sensitivity
    from comity_fis.removal import Without


def explain_answer(explanation: Explanation) -> ExplainAnswer:
    """The answer of `comity explain --json`."""
    value = explanation.value
    return ExplainAnswer.model_validate(
        {
            **value.as_json(),
            "rulebook": explanation.rulebook,
            "parameter": value.name,
            "inputs": {name: plain(known) for name, known in explanation.inputs.items()},
            "leading": explanation.leading,
            "rules": [_rule(account) for account in explanation.rules],
            "categories": [
                {
                    "category": category.name,
                    "desirability": category.desirability,
                    "permitted": category.permitted,
                    "requires": str(category.requires) if category.requires else None,
                    "rules": [{"number": f.rule.number, "strength": f.strength} for f in category.fired],
                }
                for category in explanation.categories
            ],
            "reads": [
                {"parameter": read.name, "value": read.value, "unit": read.unit, "origin": read.origin}
                for read in explanation.reads
            ],
            "derivatives": [_derivative(one) for one in explanation.sensitivities],
            "alternatives": [
                {
                    "input": other.input,
                    "now": plain(explanation.inputs[other.input]),
                    "given": other.given,
                    "value": other.value.value,
                    "origin": other.value.origin,
                    "leading": other.leads,
                    "flips": other.flips,
                }
                for other in explanation.alternatives
            ],
            "flips": [
                {
                    "input": flip.input,
                    "now": flip.now,
                    "to": flip.to,
                    "change": flip.change,
                    "leading": flip.leads,
                    "value": flip.value.value,
                }
                for flip in explanation.flips
            ],
            "without_setting": _otherwise(explanation.unasked) if explanation.unasked else None,
        }
    )


def _rule(account: RuleAccount) -> dict[str, object]:
    rule = account.rule
    return {
        "number": rule.number,
        "rule": rule.text,
        "strength": account.strength,
        "terms": account.terms,
        "share": account.share,
        "contribution": account.contribution,
        "without": _otherwise(account.without),
        "source": rule.source,
        "evidence": rule.evidence,
        "counter_evidence": rule.counter_evidence or None,
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


def explain_text(explanation: Explanation) -> Iterator[RenderableType]:
    """The same, for a person to read."""
    value = explanation.value
    spread = f" (people vary by ± {number(value.spread, value.unit)})" if value.spread is not None else ""
    yield f"{words(value.name)}: {number(value.value, value.unit)}{spread}"
    if value.note:
        yield f"  {value.note}"
    yield "\nHow it came about"
    yield table([(part.origin, number(part.value, value.unit), part.text) for part in value.contributions])
    if explanation.unasked is not None:
        unasked = explanation.unasked
        yield (
            f"  No rule was asked. Without this wish it would be {number(unasked.value, unasked.unit)},"
            f" {unasked.contributions[0].text}."
        )
    yield from _known(explanation)
    yield from _categories(explanation)
    yield from _rules(explanation)
    yield from _changes(explanation)


def _known(explanation: Explanation) -> Iterator[RenderableType]:
    if explanation.variables:
        yield "\nWhat was known, of all that can change it"
        facts = [(variable.name, explanation.inputs[variable.name]) for variable in explanation.variables]
        yield table(
            [
                (
                    words(name),
                    "not disclosed" if fact is None else stated(fact),
                )
                for name, fact in facts
            ]
        )
    elif explanation.unasked is None:
        yield "\nNo fact about the person can change it."
    if explanation.reads:
        yield "\nWhat its rules read of other parameters (`comity explain` explains each of them)"
        yield table(
            [(words(read.name), number(read.value, read.unit), read.origin) for read in explanation.reads]
        )


def _categories(explanation: Explanation) -> Iterator[RenderableType]:
    if not explanation.categories:
        return
    yield "\nHow suitable each choice is"
    yield table(
        [
            (
                words(category.name),
                f"{category.desirability:.3f}" if category.permitted else "out",
                ", ".join(f"rule {f.rule.number} ({f.strength:.3f})" for f in category.fired) or "no rule",
                _remark(category),
            )
            for category in explanation.categories
        ]
    )


def _remark(category: CategoryAccount) -> str:
    if not category.permitted:
        return f"requires {category.requires}"
    strongest = max((firing.strength for firing in category.fired), default=category.desirability)
    return "" if category.desirability <= strongest else "neutral: stands where others tie"


def _rules(explanation: Explanation) -> Iterator[RenderableType]:
    if not explanation.rules:
        if explanation.value.origin == "neutral":
            yield "\nNo rule decided: the neutral value stands."
        return
    from rich.padding import Padding

    numeric = explanation.rules[0].share is not None
    middle = ("of the area", "contributes") if numeric else ()
    yield "\nRules that fired"
    yield table(
        [rule_row(account, explanation.value) for account in explanation.rules],
        head=("rule", "gives", "strength", *middle, "without it"),
    )
    yield "What they rest on"
    for account in explanation.rules:
        rule = account.rule
        yield Padding(f"{rule.number}. {rule.text}", (0, 0, 0, 2))
        rows = [("evidence", rule.evidence), ("source", ", ".join(source.key for source in rule.sources))]
        rows += [("against it", rule.counter_evidence)] if rule.counter_evidence else []
        rows += [("note", rule.note)] if rule.note else []
        hidden = [words(name) for name in rule.reads if explanation.inputs.get(name, "") is None]
        rows += (
            [("not known", f"{', '.join(hidden)}; every term holds of what was kept back")] if hidden else []
        )
        yield table([(f"   {name}", text) for name, text in rows])
    cited = {source.key: source.citation for account in explanation.rules for source in account.rule.sources}
    yield "\nSources"
    yield table(list(cited.items()))


def _changes(explanation: Explanation) -> Iterator[RenderableType]:
    value = explanation.value
    if explanation.sensitivities:
        yield "\nIf a number changed a little"
        yield table([derivative_row(one, value) for one in explanation.sensitivities])
    if explanation.alternatives:
        yield "\nIf something else were stated"
        numeric = not isinstance(value.value, str)
        yield table(
            [alternative_row(other, value) for other in explanation.alternatives],
            head=("fact", "stated instead", "would give", "difference", *(("leads",) if numeric else ())),
        )
    if flips := flip_rows(explanation):
        yield (
            "What would make something else lead"
            if explanation.alternatives
            else ("\nWhat would make something else lead")
        )
        yield table(flips)
