"""One value, from what was disclosed over the rules that fired to the number."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.answers import ExplainAnswer, SourcedRuleAnswer
from comity.report.text import number, stated, table, words

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rich.console import RenderableType

    from comity_fis import FiredRule, Inference


def explain_answer(inference: Inference, parameter: str) -> ExplainAnswer:
    """The answer of `comity explain --json`."""
    value = inference[parameter]
    return ExplainAnswer.model_validate(
        {
            **value.as_json(),
            "rulebook": inference.rulebook,
            "parameter": parameter,
            "inputs": inference.as_json()["inputs"],
            "rules": tuple(_rule(fired) for fired in value.fired),
        }
    )


def explain_text(answer: ExplainAnswer) -> Iterator[RenderableType]:
    """The same, for a person to read."""
    spread = f" (people vary by ± {number(answer.spread, answer.unit)})" if answer.spread is not None else ""
    yield f"{words(answer.parameter)}: {number(answer.value, answer.unit)}{spread}"
    if answer.note:
        yield f"  {answer.note}"
    yield "\nHow it came about"
    yield table([(part.origin, number(part.value, answer.unit), part.text) for part in answer.contributions])
    yield "\nWhat was known"
    yield table(
        [
            (words(name), "not disclosed" if fact is None else stated(fact))
            for name, fact in answer.inputs.items()
        ]
    )
    if answer.desirability:
        yield "\nHow suitable each choice is"
        yield table([(words(name), f"{degree:.3f}") for name, degree in answer.desirability.items()])
    yield "\nRules that fired" if answer.rules else "\nNo rule fired."
    for rule in answer.rules:
        yield f"  {rule.number}. {rule.rule}"
        limits = [("against it", rule.counter_evidence)] if rule.counter_evidence else []
        yield table(
            [("  strength", f"{rule.strength:.3f}"), ("  evidence", rule.evidence), ("  source", rule.source)]
            + [(f"  {name}", text) for name, text in limits]
        )


def _rule(fired: FiredRule) -> SourcedRuleAnswer:
    rule = fired.rule
    return SourcedRuleAnswer(
        number=rule.number,
        rule=rule.text,
        strength=fired.strength,
        source=rule.source,
        evidence=rule.evidence,
        counter_evidence=rule.counter_evidence or None,
    )
