"""One step of a plan: what it is made of, and what everything else would have cost."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.answers import NextInsteadAnswer, StepAnswer, StepWhyAnswer
from comity.report.step_values import step_values
from comity.report.text import number, table, words
from comity_domain import next_instead
from comity_fis import InputError, Where, closest

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rich.console import RenderableType

    from comity.answers import PlanAnswer, StepValueAnswer
    from comity.preparation import Prepared

PARTS = {
    "travel": "of way",
    "side": "for a side that suits less than another might",
    "greeting": "for a greeting that suits less than another might",
    "farewell": "for a farewell that suits less than another might",
    "nearness": "for standing nearer to others than suits them",
    "waiting": "because others are greeted before",
    "skip": "for leaving them out",
}


def step_why(answer: PlanAnswer, prepared: Prepared, asked: str) -> StepWhyAnswer:
    """The answer of `comity plan --why STEP`.

    Args:
        answer: The plan.
        prepared: What it was made of.
        asked: A number from 1, or an action with a person: `Greet_person(johanna)`.

    Raises:
        InputError: if the plan has no such step.
    """
    place = _number(answer, asked)
    step = answer.steps[place - 1]
    instead = (
        next_instead(prepared.asked.request, prepared.plan, _stop(answer, place))
        if step.action == "Reach_user"
        else ()
    )
    return StepWhyAnswer(
        number=place,
        step=step,
        values=tuple(step_values(step, prepared.values)),
        next_instead=tuple(
            NextInsteadAnswer(person=each.person, extra_cost=each.extra_cost) for each in instead
        ),
    )


def _stop(answer: PlanAnswer, number: int) -> int:
    """How many stops come before a step."""
    return sum(step.action == "Reach_user" for step in answer.steps[: number - 1])


def why_text(why: StepWhyAnswer) -> Iterator[RenderableType]:
    """The same, for a person to read."""
    from rich.padding import Padding

    step = why.step
    yield f"Step {why.number}: {step.action}({', '.join(step.arguments)}), cost {step.cost}"
    yield from (f"  {cost} {PARTS.get(part, part)}" for part, cost in step.cost_parts.items() if cost)
    yield "\nWhy"
    yield Padding(step.why.text, (0, 0, 0, 2))
    if why.values:
        yield "\nWhy these values"
        yield table([_value(value, why.step) for value in why.values])
    no_choice = not (step.why.alternatives or step.why.ruled_out) and step.action != "Skip_visit"
    if step.why.alternatives or no_choice:
        yield "\nInstead"
    if no_choice:
        yield "  Nothing: there is no other way to do this step."
    for other in step.why.alternatives:
        choice = ", ".join(map(words, _choice(other.arguments)))
        yield Padding(f"{choice}: {other.extra_cost} more; {other.because}", (0, 0, 0, 2))
    if step.why.ruled_out:
        yield "\nNot possible"
    for option in step.why.ruled_out:
        choice = ", ".join(map(words, _choice(option.arguments)))
        yield Padding(f"{choice}: {option.reason}", (0, 0, 0, 2))
    if why.next_instead:
        yield "\nSomebody else first, all that follows planned anew"
    for each in why.next_instead:
        cost = "no deadline or route allows it" if each.extra_cost is None else f"{each.extra_cost} more"
        yield f"  {each.person}: {cost}"


def _value(value: StepValueAnswer, step: StepAnswer) -> tuple[str, str, str]:
    """Whose it is where the step serves several, what is planned, and what the person's own is made of."""
    name = words(value.parameter)
    if len(step.people) > 1:
        name = f"{value.person}: {name}"
    planned = number(value.planned, value.unit)
    if value.parameter == "approach_direction":
        planned += f" → {step.arguments[-1]}"
    if value.planned == value.value:
        return name, planned, value.because
    return name, planned, f"{number(value.value, value.unit)} by itself: {value.because}"


def _choice(arguments: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(word for word in arguments[2:] if word != "none")


def _number(answer: PlanAnswer, asked: str) -> int:
    names: dict[str, int] = {}
    for place, step in enumerate(answer.steps, start=1):
        names.setdefault(_name(step), place)  # of several, the first
    word = asked.replace(" ", "")
    if word.isdecimal() and 1 <= int(word) <= len(answer.steps):
        return int(word)
    for name, place in names.items():
        if word.lower() == name.replace(" ", "").lower():
            return place
    raise InputError(
        expected=f"a step of the plan: 1 to {len(answer.steps)}, or an action with its person"
        if answer.steps
        else "a plan with steps",
        got=repr(asked),
        remedy=closest(asked, names) if names else "There is nothing to do in this scenario.",
        where=Where("--why"),
    )


def _name(step: StepAnswer) -> str:
    """`Greet_person(johanna)`."""
    return f"{step.action}({step.arguments[1]})"
