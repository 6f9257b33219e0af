"""A plan in a domain of the user's own, as an answer and for a person to read."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from comity.answers import CustomDomainAnswer, PlanAnswer, StepAnswer
from comity.report.plans.plan import UNTOLD, no_plan
from comity.report.plans.proof import quality
from comity.report.plans.step_values import contributions_of
from comity.report.text import unbroken
from comity_domain import as_json

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from rich.console import RenderableType

    from comity_domain import PlanningFailed
    from comity_domain.custom import Bound, CustomPlan

ALTERNATIVES_SHOWN = 3


def custom_plan_answer(
    bound: Bound, found: CustomPlan, *, renamed: Mapping[str, str], files: tuple[str, ...]
) -> PlanAnswer:
    """The answer of `comity plan --domain ... --json`.

    Args:
        bound: What was planned.
        found: The plan.
        renamed: Names that exported PDDL could not keep.
        files: What was written.
    """
    content: dict[str, Any] = as_json(found.plan)
    people = _people(bound)
    for step, time, person in zip(content["steps"], found.times, found.whose, strict=True):
        step["start_s"], step["duration_s"] = time or (None, None)
        values = bound.people[person] if bound.people and person else None
        step["contributions"] = contributions_of(step["parameters"], values)
        step["people"] = [name for name in step["arguments"] if name in people]
        step["cost"] = step["cost"] if found.tells_costs else None
    if not found.tells_costs:
        content |= UNTOLD
    own = _own(bound, renamed, files).model_copy(update={"metric_ignored": found.metric_ignored})
    return PlanAnswer.model_validate({"scenario": None, "own": own, "solved": True, **content, **NOBODY})


def no_custom_plan_answer(
    bound: Bound | None, failed: PlanningFailed, *, renamed: Mapping[str, str], files: tuple[str, ...]
) -> PlanAnswer:
    """The answer where there is no plan, as a scenario has it.

    Args:
        bound: What was to be planned; None where it was not even read.
        failed: Why not.
        renamed: Names that exported PDDL could not keep.
        files: What was written.
    """
    nothing = no_plan(reproducible=not failed.cut_off)
    failure = {"reason": failed.reason, "remedy": failed.remedy}
    own = None if bound is None else _own(bound, renamed, files)
    return PlanAnswer.model_validate(
        {"scenario": None, "own": own, "solved": False, "failure": failure, **nothing, **NOBODY}
    )


NOBODY = dict.fromkeys(("unreachable", "unmet", "already"), ())
"""Goals of PDDL are nobody's."""


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
    """The same, for a person to read."""
    from rich.padding import Padding

    assert answer.own is not None
    tells_costs = answer.cost is not None
    cost = f"cost {answer.cost}" if tells_costs else f"found by {answer.engine}, which tells no costs"
    head = f"Plan for {answer.own.problem} ({answer.own.domain}): {_steps(answer)}"
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
            continue  # nobody's preference is bound to it
        yield Padding(step.why.text, _IN)
        yield from (Padding(line, (0, 0, 0, 7)) for line in _others(step))
    for file in answer.own.files:
        yield unbroken(f"\nWritten  {file}")


_IN = (0, 0, 0, 5)


def _steps(answer: PlanAnswer) -> str:
    return "1 step" if len(answer.steps) == 1 else f"{len(answer.steps)} steps"


def _others(step: StepAnswer) -> Iterator[str]:
    for other in step.why.alternatives[:ALTERNATIVES_SHOWN]:
        yield f"or {step.action}({', '.join(other.arguments)}) for {other.extra_cost} more"
    if hidden := step.why.alternatives[ALTERNATIVES_SHOWN:]:
        yield f"or {len(hidden)} others, from {hidden[0].extra_cost} more"
