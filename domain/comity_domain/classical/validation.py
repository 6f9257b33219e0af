"""Plan validation by unified-planning's validator, independent of how the plan was found."""

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
    """The result of the validator."""

    valid: bool
    """Whether every action is applicable in turn, and all goals are reached."""
    reason: str
    """Why the plan is invalid; empty if valid."""
    cost: int
    """Total cost of the actions, as stated by the problem: the cost of the plan."""


def validate(plan: Plan, request: VisitRequest) -> Validation:
    """Validate a plan.

    Args:
        plan: A plan for the request.
        request: The planning request; its deadlines are ignored.
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
