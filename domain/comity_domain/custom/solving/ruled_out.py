"""Finds steps that a plan would need but that are excluded: without a cost, or not permitted by a person."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from comity_domain.custom.costs.cost import objects_for
from comity_domain.custom.costs.preference import preferences
from comity_domain.custom.solving.bound import Bound, new_fluent, priced_anew, require, with_goals
from comity_domain.custom.solving.choosing import FAST_DOWNWARD
from comity_domain.custom.solving.engines import solve
from comity_domain.custom.solving.solution import GroundAction
from comity_domain.custom.solving.swap import argument_of, row_of
from comity_domain.errors import PlanningFailed
from comity_domain.problem.setting import is_setting

if TYPE_CHECKING:
    from unified_planning.model import FNode, Problem


def ruled_out_steps(bound: Bound, goals: Sequence[FNode], *, time_limit_s: float) -> tuple[GroundAction, ...]:
    """The excluded steps of a plan for some goals with as few of them as found; empty without a plan.

    Args:
        bound: A classical problem.
        goals: Goals to reach.
        time_limit_s: Wall-clock time for the search [s].
    """
    if not bound.rulings:
        return ()
    problem = _with_fines(bound, goals)
    try:
        found = solve(problem, engine=FAST_DOWNWARD, time_limit_s=time_limit_s)
    except PlanningFailed:
        return ()
    return tuple(dict.fromkeys(step for step in found.actions if row_of(step, bound) is None))


def _with_fines(bound: Bound, goals: Sequence[FNode]) -> Problem:
    """The problem in which excluded steps cost 1 and all others cost 0."""
    free = bound.problem.environment.expression_manager.Int(0)
    problem = with_goals(bound.problem, goals)
    costs = {action.name: free for action in problem.actions}
    for name, ruling in bound.rulings.items():
        action, table = problem.action(name), bound.tables[name]
        kept = [
            one for one in action.preconditions if not (one.is_fluent_exp() and one.fluent().name == ruling)
        ]
        require(action, kept)
        fine = new_fluent(f"fine_for_{name}", "int", action, table.arguments, problem, default=1)
        for objects in table.rows:
            problem.set_initial_value(fine(*map(problem.object, objects)), 0)
        costs[name] = fine(*map(action.parameter, table.arguments))
    return priced_anew(problem, costs)


def reason(step: GroundAction, bound: Bound) -> tuple[str, str]:
    """What would have to change to permit an excluded step, and the remedy.

    Returns:
        A clause to follow "if", and a full sentence.
    """
    table, own = bound.tables[step.name], bound.own
    key = tuple(argument_of(step, name, bound) for name in table.arguments)
    action = own.as_written(step.name)
    named = f"{action}({', '.join(map(own.as_written, step.arguments))})"
    if key not in table.unpriced:
        return _not_permitted(step, named, bound)
    atom, where = table.unpriced[key], own.places.of_cost(step.name)
    if atom is None:
        return f"{named} had a cost", f"Its cost is divided by 0 ({where}): keep 0 out of what divides it."
    function = f"({' '.join(map(own.as_written, atom))})"
    add = f"add (= {function} NUMBER) under :init ({own.places.of(':init')})"
    return f"{function} had a value", f"The cost of {action} reads it ({where}): {add}."


def _not_permitted(step: GroundAction, named: str, bound: Bound) -> tuple[str, str]:
    reasons = "; ".join(_against(step, bound))
    return f"{named} were open", f"It is ruled out: {reasons}."


def _against(step: GroundAction, bound: Bound) -> Iterator[str]:
    """Each option that a person does not permit, with what they want instead."""
    own, people = bound.own, bound.people
    binding = bound.binding.of(step.name)
    if binding is None or people is None:
        return
    person = own.as_written(argument_of(step, binding.person.lower(), bound))
    for argument, option in binding.options.items():
        objects = objects_for(bound.problem, bound.problem.action(step.name), argument.lower())
        chosen, value = argument_of(step, argument.lower(), bound), people[person][option.parameter]
        full = option.full(own, objects)
        if not preferences(full, value, person)[chosen].permitted:
            meant = f"{own.as_written(chosen)} stands for {option.parameter} {full.objects[chosen]}"
            wanted = f"asked for {value.value}" if is_setting(value) else "did not consent to it"
            yield f"{meant}, and {person} {wanted}"
