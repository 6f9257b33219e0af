"""Detects features beyond classical planning, in which numbers occur only in constant action costs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity_domain.custom.costs.cost import functions_in

if TYPE_CHECKING:
    from unified_planning.model import FNode, Problem

MAXIMIZED = "a metric to maximize"
OTHER_METRIC = "a metric that is not the sum of what actions cost"
TIMED = "actions that take time, or things that happen at a time"
NUMERIC = "numbers that change or are compared"


@dataclass(frozen=True, slots=True)
class Beyond:
    """A feature beyond classical planning."""

    words: str
    part: str
    """Where it occurs: an action's name, or a section of the problem such as `:metric`."""


def beyond_classical(problem: Problem) -> Beyond | None:
    """The first feature beyond classical planning, or None."""
    metric = problem.quality_metrics[0] if problem.quality_metrics else None
    if metric is not None and metric.is_maximize_expression_on_final_state():
        return Beyond(MAXIMIZED, ":metric")
    if (part := timed_part(problem)) is not None:
        return Beyond(TIMED, part)
    if problem.kind.has_final_value():
        return Beyond(OTHER_METRIC, ":metric")
    numeric = {fluent.name for fluent in problem.fluents if not fluent.type.is_bool_type()}
    return next(
        (Beyond(NUMERIC, part) for part, one in used_in(problem) if functions_in(one) & numeric), None
    )


def timed_part(problem: Problem) -> str | None:
    """The first part with durative actions or timed effects, or None."""
    from unified_planning.model import InstantaneousAction

    if problem.timed_effects or problem.timed_goals or problem.trajectory_constraints:
        return ":init"
    return next((one.name for one in problem.actions if not isinstance(one, InstantaneousAction)), None)


def used_in(problem: Problem, *, changed: bool = True) -> Iterator[tuple[str, FNode]]:
    """All conditions, and the expressions that determine numeric values, by part.

    Args:
        problem: A problem without timed parts.
        changed: Whether to include the targets of effects.
    """
    for action in problem.actions:
        yield from ((action.name, one) for one in action.preconditions)
        for effect in action.effects:
            yield from ((action.name, one) for one in (effect.value, effect.condition))
            if changed:
                yield action.name, effect.fluent
    yield from ((":goal", one) for one in problem.goals)


_STRIPS_LACKS = {
    "QUANTIFIERS": {"EXISTENTIAL_CONDITIONS", "UNIVERSAL_CONDITIONS", "FORALL_EFFECTS"},
    "DISJUNCTIVE_CONDITIONS": {"DISJUNCTIVE_CONDITIONS"},
    "CONDITIONAL_EFFECTS": {"CONDITIONAL_EFFECTS"},
}
"""Features of unified-planning, by the compiler that removes them."""


def beyond_strips(problem: Problem) -> list[str]:
    """The compilers of unified-planning that this problem needs to become STRIPS."""
    features = problem.kind.features
    return [name for name, lacks in _STRIPS_LACKS.items() if features & lacks]
