"""Finds the best order of visits in the problem that states the options."""

from __future__ import annotations

from dataclasses import replace

from comity_domain.choices.options import Options
from comity_domain.classical.initial_state import visit_names
from comity_domain.classical.problem import problem_with
from comity_domain.classical.solving import solved
from comity_domain.classical.timing import timing_with
from comity_domain.classical.tour_of import tour_of
from comity_domain.ordering.none_found import require_free_hands
from comity_domain.ordering.order import Order


def order_of(choices: Options, time_limit_s: float) -> Order:
    """The visits of the best plan found; nothing outside the problem affects the result.

    Args:
        choices: The available options.
        time_limit_s: Wall-clock time for the search [s], > 0.

    Raises:
        NoPlan: There is no plan.
        PlanningFailed: No plan was found; `cut_off` if the time limit is the reason.
    """
    from comity_domain.classical.light_environment import LightEnvironment

    require_free_hands(choices)  # checked before renaming, so that messages have the people's own names
    names = visit_names(choices)
    problem = problem_with(choices, names, LightEnvironment())
    plan, order = solved(problem, timing_with(choices, names), time_limit_s=time_limit_s)
    actions = ((one.action.name, [str(each) for each in one.actual_parameters]) for one in plan.actions)
    return replace(order, stops=tuple(visit.stop for visit in tour_of(actions, choices, names)))
