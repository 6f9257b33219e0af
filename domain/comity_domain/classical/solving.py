"""The exact search as a solver of a unified-planning problem."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity_domain.classical.problem import sequential_plan
from comity_domain.classical.reading import choices_of
from comity_domain.classical.timing import NO_TIMING, Timing
from comity_domain.errors import require_time_limit
from comity_domain.ordering.best_order import best_order
from comity_domain.ordering.order import Order
from comity_domain.tours.tour import best_tour

if TYPE_CHECKING:
    from unified_planning.model import Problem
    from unified_planning.plans import SequentialPlan


def solve(problem: Problem, timing: Timing | None = None, *, time_limit_s: float = 30.0) -> SequentialPlan:
    """The cheapest plan of a visit problem; with its timing, the plan that `make_plan` finds.

    A problem does not state which of several equally expensive plans is the most desirable; its timing does.

    Args:
        problem: A problem in the form of `problem_of`.
        timing: What it cannot express, from `timing_of`.
        time_limit_s: Wall-clock time [s], > 0; if it runs out, the plan is the best one found so far.

    Raises:
        InputError: The problem states something that `problem_of` cannot, or the timing does not fit it.
        NoPlan: There is no plan.
        PlanningFailed: No plan was found; `cut_off` if the time limit is the reason.
        ValueError: The time limit is not positive.
    """
    return solved(problem, NO_TIMING if timing is None else timing, time_limit_s=time_limit_s)[0]


def solved(
    problem: Problem, timing: Timing = NO_TIMING, *, time_limit_s: float = 30.0
) -> tuple[SequentialPlan, Order]:
    """The plan of `solve`, and what the search knows about it."""
    require_time_limit(time_limit_s)
    choices, names = choices_of(problem, timing)
    order = best_order(choices, time_limit_s)
    visits = best_tour(order.stops, choices)
    return sequential_plan(problem, visits, choices, names), order
