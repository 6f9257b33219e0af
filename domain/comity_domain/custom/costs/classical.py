"""What a domain has beyond classical planning, where numbers stand in fixed costs of actions only."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from comity_domain.custom.costs.cost import functions_in

if TYPE_CHECKING:
    from unified_planning.model import FNode, Problem

MAXIMIZED = "a metric to maximize"
OTHER_METRIC = "a metric that is not the sum of what actions cost"
TIMED = "actions that take time, or things that happen at a time"
NUMERIC = "numbers that change or are compared"


def beyond_classical(problem: Problem) -> str | None:
    """The first such thing, in words; None where there is none."""
    metric = problem.quality_metrics[0] if problem.quality_metrics else None
    if metric is not None and metric.is_maximize_expression_on_final_state():
        return MAXIMIZED
    if is_timed(problem):
        return TIMED
    if problem.kind.has_final_value():
        return OTHER_METRIC
    numeric = {fluent.name for fluent in problem.fluents if not fluent.type.is_bool_type()}
    changed = (effect.fluent for action in problem.actions for effect in action.effects)
    return NUMERIC if any(functions_in(one) & numeric for one in (*read_in(problem), *changed)) else None


def is_timed(problem: Problem) -> bool:
    """Whether actions take time, or something happens at a time."""
    from unified_planning.model import InstantaneousAction

    timed = problem.timed_effects or problem.timed_goals or problem.trajectory_constraints
    return bool(timed) or not all(isinstance(action, InstantaneousAction) for action in problem.actions)


def read_in(problem: Problem) -> Iterator[FNode]:
    """All that decides whether something is done or holds, or what a number becomes; nothing is timed."""
    yield from problem.goals
    for action in problem.actions:
        yield from action.preconditions
        for effect in action.effects:
            yield from (effect.value, effect.condition)


_STRIPS_LACKS = {
    "QUANTIFIERS": {"EXISTENTIAL_CONDITIONS", "UNIVERSAL_CONDITIONS", "FORALL_EFFECTS"},
    "DISJUNCTIVE_CONDITIONS": {"DISJUNCTIVE_CONDITIONS"},
    "CONDITIONAL_EFFECTS": {"CONDITIONAL_EFFECTS"},
}
"""Features of unified-planning, by the compiler that takes them away."""


def beyond_strips(problem: Problem) -> list[str]:
    """The compilers of unified-planning that have something to take away."""
    features = problem.kind.features
    return [name for name, lacks in _STRIPS_LACKS.items() if features & lacks]
