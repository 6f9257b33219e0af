"""The parameters of one person."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.answers import InferAnswer
from comity.report.text import number, table, words

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rich.console import RenderableType

    from comity_fis import FiredRule, Inference, Known, ParameterValue


def infer_answer(inference: Inference) -> InferAnswer:
    """The answer of `comity infer --json`."""
    return InferAnswer.model_validate(inference.as_json())


def infer_text(inference: Inference) -> Sequence[RenderableType]:
    """What was disclosed, and each parameter with what decided it."""
    known = {name: fact for name, fact in inference.inputs.items() if fact is not None}
    unknown = [words(name) for name in inference.inputs if name not in known]
    facts = ", ".join(
        f"{words(name)} {_plain(fact)}{_treated(name, inference)}" for name, fact in known.items()
    )
    return (
        f"Rulebook {inference.rulebook}, {inference.mode} centre of area",
        f"Disclosed: {facts or 'nothing'}" + (f"; not disclosed: {', '.join(unknown)}" if unknown else ""),
        table(value_rows(inference), head=("parameter", "value", "people vary by", "decided by", "because")),
    )


def value_rows(inference: Inference) -> list[tuple[str, str, str, str, str]]:
    """A row for each parameter: name, value, spread, origin, reason."""
    return [
        (
            words(value.name),
            number(value.value, value.unit),
            f"± {number(value.spread, value.unit)}" if value.spread else "",
            value.origin,
            because(value),
        )
        for value in inference.parameters.values()
    ]


def because(value: ParameterValue) -> str:
    """Why a parameter has its value, in one line: the strongest rules, or the note."""
    if not value.fired or value.origin in ("setting", "neutral"):
        return value.note or value.contributions[-1].text
    strongest = [_in_short(fired, value.name) for fired in value.fired[:2]]
    return "; ".join(strongest) + (f"; {value.note}" if value.note else "")


def _in_short(fired: FiredRule, parameter: str) -> str:
    """`individualism is LC1 → close (rule 3, 0.84)`."""
    terms = " and ".join(words(is_.term) for is_ in fired.rule.consequents if is_.name == parameter)
    return f"{fired.rule.antecedent} → {terms} (rule {fired.rule.number}, {fired.strength:.2f})"


def _treated(name: str, inference: Inference) -> str:
    """The coercion of a variable's level, shown wherever the variable is."""
    coercion = inference.coercions.get(name)
    return f" (treated as {coercion.to} level)" if coercion else ""


def _plain(fact: Known) -> str:
    return f"{fact:g}" if isinstance(fact, float) else str(fact)
