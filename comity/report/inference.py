"""The parameters of one person."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.answers import InferAnswer
from comity.report.text import number, stated, table, words, words_of
from comity_fis import kept_back, rests_on_facts

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from rich.console import RenderableType

    from comity_fis import FiredRule, Inference, Known, ParameterValue, RuleAccount

    Inputs = Mapping[str, Known | None]


def infer_answer(inference: Inference) -> InferAnswer:
    """The answer of `comity infer --json`."""
    return InferAnswer.model_validate(inference.as_json())


def infer_text(inference: Inference, units: Mapping[str, str | None]) -> Sequence[RenderableType]:
    """What was disclosed, and each parameter with what decided it.

    Args:
        inference: The rulebook's answer.
        units: Of the rulebook's variables, by name.
    """
    known = {name: fact for name, fact in inference.inputs.items() if fact is not None}
    unknown = [name for name in inference.inputs if name not in known]
    facts = ", ".join(
        f"{words(name)} {stated(fact, units.get(name))}{_treated(name, inference)}"
        for name, fact in known.items()
    )
    return (
        f"Rulebook {inference.rulebook}, {inference.mode} centre of area",
        f"Disclosed: {facts or 'nothing'}" + (f"; not disclosed: {words_of(unknown)}" if unknown else ""),
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
            because(value, inference.inputs),
        )
        for value in inference.parameters.values()
    ]


POSSIBLE_SHOWN = 12
"""Numbers of rules that hold only because nothing excludes them."""
RULES_SHOWN = 2
"""Of those that rest on something disclosed; `comity explain` has all."""


def because(value: ParameterValue, inputs: Inputs) -> str:
    """Why a parameter has its value, in one line.

    The strongest rules that rest on something disclosed; in words those that hold only because nothing
    excludes them; the note.
    """
    moved = moves(value, inputs)
    if not value.fired or not value.decided_by_rules:
        return "; ".join((*moved, words(value.note or value.start.text)))
    resting = [fired for fired in value.fired if rests_on_facts(fired.rule, inputs)]
    parts = [_in_short(fired, value.name, inputs) for fired in resting[:RULES_SHOWN]]
    if weaker := resting[RULES_SHOWN:]:
        parts.append(f"{len(weaker)} weaker {'rule' if len(weaker) == 1 else 'rules'}")
    parts += [possible(value.fired, inputs), *moved, words(value.note)]
    return "; ".join(filter(None, parts))


def moves(value: ParameterValue, inputs: Inputs) -> list[str]:
    """What the situation and what was learnt added, in words."""
    shift = value.shift.fired if value.shift else ()
    said = [_in_short(fired, value.name, inputs) for fired in shift]
    return said + [words(part.text) for part in value.contributions[1:] if part.origin == "learnt"]


def possible(fired: Iterable[FiredRule | RuleAccount], inputs: Inputs) -> str:
    """`age, robot experience not disclosed: rules 7, 8 hold as possible`; empty where no rule does."""
    rules = [one.rule for one in fired if not rests_on_facts(one.rule, inputs)]
    if not rules:
        return ""
    hidden = {name for rule in rules for name in kept_back(rule, inputs)}
    places = sorted(rule.number for rule in rules)
    numbers = ", ".join(map(str, places[:POSSIBLE_SHOWN]))
    if len(rules) > POSSIBLE_SHOWN:
        numbers += f" and {len(rules) - POSSIBLE_SHOWN} more"
    hold = f"rule {numbers} holds" if len(rules) == 1 else f"rules {numbers} hold"
    return f"{words_of(name for name in inputs if name in hidden)} not disclosed: {hold} as possible"


def _in_short(fired: FiredRule, parameter: str, inputs: Inputs) -> str:
    """`individualism is LC1 → close (rule 3, 0.84)`."""
    terms = " and ".join(map(words, concluded(fired, parameter)))
    return f"{words(str(fired.rule.antecedent))} → {terms} ({speaks(fired, inputs, digits=2)})"


def concluded(fired: FiredRule, parameter: str) -> list[str]:
    """The terms that a rule gives a parameter."""
    return [is_.term for is_ in fired.rule.consequents if is_.name == parameter]


def speaks(fired: FiredRule, inputs: Inputs, digits: int) -> str:
    """`rule 1, 0.84, gender not disclosed`: number, strength, and what of it nobody knows."""
    hidden = words_of(kept_back(fired.rule, inputs))
    known = f"rule {fired.rule.number}, {fired.strength:.{digits}f}"
    return f"{known}, {hidden} not disclosed" if hidden else known


def _treated(name: str, inference: Inference) -> str:
    """The coercion of a variable's level, shown wherever the variable is."""
    coercion = inference.coercions.get(name)
    return f" (treated as {coercion.to} level)" if coercion else ""
