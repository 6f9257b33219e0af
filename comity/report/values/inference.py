"""The parameters of one person."""

from __future__ import annotations

from dataclasses import fields
from typing import TYPE_CHECKING, Any

from comity.answers.inference import InferAnswer, SettledAnswer
from comity.report.text import number, stated, table, terms_in_words, words, words_of
from comity_fis import kept_back, outvoting, rests_on_facts
from comity_fis.inference.value import fact_as_json
from comity_fis.listing import listed
from comity_fis.record import reader

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence
    from datetime import date

    from rich.console import RenderableType

    from comity_fis import FiredRule, Inference, Known, ParameterValue, RuleAccount
    from comity_fis.inference.value import Contribution

    Inputs = Mapping[str, Known | None]


def infer_answer(inference: Inference, day: date | None = None) -> InferAnswer:
    """The answer of `comity infer --json`; a day where the facts depend on it."""
    return reader(InferAnswer).validate_python({**inference.as_json(), "at": day})


def inputs_answer(inputs: Inputs) -> Mapping[str, Any]:
    """What is known of each variable, as an answer has it."""
    return {name: fact_as_json(fact) for name, fact in inputs.items()}


def value_fields(value: ParameterValue) -> dict[str, Any]:
    """What every answer about a value has: the fields of `ValueAnswer`."""
    return {
        **{name: getattr(value, name) for name in ("value", "unit", "spread", "origin", "contributions")},
        "desirability": getattr(value.desirability, "memberships", None),
        "curve": getattr(value.desirability, "outline", None),
        "note": value.note,
        "parts": value.parts,
    }


def settled(value: ParameterValue) -> SettledAnswer:
    """A value and what it is made of: no curve, no rules, which `comity explain` has."""
    return SettledAnswer(**{field.name: getattr(value, field.name) for field in fields(SettledAnswer)})


def infer_text(
    inference: Inference, units: Mapping[str, str | None], day: date | None = None
) -> Sequence[RenderableType]:
    """What was disclosed, and each parameter with what decided it.

    Args:
        inference: The rulebook's answer.
        units: Of the rulebook's variables, by name.
        day: On which the facts were taken; None where none depends on it.
    """
    known = {name: fact for name, fact in inference.inputs.items() if fact is not None}
    unknown = [name for name in inference.inputs if name not in known]
    facts = ", ".join(
        f"{words(name)} {stated(fact, units.get(name))}{_treated(name, inference)}"
        for name, fact in known.items()
    )
    return (
        f"Rulebook {inference.rulebook}, {inference.mode} centre of area"
        + (f", facts as of {day}" if day else ""),
        f"Disclosed: {facts or 'nothing'}" + (f"; not disclosed: {words_of(unknown)}" if unknown else ""),
        *(f"Note: {note}" for note in inference.notes),
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
    """Why a parameter has its value: in one line, or with a line for every further contribution and part.

    What was not disclosed and yet outvotes what was comes first.
    """
    lines = [_why(value, inputs)]
    if len(value.contributions) > 1:
        lines = [
            f"{c.origin} {_step(value, i)}: {moved(value, c, inputs) if i else lines[0]}"
            for i, c in enumerate(value.contributions)
        ]
    lines += [f"{part.name} ({part.share:.0%}): {number(part.value, value.unit)}" for part in value.parts]
    return "\n".join(lines)


def in_brief(value: ParameterValue, inputs: Inputs) -> str:
    """The same in one line: the strongest rule whole, and what the next and those possible give a number."""
    resting = [fired for fired in value.fired if rests_on_facts(fired.rule, inputs)]
    if outvoted_text(value, inputs):
        return _why(value, inputs)
    if isinstance(value.value, str):
        resting = [fired for fired in resting if value.value in concluded(fired, value.name)][:1]
    if len(value.contributions) > 1 or value.parts or not (value.decided_by_rules and resting):
        return "; ".join(because(value, inputs).splitlines())
    first, *others = resting[:RULES_SHOWN]
    next_ones = (
        f"→ {terms_in_words(concluded(fired, value.name))} ({speaks(fired, inputs, digits=2)})"
        for fired in others
    )
    rests = ", ".join((_in_short(first, value.name, inputs), *next_ones))
    hidden = "" if isinstance(value.value, str) else possible(value.fired, inputs)
    return "; ".join(filter(None, (rests, hidden)))


def moved(value: ParameterValue, step: Contribution, inputs: Inputs) -> str:
    """Why a further contribution was added: the rules over the situation, or its own words."""
    if step.origin == "situation" and value.shift:
        return "; ".join(_in_short(fired, value.name, inputs) for fired in value.shift.fired)
    return words(step.text)


def _step(value: ParameterValue, i: int) -> str:
    """The start of a number, or what a further contribution adds to it."""
    step = value.contributions[i].value
    sign = "+" if i and not isinstance(step, str) and step >= 0 else ""
    return sign + number(step, value.unit)


def _why(value: ParameterValue, inputs: Inputs) -> str:
    """The strongest rules that rest on something disclosed, and in words those that nothing excludes."""
    if not value.fired or not value.decided_by_rules:
        return words(value.note or value.start.text)
    fired, first = list(value.fired), outvoted_text(value, inputs)
    if first and (found := outvoting(value, inputs)):
        fired = [one for one in fired if one is not found.outvoted and one not in found.rules]
    resting = [one for one in fired if rests_on_facts(one.rule, inputs)]
    parts = [first, *(_in_short(one, value.name, inputs) for one in resting[:RULES_SHOWN])]
    if weaker := resting[RULES_SHOWN:]:
        parts.append(f"{len(weaker)} weaker {'rule' if len(weaker) == 1 else 'rules'}")
    parts += [possible(fired, inputs), words(value.note)]
    return "; ".join(filter(None, parts))


def outvoted_text(value: ParameterValue, inputs: Inputs) -> str:
    """`age not disclosed outvotes posture is seated → low (rule 9, 0.99): rule 8 → high`, or nothing."""
    found = outvoting(value, inputs)
    if found is None:
        return ""
    numbers = ", ".join(str(number) for number in sorted(one.rule.number for one in found.rules))
    rules = f"rule {numbers}" if len(found.rules) == 1 else f"rules {numbers}"
    terms = dict.fromkeys(term for one in found.rules for term in concluded(one, value.name))
    return (
        f"{words_of(found.hidden)} not disclosed {'outvotes' if len(found.hidden) == 1 else 'outvote'} "
        f"{_in_short(found.outvoted, value.name, inputs)}: {rules} → {listed(map(words, terms), 'or')}"
    )


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
    terms = terms_in_words(concluded(fired, parameter))
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
