"""A plan in a custom domain, as JSON output and as text."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from comity.answers.plan import CustomDomainAnswer, FailureAnswer, PlanAnswer, StepAnswer
from comity.report.plans.plan import ALTERNATIVES_SHOWN, no_plan, quality_of, step_answer
from comity.report.plans.proof import quality
from comity.report.text import unbroken

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Mapping

    from rich.console import RenderableType

    from comity_domain import PlanningFailed
    from comity_domain.custom import Bound, CustomPlan


def custom_plan_answer(
    bound: Bound, found: CustomPlan, *, renamed: Mapping[str, str], files: tuple[str, ...]
) -> PlanAnswer:
    """The answer of `comity plan --domain ... --json`.

    Args:
        bound: The planning problem.
        found: The plan.
        renamed: Names changed in exported PDDL.
        files: Written files.
    """
    plan, people = found.plan, _people(bound)
    costs: dict[str, Any] = {
        name: getattr(plan, name) if found.tells_costs else None for name in ("cost", "bound", "gap")
    }
    return PlanAnswer(
        scenario=None,
        own=replace(_own(bound, renamed, files), metric_ignored=found.metric_ignored),
        solved=True,
        **quality_of(plan),
        **costs,
        steps=tuple(_steps(bound, found, people)),
        unreachable=(),
        unmet=(),
        already=(),
    )


def _steps(bound: Bound, found: CustomPlan, people: Collection[str]) -> Iterator[StepAnswer]:
    for step, action, person in zip(found.plan.steps, found.actions, found.whose, strict=True):
        yield replace(
            step_answer(step, bound.people[person] if bound.people and person else None),
            people=tuple(name for name in step.arguments if name in people),
            cost=step.cost if found.tells_costs else None,
            start_s=action.start_s,
            duration_s=action.duration_s,
        )


def no_custom_plan_answer(
    bound: Bound | None, failed: PlanningFailed, *, renamed: Mapping[str, str], files: tuple[str, ...]
) -> PlanAnswer:
    """The answer without a plan, in the same form as for a scenario.

    Args:
        bound: The planning problem; None if it could not be read.
        failed: The reason.
        renamed: Names changed in exported PDDL.
        files: Written files.
    """
    return PlanAnswer(
        scenario=None,
        own=None if bound is None else _own(bound, renamed, files),
        failure=FailureAnswer(reason=failed.reason, remedy=failed.remedy),
        **no_plan(reproducible=not failed.cut_off),
        unreachable=(),
        unmet=(),
        already=(),
    )


def _people(bound: Bound) -> tuple[str, ...]:
    return () if bound.people is None else tuple(bound.people.known)


def _own(bound: Bound, renamed: Mapping[str, str], files: tuple[str, ...]) -> CustomDomainAnswer:
    return CustomDomainAnswer(
        domain=bound.own.domain_name,
        problem=bound.own.problem_name,
        cost_scale=bound.cost_scale,
        people=_people(bound),
        renamed=renamed,
        files=files,
    )


def custom_plan_text(answer: PlanAnswer) -> Iterator[RenderableType]:
    """The answer as text."""
    from rich.padding import Padding

    assert answer.own is not None
    tells_costs = answer.cost is not None
    cost = f"cost {answer.cost}" if tells_costs else f"found by {answer.engine}, which tells no costs"
    head = f"Plan for {answer.own.problem} ({answer.own.domain}): {_count(answer)}"
    yield f"{head}, {cost} ({quality(answer)})"
    if answer.own.metric_ignored:
        yield f"{answer.engine} did not look at the metric: another plan may be better by it."
    if answer.own.cost_scale != 1:
        yield f"A cost of {answer.own.cost_scale} is 1 of the domain's own."
    for i, step in enumerate(answer.steps, start=1):
        time = "" if step.start_s is None else f"   at {step.start_s:g} s for {step.duration_s:g} s"
        price = f"   cost {step.cost}" if tells_costs else ""
        yield f"\n{i:3}. {step.action}({', '.join(step.arguments)}){price}{time}"
        if not step.parameters:
            continue  # no preference is bound to it
        yield Padding(step.why.text, _IN)
        yield from (Padding(line, (0, 0, 0, 7)) for line in _others(step))
    for file in answer.own.files:
        yield unbroken(f"\nWritten  {file}")


_IN = (0, 0, 0, 5)


def _count(answer: PlanAnswer) -> str:
    return "1 step" if len(answer.steps) == 1 else f"{len(answer.steps)} steps"


def _others(step: StepAnswer) -> Iterator[str]:
    for other in step.why.alternatives[:ALTERNATIVES_SHOWN]:
        yield f"or {step.action}({', '.join(other.arguments)}) for {other.extra_cost} more"
    if hidden := step.why.alternatives[ALTERNATIVES_SHOWN:]:
        yield f"or {len(hidden)} others, from {hidden[0].extra_cost} more"
