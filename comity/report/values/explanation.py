"""One value, from what was disclosed over the rules that fired to the number, and what would change it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.report.text import number, stated, step, table, terms_in_words, words, words_of
from comity.report.values.explanation_words import (
    alternative_row,
    derivative_row,
    flip_rows,
    ordered_rules,
    rule_row,
    speaking,
    units_of,
)
from comity.report.values.inference import concluded, outvoted_text, possible
from comity_fis import kept_back, rests_on_facts

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from rich.console import RenderableType

    from comity_fis import (
        CategoryAccount,
        Explanation,
        Known,
        Rule,
    )


def explain_text(explanation: Explanation) -> Iterator[RenderableType]:
    """The lines of `comity explain`."""
    value = explanation.value
    spread = f" (people vary by ± {number(value.spread, value.unit)})" if value.spread is not None else ""
    yield f"{words(value.name)}: {number(value.value, value.unit)}{spread}"
    if first := outvoted_text(value, explanation.inputs):
        yield f"  {first}"
    if value.note:
        yield f"  {words(value.note)}"
    yield f"\nHow it came about, by the rulebook {explanation.rulebook}"
    yield table(
        [
            (part.origin, step(part.value, value.unit, first=part is value.start), words(part.text))
            for part in value.contributions
        ]
    )
    if explanation.unasked is not None:
        unasked = explanation.unasked
        yield (
            f"  No rule was asked. Without this wish it would be {number(unasked.value, unasked.unit)},"
            f" {unasked.contributions[0].text}."
        )
    yield from _known(explanation)
    yield from _categories(explanation)
    yield from _rules(explanation)
    yield from _moved(explanation)
    yield from _off(explanation)
    yield from _sources(explanation)
    yield from _changes(explanation)


def _known(explanation: Explanation) -> Iterator[RenderableType]:
    if explanation.variables:
        yield "\nWhat was known, of all that can change it"
        facts = [(variable, explanation.inputs[variable.name]) for variable in explanation.variables]
        yield table(
            [
                (words(variable.name), "not disclosed" if fact is None else stated(fact, variable.unit))
                for variable, fact in facts
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
                speaking(category.fired, explanation) or "no rule",
                _remark(category),
            )
            for category in explanation.categories
        ]
    )


def _remark(category: CategoryAccount) -> str:
    if not category.permitted:
        return f"requires {words(str(category.requires))}"
    strongest = max((firing.strength for firing in category.fired), default=category.desirability)
    return "" if category.desirability <= strongest else "neutral: stands where others tie"


def _rules(explanation: Explanation) -> Iterator[RenderableType]:
    if not explanation.rules:
        if explanation.value.start.origin == "neutral":
            yield "\nNo rule decided: the neutral value stands."
        return
    numeric = explanation.rules[0].share is not None
    middle = ("share", "contributes") if numeric else ()
    yield "\nRules that fired"
    inputs = explanation.inputs
    ordered = ordered_rules(explanation)
    yield table(
        [rule_row(account, explanation.value) for account in ordered],
        head=("rule", "gives", "strength", *middle, "without it"),
    )
    if merely := possible(ordered, inputs):
        yield f"  {merely}. Nothing that was disclosed speaks for or against them.\n"
    yield "What they rest on"
    for account in ordered:
        yield from _ground(account.rule, inputs)


def _ground(rule: Rule, inputs: Mapping[str, Known | None]) -> Iterator[RenderableType]:
    """One rule with what speaks for it and against it."""
    from rich.padding import Padding

    yield Padding(f"{rule.number}. {words(rule.text)}", (0, 0, 0, 2))
    rows = _unknown(rule, inputs)
    rows += [("evidence", rule.evidence), ("source", ", ".join(source.key for source in rule.sources))]
    rows += [("against it", rule.counter_evidence)] if rule.counter_evidence else []
    rows += [("note", rule.note)] if rule.note else []
    yield table([(f"   {name}", text) for name, text in rows])


def _moved(explanation: Explanation) -> Iterator[RenderableType]:
    """The situation's own rules."""
    shift = explanation.value.shift
    if shift is None:
        return
    yield f"\nWhat the situation adds: {step(shift.number, explanation.value.unit, first=False)}"
    yield table(
        [
            (str(fired.rule.number), terms_in_words(concluded(fired, shift.name)), f"{fired.strength:.3f}")
            for fired in shift.fired
        ],
        head=("rule", "gives", "strength"),
    )
    yield "What these rest on"
    for fired in shift.fired:
        yield from _ground(fired.rule, explanation.inputs)


def _off(explanation: Explanation) -> Iterator[RenderableType]:
    """What the rulebook keeps and does not follow."""
    if explanation.off:
        yield "\nRules that are off"
        yield table(
            [(f"{rule.number}.", words(rule.text), rule.evidence) for rule in explanation.off],
        )


def _sources(explanation: Explanation) -> Iterator[RenderableType]:
    shift = explanation.value.shift
    rules = [account.rule for account in explanation.rules]
    rules += [fired.rule for fired in shift.fired] if shift else []
    rules += explanation.off
    if cited := {source.key: source.citation for rule in rules for source in rule.sources}:
        yield "\nSources"
        yield table(list(cited.items()))


def _unknown(rule: Rule, inputs: Mapping[str, Known | None]) -> list[tuple[str, str]]:
    """What of a rule holds only because nobody knows."""
    hidden = kept_back(rule, inputs)
    if not hidden:
        return []
    if rests_on_facts(rule, inputs):
        return [("not known", f"{words_of(hidden)}; every term holds of what was not disclosed")]
    were = "was" if len(hidden) == 1 else "were"
    return [("possible", f"holds only because {words_of(hidden)} {were} not disclosed")]


def _changes(explanation: Explanation) -> Iterator[RenderableType]:
    value = explanation.value
    if explanation.sensitivities:
        yield "\nIf a number changed a little"
        yield table([derivative_row(one, value) for one in explanation.sensitivities])
    if explanation.alternatives:
        yield "\nIf something else were stated"
        numeric = not isinstance(value.value, str)
        units = units_of(explanation)
        yield table(
            [alternative_row(other, value, units.get(other.input)) for other in explanation.alternatives],
            head=("fact", "stated instead", "would give", "difference", *(("leads",) if numeric else ())),
        )
    if flips := flip_rows(explanation):
        yield (
            "What would make something else lead"
            if explanation.alternatives
            else ("\nWhat would make something else lead")
        )
        yield table(flips)
