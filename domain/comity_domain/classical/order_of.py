"""The best order of visits, found in the problem that states what may be chosen."""

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
    """The stops of the best plan that is found; what the problem does not state has no part in it.

    Args:
        choices: What may be chosen.
        time_limit_s: Wall-clock seconds for the search, > 0.

    Raises:
        NoPlan: There is none.
        PlanningFailed: None was found; `cut_off` where the limit is the reason.
    """
    from comity_domain.classical.light_environment import LightEnvironment

    require_free_hands(choices)  # in the people's own names
    names = visit_names(choices)
    problem = problem_with(choices, names, LightEnvironment())
    plan, order = solved(problem, timing_with(choices, names), time_limit_s=time_limit_s)
    actions = ((one.action.name, [str(each) for each in one.actual_parameters]) for one in plan.actions)
    return replace(order, stops=tuple(visit.stop for visit in tour_of(actions, choices, names)))
