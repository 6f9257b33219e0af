"""Converts a metric that actions only increase, such as `(minimize (walked))`, to action costs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity_domain.custom.costs.classical import timed_part, used_in
from comity_domain.custom.costs.cost import functions_in
from comity_domain.custom.reading.reading import COST

if TYPE_CHECKING:
    from unified_planning.model import FNode, InstantaneousAction, Problem


def counter_as_costs(problem: Problem) -> Problem:
    """The problem with such increases as action costs; otherwise the problem itself.

    A function qualifies if actions only increase it, unconditionally, and no condition reads it. Its final
    value is then its initial value, the same for every plan, plus the sum of the action costs.

    Args:
        problem: A problem as read by unified-planning.
    """
    from unified_planning.model.metrics import MinimizeActionCosts

    counter = _minimized(problem)
    if counter is None or not _only_increased(problem, counter):
        return problem
    counted = problem.clone()
    costs = {action: _taken_out(action, counter) for action in counted.actions}
    counted.clear_quality_metrics()
    counted.add_quality_metric(MinimizeActionCosts(costs, environment=problem.environment))
    return counted


def _minimized(problem: Problem) -> str | None:
    """The function without arguments that the metric minimises; `total-cost` without a metric."""
    metrics = problem.quality_metrics
    if not metrics and problem.has_fluent(COST):
        return COST
    if len(metrics) != 1 or not metrics[0].is_minimize_expression_on_final_state():
        return None
    expression = metrics[0].expression
    return str(expression.fluent().name) if expression.is_fluent_exp() and not expression.args else None


def _only_increased(problem: Problem, counter: str) -> bool:
    if timed_part(problem):
        return False
    if any(counter in functions_in(one) for _, one in used_in(problem, changed=False)):
        return False
    changes = (effect for action in problem.actions for effect in action.effects)
    return all(
        effect.is_increase() and not effect.is_conditional() and not effect.is_forall()
        for effect in changes
        if effect.fluent.fluent().name == counter
    )


def _taken_out(action: InstantaneousAction, counter: str) -> FNode:
    """Remove the increases from an action.

    Returns:
        Sum of the removed increases.
    """
    effects = list(action.effects)
    manager = action.environment.expression_manager
    action.clear_effects()
    added = []
    for effect in effects:
        if effect.fluent.fluent().name == counter:
            added.append(effect.value)
        else:
            action._add_effect_instance(effect)
    if len(added) < 2:
        return added[0] if added else manager.Int(0)
    return manager.Plus(*added)
