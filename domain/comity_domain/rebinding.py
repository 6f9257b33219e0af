"""New numbers for an old plan: somebody moved, asked for something or was learnt about.

The discrete choice (order, sides, greetings) of the old plan is kept only where it is known to be still the
cheapest, and it is known exactly, from the new prices of everything on offer: the greetings of different
people do not touch each other, the sides follow from the order by dynamic programming (`tour.best_tour`), and
what the best order of all costs is computed without a planner (`held_karp`). Otherwise: plan again.
"""

from __future__ import annotations

from dataclasses import replace

from comity_domain.held_karp import MOST_PEOPLE, cheapest_legs
from comity_domain.options import Options, options
from comity_domain.plan import Plan, PlanStep
from comity_domain.planner import steps_of
from comity_domain.request import VisitRequest
from comity_domain.tour import best_tour


def rebind(plan: Plan, request: VisitRequest) -> Plan | None:
    """The same plan with the parameters, costs and reasons of a changed request.

    Args:
        plan: A plan for the same people, made before the change.
        request: What holds now: people's parameters, and the routes to them.

    Returns:
        None where the plan may no longer be the cheapest: other people, a side or greeting that is out or no
        longer the best, another order that is cheaper now, or more people than can be told exactly.

    Raises:
        ValueError: The request holds a person whom no plan can serve.
    """
    order = [step.person for step in plan.steps if step.action == "Reach_user"]
    if sorted(order) != sorted(visitee.name for visitee in request.visitees) or len(order) > MOST_PEOPLE:
        return None
    choices = options(request)
    steps = _rebound(order, choices)
    if [step.arguments for step in steps] != [step.arguments for step in plan.steps]:
        return None
    if order and sum(step.cost for step in steps if step.origin) != cheapest_legs(choices):
        return None
    cost = sum(step.cost for step in steps)
    return replace(plan, optimal=True, reproducible=True, cost=cost, steps=steps)


def _rebound(order: list[str], choices: Options) -> tuple[PlanStep, ...]:
    """The steps of the best tour in this order; none where no route goes through it any more."""
    try:
        visits = best_tour(order, choices)
    except ValueError:
        return ()
    return tuple(steps_of(visits, choices))
