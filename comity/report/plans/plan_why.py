"""Explanation of a plan step: its costs, and those of all alternatives."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.answers.plan import ContrastAnswer, StepAnswer, StepWhyAnswer
from comity.report.plans.asked_step import asked_step
from comity.report.plans.plan import choice
from comity.report.plans.skipping import skipping, skipping_text
from comity.report.plans.step_values import step_values
from comity.report.text import number, table, words
from comity_domain import SKIP, from_other_sides, next_instead

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rich.console import RenderableType

    from comity.answers.plan import PlanAnswer, StepValueAnswer
    from comity.preparation import PlannedEpisode
    from comity_domain import Plan, VisitRequest

PARTS = {
    "travel": "of way",
    "side": "for a side that suits less than another might",
    "greeting": "for a greeting that suits less than another might",
    "farewell": "for a farewell that suits less than another might",
    "nearness": "for standing nearer to others than suits them",
    "waiting": "because others are greeted before",
    "skip": "for leaving them out",
}


def step_why(answer: PlanAnswer, prepared: PlannedEpisode, asked: str) -> StepWhyAnswer:
    """The answer of `comity plan --why STEP`.

    Args:
        answer: The plan.
        prepared: The planned episode.
        asked: The step, in the form of `asked_step`.

    Raises:
        InputError: if the plan has no such step.
    """
    place = asked_step(answer.steps, asked, _name)
    step = answer.steps[place - 1]
    request, plan = prepared.asked.request, prepared.plan
    is_visit = step.action == "Reach_user"
    limit_s = prepared.file.scenario.limits.planning_s
    return StepWhyAnswer(
        number=place,
        step=step,
        values=tuple(step_values(step, prepared.values)),
        next_instead=next_instead(request, plan, _stop(answer, place)) if is_visit else (),
        contrast=tuple(_contrast(step, request, plan, time_limit_s=limit_s)) if is_visit else (),
        skipping=skipping(prepared, step.people[0]) if step.action == SKIP else None,
    )


def _contrast(
    step: StepAnswer, request: VisitRequest, plan: Plan, *, time_limit_s: float
) -> Iterator[ContrastAnswer]:
    sides = [other.arguments[-1] for other in step.why.alternatives]
    for one in from_other_sides(request, plan, step.arguments[1], sides, time_limit_s=time_limit_s):
        steps = one.plan.steps if one.plan else ()
        named = tuple(f"{each.action}({', '.join(each.arguments)})" for each in steps)
        yield ContrastAnswer(side=one.side, extra_cost=one.extra_cost, steps=named)


def _stop(answer: PlanAnswer, number: int) -> int:
    """Number of docking poses before a step."""
    return sum(step.action == "Reach_user" for step in answer.steps[: number - 1])


def why_text(why: StepWhyAnswer) -> Iterator[RenderableType]:
    """The answer as text."""
    from rich.padding import Padding

    step = why.step
    yield f"Step {why.number}: {step.action}({', '.join(step.arguments)}), cost {step.cost}"
    yield from (f"  {cost} {PARTS.get(part, part)}" for part, cost in step.cost_parts.items() if cost)
    yield "\nWhy"
    yield Padding(step.why.text, (0, 0, 0, 2))
    if why.skipping is not None:
        yield from (Padding(line, (0, 0, 0, 2)) for line in skipping_text(why.skipping))
    if why.values:
        yield "\nWhy these values"
        yield table([_value(value, why.step) for value in why.values])
    yield from _instead(why)


def _instead(why: StepWhyAnswer) -> Iterator[RenderableType]:
    """All alternatives of the step, with their costs."""
    from rich.padding import Padding

    step = why.step
    no_choice = not (step.why.alternatives or step.why.ruled_out) and step.action != SKIP
    if step.why.alternatives or no_choice:
        yield "\nInstead, with the rest of the plan as it is"
    if no_choice:
        yield "  Nothing: there is no other way to do this step."
    for other in step.why.alternatives:
        chosen = ", ".join(map(words, _choice(other.arguments, step)))
        yield Padding(f"{chosen}: {other.extra_cost} more; {other.because}", (0, 0, 0, 2))
    yield from _replanned(why)
    if step.why.ruled_out:
        yield "\nNot possible"
    for option in step.why.ruled_out:
        chosen = ", ".join(map(words, _choice(option.arguments, step)))
        yield Padding(f"{chosen}: {option.reason}", (0, 0, 0, 2))
    yield from _next(why)


def _replanned(why: StepWhyAnswer) -> Iterator[RenderableType]:
    from rich.padding import Padding

    if why.contrast:
        yield "\nInstead, with all else replanned"
    for contrast in why.contrast:
        yield Padding(_contrast_text(contrast), (0, 0, 0, 2))


def _next(why: StepWhyAnswer) -> Iterator[RenderableType]:
    if why.next_instead:
        yield "\nAnother person first, all that follows replanned"
    for each in why.next_instead:
        cost = (
            "no deadline, route or order allows it" if each.extra_cost is None else f"{each.extra_cost} more"
        )
        yield f"  {each.person}: {cost}"


def _contrast_text(contrast: ContrastAnswer) -> str:
    if contrast.extra_cost is None:
        return f"{contrast.side}: there is no such plan"
    return f"{contrast.side}: {contrast.extra_cost} more; {', '.join(contrast.steps)}"


def _value(value: StepValueAnswer, step: StepAnswer) -> tuple[str, str, str]:
    """Person (if the step serves several), planned value, and contributions of the person's own value."""
    name = words(value.parameter)
    if len(step.people) > 1:
        name = f"{value.person}: {name}"
    planned = number(value.planned, value.unit)
    if value.parameter == "approach_direction":
        planned += f" → {step.arguments[-1]}"
    if value.planned == value.value:
        return name, planned, value.because
    return name, planned, f"{number(value.value, value.unit)} by itself: {value.because}"


def _choice(arguments: tuple[str, ...], step: StepAnswer) -> tuple[str, ...]:
    return tuple(word for word in choice(arguments, step) if word != "none")


def _name(step: StepAnswer) -> str:
    """`Greet_person(johanna)`."""
    return f"{step.action}({step.arguments[1]})"
