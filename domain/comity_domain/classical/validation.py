"""Whether a plan is one, by unified-planning's validator, which knows nothing of how it was found."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity_domain.classical.problem import to_unified_planning
from comity_fis.record import Record

if TYPE_CHECKING:
    from comity_domain.plans.plan import Plan
    from comity_domain.problem.request import VisitRequest


@dataclass(frozen=True, slots=True)
class Validation(Record):
    """What the validator says."""

    valid: bool
    """Every action can be done when its turn comes, and all goals are reached."""
    reason: str
    """What is wrong; empty where nothing is."""
    cost: int
    """What the actions cost together, as the problem states it: the cost of the plan."""


def validate(plan: Plan, request: VisitRequest) -> Validation:
    """Have a plan checked.

    Args:
        plan: A plan for the request.
        request: What was asked; deadlines are not looked at.
    """
    from unified_planning.engines import SequentialPlanValidator
    from unified_planning.engines.results import ValidationResultStatus

    problem, actions = to_unified_planning(plan, request)
    result = SequentialPlanValidator().validate(problem, actions)
    (metric,) = problem.quality_metrics
    evaluations = result.metric_evaluations or {}
    return Validation(
        valid=result.status is ValidationResultStatus.VALID,
        reason="" if result.reason is None else str(result.reason),
        cost=int(evaluations.get(metric, 0)),
    )
