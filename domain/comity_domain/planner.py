"""From a request to a plan: solves the problem exactly, and adds full-precision parameters and reasons."""

from __future__ import annotations

from time import monotonic

from comity_domain.choices.options import Options
from comity_domain.classical.order_of import order_of
from comity_domain.errors import require_time_limit
from comity_domain.explanation.around import options_around
from comity_domain.labelling.skipping import leaving, skip_steps
from comity_domain.ordering.measuring import measured_options
from comity_domain.ordering.order import Order
from comity_domain.ordering.settling import settled
from comity_domain.plans.actions import SKIP
from comity_domain.problem.request import VisitRequest
from comity_domain.steps import steps_of
from comity_domain.tours.bound import lower_bound
from comity_domain.tours.tour import best_tour
from comity_domain.visit_plan import VisitPlan

ENGINE = "comity"
"""The planner's name in a plan and in unified-planning's factory."""


def make_plan(request: VisitRequest, *, time_limit_s: float = 30.0) -> VisitPlan:
    """The cheapest plan that visits and greets everyone, except those left out at their cost.

    Ties in cost are broken as in `choices.ties`.

    Args:
        request: The request, without people who cannot be reached on any side they accept.
        time_limit_s: Wall-clock time for searching and measuring, > 0 [s]. If it is not enough, the plan is
            the best found so far, neither `optimal` nor `reproducible`. A first plan is completed however
            little time there is; only the search for an order that keeps deadlines is given up a second
            later. Reasons use only what was measured by then.

    Raises:
        NoPlan: If there is none.
        PlanningFailed: If none was found; `cut_off` if the limit is the reason.
        ValueError: If the request contains a person whom no plan can serve.
    """
    require_time_limit(time_limit_s)
    ends_s = monotonic() + time_limit_s
    left = leaving(request, ends_s=ends_s - time_limit_s / 2)
    found = settled(request.dropping(left.names), order_of, time_limit_s=time_limit_s, ends_s=ends_s)
    bounded, choices = found.choices, measured_options(found.choices, found.request)
    visits = best_tour(found.order.stops, choices)
    around = options_around(found.request, visits, ends_s=ends_s)
    in_time = left.in_time and monotonic() <= ends_s
    steps = (*steps_of(visits, choices, around), *skip_steps(request, left.names))
    cost = sum(step.cost for step in steps)
    skipped = sum(step.cost for step in steps if step.action == SKIP)
    bound = cost if found.order.proven else min(cost, _least(found.order, bounded) + skipped)
    return VisitPlan(
        ENGINE,
        optimal=bound == cost,
        reproducible=found.order.reproducible and in_time,
        cost=cost,
        bound=bound,
        steps=steps,
        request=request,
    )


def _least(order: Order, bounded: Options) -> int:
    """What no tour can cost less than: by ways that are measured, or by bounds where they are not."""
    return max(order.bound, lower_bound(bounded))
