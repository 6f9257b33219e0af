"""Explanation of a custom-domain plan's step: its costs, and the best plan without it."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from comity.answers.plan import StepWhyAnswer
from comity.report.plans.asked_step import asked_step
from comity.report.plans.step_values import step_values
from comity.report.text import number, table, words
from comity_domain.custom import without
from comity_domain.custom.forbidding import PlanWithout

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rich.console import RenderableType

    from comity.answers.plan import PlanAnswer, StepAnswer, StepValueAnswer
    from comity_domain.custom import Bound, CustomPlan


def custom_step_why(
    answer: PlanAnswer, bound: Bound, found: CustomPlan, asked: str, limit_s: float
) -> StepWhyAnswer:
    """The answer of `comity plan --domain ... --why STEP`.

    Args:
        answer: The plan.
        bound: The planning problem.
        found: The plan found by the planner.
        asked: The step, in the form of `asked_step`.
        limit_s: Time limit for the additional planner call [s].

    Raises:
        InputError: if the plan has no such step.
    """
    place = asked_step(answer.steps, asked, _named)
    step, person = answer.steps[place - 1], found.whose[place - 1]
    values: tuple[StepValueAnswer, ...] = ()
    if bound.people is not None and person is not None:
        alone = replace(step, people=(person,))
        values = tuple(step_values(alone, {person: bound.people[person]}))
    other = without(bound, found, place - 1, time_limit_s=limit_s) if bound.classical else None
    return StepWhyAnswer(
        number=place,
        step=step,
        values=values,
        next_instead=(),
        without=other,
    )


def _named(step: StepAnswer) -> str:
    return f"{step.action}({', '.join(step.arguments)})"


def custom_why_text(why: StepWhyAnswer) -> Iterator[RenderableType]:
    """The answer as text."""
    from rich.padding import Padding

    step = why.step
    yield f"Step {why.number}: {_named(step)}" + ("" if step.cost is None else f", cost {step.cost}")
    yield from (f"  {cost} {_part(part)}" for part, cost in step.cost_parts.items() if cost)
    yield "\nWhy"
    yield Padding(step.why.text, _IN)
    if why.values:
        yield "\nWhy these values"
        yield table([_value(value) for value in why.values])
    if step.why.alternatives:
        yield "\nInstead, in the same plan"
    for other in step.why.alternatives:
        yield Padding(f"{step.action}({', '.join(other.arguments)}): {other.extra_cost} more", _IN)
    yield "\nIf that were forbidden"
    yield from (Padding(line, _IN) for line in _without(why.without))


_IN = (0, 0, 0, 2)


def _part(part: str) -> str:
    return "by the domain's own costs" if part == "domain" else f"for {part}, which suits less than another"


def _value(value: StepValueAnswer) -> tuple[str, str, str]:
    planned = number(value.planned, value.unit)
    own = "" if value.planned == value.value else f"{number(value.value, value.unit)} by itself: "
    return words(value.parameter), planned, own + value.because


def _without(other: PlanWithout | None) -> Iterator[str]:
    if other is None:
        yield "not known: engines of numeric and durative domains do not add up what actions cost"
    elif other.extra_cost is None:
        yield (
            f"no plan is possible without {other.forbidden}"
            if other.proven
            else (f"no plan without {other.forbidden} was found within the limit: allow more with --limit")
        )
    else:
        cost = f"{other.extra_cost} more" if other.extra_cost else "the same"
        quality = "" if other.proven else ", not proven"
        yield f"the best plan without {other.forbidden} costs {cost}{quality}"
        yield from (f"no longer {step}" for step in other.no_longer)
        yield from (f"instead {step}" for step in other.instead)
