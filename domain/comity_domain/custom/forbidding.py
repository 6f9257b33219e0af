"""Replans with one choice forbidden, to show what that choice saves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from comity_domain.custom.solving.bound import Bound, new_fluent, priced_anew
from comity_domain.custom.solving.planning import CustomPlan, plan_custom
from comity_domain.custom.solving.solution import GroundAction
from comity_domain.custom.solving.swap import argument_of
from comity_domain.errors import NoPlan, PlanningFailed
from comity_fis.record import Record

if TYPE_CHECKING:
    from unified_planning.model import Problem


@dataclass(frozen=True, slots=True)
class PlanWithout(Record):
    """The best plan without a choice."""

    forbidden: str
    """The forbidden choice, as the files name it."""
    extra_cost: int | None
    """Additional cost in planner units; None if no plan was found."""
    proven: bool
    """Whether it is proven that no plan without the choice costs less, or that none exists."""
    no_longer: tuple[str, ...]
    """Steps of the original plan that this one lacks."""
    instead: tuple[str, ...]
    """Steps of this plan that the original one lacks."""


def without(bound: Bound, found: CustomPlan, index: int, *, time_limit_s: float = 30.0) -> PlanWithout:
    """The best plan without one step's choice: its person's options, or else the step itself.

    Args:
        bound: A classical problem.
        found: The plan of this problem.
        index: Index of the step, from 0.
        time_limit_s: Wall-clock time for the engine [s], > 0.
    """
    action = found.actions[index]
    chosen = _chosen(action, bound)
    names = [bound.own.as_written(argument_of(action, name, bound)) for name in chosen]
    forbidden = f"{bound.own.as_written(action.name)}({', '.join(names)})"
    other = replace(bound, problem=_forbidding(bound.problem, action, chosen, bound))
    try:
        best = plan_custom(other, time_limit_s=time_limit_s, diagnose=False)
    except NoPlan:
        return PlanWithout(forbidden, None, True, (), ())
    except PlanningFailed:
        return PlanWithout(forbidden, None, False, (), ())
    proven = best.plan.optimal and found.plan.optimal
    return PlanWithout(forbidden, best.plan.cost - found.plan.cost, proven, *found.changes(best))


def _chosen(action: GroundAction, bound: Bound) -> Sequence[str]:
    """The arguments that define the choice, in the action's order."""
    names = [parameter.name for parameter in bound.problem.action(action.name).parameters]
    binding = bound.binding.of(action.name)
    if binding is None or not binding.options:
        return names
    wanted = {binding.person.lower(), *map(str.lower, binding.options)}
    return [name for name in names if name in wanted]


def _forbidding(problem: Problem, action: GroundAction, chosen: Sequence[str], bound: Bound) -> Problem:
    forbidding = problem.clone()
    costs = {one.name: forbidding.quality_metrics[0].get_action_cost(one) for one in forbidding.actions}
    declared = forbidding.action(action.name)
    forbidden = new_fluent(f"forbidden_{action.name}", "bool", declared, chosen, forbidding)
    objects = [forbidding.object(argument_of(action, name, bound)) for name in chosen]
    forbidding.set_initial_value(forbidden(*objects), True)
    manager = problem.environment.expression_manager
    declared.add_precondition(manager.Not(forbidden(*map(declared.parameter, chosen))))
    return priced_anew(forbidding, costs)  # costs are looked up by the current action objects
