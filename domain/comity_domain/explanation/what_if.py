"""The cost of going to another person next."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from comity_domain.choices.options import options
from comity_domain.labelling.search import cheapest
from comity_domain.labelling.skipping import served_part
from comity_domain.plans.actions import FETCH, GREET, GREET_TOGETHER, LEAVE, OFFER, REACH, RETURN, SKIP
from comity_domain.plans.plan import Plan, PlanStep
from comity_domain.problem.measuring import measured, unmeasured
from comity_domain.problem.request import VisitRequest
from comity_domain.problem.spot import START, Spot
from comity_domain.tours.tour import PlannedVisit, best_tour, path, served, tour_cost
from comity_fis.record import Record

MOST_PEOPLE = 12
"""Maximum number of people: with more, the answers would be inexact and slow."""


@dataclass(frozen=True, slots=True)
class NextInstead(Record):
    """Another person to visit at one stop of a plan, with the rest replanned."""

    person: str
    extra_cost: int | None
    """Additional cost in plan cost units; None if a deadline or a route excludes it."""


def visits_of(plan: Plan) -> tuple[PlannedVisit, ...]:
    """The visits of a plan with their choices."""
    by_person: dict[str, list[PlanStep]] = {}
    for step in plan.steps:
        if step.action != SKIP:
            by_person.setdefault(step.person, []).append(step)
    return tuple(_visit(person, steps) for person, steps in by_person.items())


def _visit(person: str, steps: Sequence[PlanStep]) -> PlannedVisit:
    """One stop: all the steps before one person."""
    sides = [step.arguments[2] for step in steps if step.action in (REACH, RETURN)]
    greet = next((step for step in steps if step.action in (GREET, GREET_TOGETHER)), None)
    leave = next((step for step in steps if step.action == LEAVE), None)
    return PlannedVisit(
        Spot(person, sides[0]),
        greet.arguments[2] if greet is not None and greet.action == GREET_TOGETHER else None,
        None if greet is None else (greet.arguments[-2], greet.arguments[-1]),
        bringing=_comes_bringing(steps),
        returns=tuple(Spot(person, side) for side in sides[1:]),
        farewell=None if leave is None else (leave.arguments[-2], leave.arguments[-1]),
    )


def _comes_bringing(steps: Sequence[PlanStep]) -> bool:
    """Whether what is offered first was fetched before the person is reached, in this plan or before it."""
    carrying = next((step.action for step in steps if step.action in (FETCH, OFFER)), None)
    return carrying == OFFER or steps[0].action == FETCH


def next_instead(request: VisitRequest, plan: Plan, stop: int) -> tuple[NextInstead, ...]:
    """Cost of going to each of the others at this stop, cheapest first.

    Args:
        request: What was planned.
        plan: Its plan.
        stop: From 0.
    """
    if len(request.visitees) > MOST_PEOPLE:
        return ()
    request, visits = served_part(request, plan), visits_of(plan)
    begun = visits[:stop]
    request = measured(request, unmeasured(request, path(begun, options(request))))
    choices = options(request)
    spent = tour_cost(begun, choices) or 0
    planned = sum(step.cost for step in plan.steps if step.action != SKIP)  # who is left out stays so
    done = {name for visit in begun for name in served(visit, choices)}
    others = [name for name in choices.people if name not in done and name != visits[stop].spot.place]
    found = []
    for name in others:
        cost, request = _rest(request, begun, name)
        found.append(NextInstead(name, None if cost is None else spent + cost - planned))
    return tuple(sorted(found, key=lambda each: (each.extra_cost is None, each.extra_cost)))


def _rest(request: VisitRequest, begun: Sequence[PlannedVisit], name: str) -> tuple[int | None, VisitRequest]:
    """What it costs to go on with a person; None: it cannot be done. And the request with that measured."""
    start = begun[-1].last_spot if begun else START
    while True:
        choices = options(request)
        rest = cheapest(choices, begun=begun, next_person=name)
        if rest is None:
            return None, request
        tour = (*begun, *best_tour(rest.stops, choices, start=start))
        missing = unmeasured(request, path(tour, choices))
        if not missing:
            return rest.cost, request
        request = measured(request, missing)
