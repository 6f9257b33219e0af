"""What a domain has beyond classical planning, where numbers stand in fixed costs of actions only."""

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
    """Something that is more than classical planning."""

    words: str
    part: str
    """Where it stands: an action's name, or a section of the problem such as `:metric`."""


def beyond_classical(problem: Problem) -> Beyond | None:
    """The first such thing; None where there is none."""
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
    """The first part in which actions take time, or something happens at a time; None where nothing does."""
    from unified_planning.model import InstantaneousAction

    if problem.timed_effects or problem.timed_goals or problem.trajectory_constraints:
        return ":init"
    return next((one.name for one in problem.actions if not isinstance(one, InstantaneousAction)), None)


def used_in(problem: Problem, *, changed: bool = True) -> Iterator[tuple[str, FNode]]:
    """All that decides whether something is done or holds, or what a number becomes, by part.

    Args:
        problem: One in which nothing is timed.
        changed: Whether what actions change counts, too.
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
"""Features of unified-planning, by the compiler that takes them away."""


def beyond_strips(problem: Problem) -> list[str]:
    """The compilers of unified-planning that have something to take away."""
    features = problem.kind.features
    return [name for name, lacks in _STRIPS_LACKS.items() if features & lacks]
