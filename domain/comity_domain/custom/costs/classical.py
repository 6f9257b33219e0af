"""What a domain has beyond classical planning, where numbers stand in fixed costs of actions only."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from comity_domain.custom.costs.cost import functions_in

if TYPE_CHECKING:
    from unified_planning.model import FNode, PlanQualityMetric, Problem

MAXIMIZED = "a metric to maximize"
OTHER_METRIC = "a metric that is not the sum of what actions cost"
TIMED = "actions that take time, or things that happen at a time"
NUMERIC = "numbers that change or are compared"


def beyond_classical(problem: Problem) -> str | None:
    """The first such thing, in words; None where there is none."""
    from unified_planning.model import InstantaneousAction

    metric = problem.quality_metrics[0] if problem.quality_metrics else None
    if metric is not None and metric.is_maximize_expression_on_final_state():
        return MAXIMIZED
    if problem.timed_effects or problem.timed_goals or problem.trajectory_constraints:
        return TIMED
    if not all(isinstance(action, InstantaneousAction) for action in problem.actions):
        return TIMED
    if metric is not None and not _adds_up(metric):
        return OTHER_METRIC
    numeric = {fluent.name for fluent in problem.fluents if not fluent.type.is_bool_type()}
    if any(functions_in(one) & numeric for one in _expressions(problem)):
        return NUMERIC
    return None


def _adds_up(metric: PlanQualityMetric) -> bool:
    """Whether it is the sum of the actions' costs, or their number, as time is where nothing takes any."""
    return bool(
        metric.is_minimize_action_costs()
        or metric.is_minimize_sequential_plan_length()
        or metric.is_minimize_makespan()
    )


def _expressions(problem: Problem) -> Iterator[FNode]:
    yield from problem.goals
    for action in problem.actions:
        yield from action.preconditions
        for effect in action.effects:
            yield from (effect.fluent, effect.value, effect.condition)
