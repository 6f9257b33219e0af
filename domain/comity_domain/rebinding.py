"""Parameter updates of an old plan: a person moved, asked for something or was learnt about.

The discrete choice (order, sides, greetings) of the old plan is kept only where it is known to be still the
cheapest, and it is known exactly, from the new prices of everything on offer: sides and greetings of the old
order are settled again by dynamic programming (`tour.best_tour`), and the cost of the best plan of all is
found without a planner by the exact label search, which knows companies, priorities and deadlines. Otherwise
the visit is replanned.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from comity_domain.choices.options import Options, options
from comity_domain.explanation.around import options_around
from comity_domain.explanation.what_if import visits_of
from comity_domain.labelling.search import cheapest
from comity_domain.labelling.skipping import left_out, skip_steps
from comity_domain.plans.actions import ANNOUNCED, REACH, RETURN, SKIP
from comity_domain.plans.plan import Plan, PlanStep
from comity_domain.problem.measuring import measured, unmeasured
from comity_domain.problem.request import VisitRequest
from comity_domain.steps import steps_of
from comity_domain.tours.lateness import Late, late
from comity_domain.tours.tour import PlannedVisit, Stop, best_tour, path, served, tour_cost
from comity_domain.visit_plan import VisitPlan


def rebind(plan: Plan, request: VisitRequest) -> VisitPlan | None:
    """The same plan with the parameters, costs and reasons of a changed request.

    Args:
        plan: A plan for the same people, made before the change.
        request: What holds now: people's parameters, and the routes to them.

    Returns:
        None where the plan may no longer be the cheapest: other people, a side or greeting that is out or no
        longer the best, another order that is cheaper now, a deadline that it would miss, or more people than
        can be told exactly.

    Raises:
        ValueError: The request holds a person whom no plan can serve.
    """
    leaving = left_out(request)
    visited = _rebound(tuple(_stops(plan)), request.dropping(leaving))
    steps = (*visited, *skip_steps(request, leaving))
    if _choices(steps) != _choices(plan.steps):
        return None
    cost = sum(step.cost for step in steps)
    return VisitPlan(
        plan.engine,
        optimal=True,
        reproducible=True,
        cost=cost,
        bound=cost,
        steps=steps,
        killed=plan.killed,
        request=request,
    )


def kept_cost(plan: Plan, request: VisitRequest) -> int | None:
    """What the choices of an old plan would cost now, in cm; None where one of them is not open any more.

    Args:
        plan: A plan for the same people, made before the change.
        request: What holds now.
    """
    kept = _kept(plan, request)
    cost = None if kept is None else tour_cost(*kept)
    skipped = sum(step.cost for step in plan.steps if step.action == SKIP)
    return None if cost is None else cost + skipped


def kept_late(plan: Plan, request: VisitRequest) -> Late | None:
    """Who would be greeted too late with the choices of an old plan; None where nobody is known to be.

    Args:
        plan: A plan for the same people, made before the change.
        request: What holds now; its clock begins now.
    """
    kept = _kept(plan, request)
    return None if kept is None or tour_cost(*kept) is None else late(*kept)


def _kept(plan: Plan, request: VisitRequest) -> tuple[tuple[PlannedVisit, ...], Options] | None:
    """The visits of an old plan with the options of now; None where a person of it is not to be visited."""
    visits = visits_of(plan)
    names = {visit.spot.place for visit in visits}
    if not names <= {visitee.name for visitee in request.visitees} or not _is_announced(plan, request):
        return None
    request = measured(request, unmeasured(request, path(visits, options(request))))
    return visits, options(request)


def _is_announced(plan: Plan, request: VisitRequest) -> bool:
    """Whether a plan tells of the robot's coming those who do not see now, and nobody else."""
    told = {visitee.name: not visitee.now.sees for visitee in request.visitees}
    comings = (step for step in plan.steps if step.action in (REACH, RETURN))
    return all((ANNOUNCED in step.parameters) == told.get(step.person, False) for step in comings)


def same_choices(plan: Plan, other: Plan) -> bool:
    """Whether two plans differ in their numbers only."""
    return _choices(plan.steps) == _choices(other.steps)


def _choices(steps: Sequence[PlanStep]) -> list[tuple[tuple[str, ...], object, object]]:
    """What is discrete about steps: arguments, and whether words go with a handing over, or the coming."""
    return [
        (step.arguments, step.parameters.get("modality"), step.parameters.get(ANNOUNCED)) for step in steps
    ]


def _stops(plan: Plan) -> Iterator[Stop]:
    """The person whom the plan reaches, and whether it greets their company at once."""
    for visit in visits_of(plan):
        yield visit.stop


def _rebound(stops: Sequence[Stop], request: VisitRequest) -> tuple[PlanStep, ...]:
    """The steps of the best tour in this order, where it is the cheapest of all; else none."""
    while True:
        choices = options(request)
        visits = _best_in_order(stops, choices)
        missing = unmeasured(request, path(visits, choices))
        if visits and not missing:
            best = cheapest(choices)
            if best is None or not best.exact:
                return ()
            if best.cost == tour_cost(visits, choices):
                return tuple(steps_of(visits, choices, options_around(request, visits)))
            missing = unmeasured(request, path(best_tour(best.stops, choices), choices))
        if not missing:
            return ()
        request = measured(request, missing)


def _best_in_order(stops: Sequence[Stop], choices: Options) -> tuple[PlannedVisit, ...]:
    """The best tour in this order; none where there is no such tour any more, or it is late."""
    known = all(
        stop.person in choices.people and (stop.company is None or stop.company in choices.companies)
        for stop in stops
    )
    try:
        visits = best_tour(stops, choices) if known else ()
    except ValueError:
        return ()
    if sorted(name for visit in visits for name in served(visit, choices)) != sorted(choices.people):
        return ()
    return () if late(visits, choices) else visits
