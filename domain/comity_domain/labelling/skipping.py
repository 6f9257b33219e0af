"""Dropped visits, if the scenario allows them at a cost: decided before anything cultural is known.

The decision weighs the costs of dropping against paths, priorities and deadlines, and nothing else. All
people are treated alike in it, so exchanging their cultures cannot change who is left out. The plan for those
who stay is made afterwards.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from time import monotonic

from comity_domain.choices.cost import travel_cost
from comity_domain.choices.options import Options, PersonOptions
from comity_domain.labelling.alike import ANY_GREETING, ANY_SIDE
from comity_domain.labelling.search import Cheapest, cheapest
from comity_domain.plans.actions import SKIP
from comity_domain.plans.plan import Plan, PlanStep, StepExplanation
from comity_domain.problem.agenda import offers
from comity_domain.problem.measuring import measured, unmeasured_ways
from comity_domain.problem.request import Visitee, VisitRequest
from comity_domain.problem.spot import START, Spot, location
from comity_domain.tours.tour import best_tour, path


@dataclass(frozen=True, slots=True)
class Leaving:
    """The people who are left out."""

    names: tuple[str, ...]
    in_time: bool = True
    """False if the time limit cut the decision off, so that another run may decide otherwise."""


def leaving(request: VisitRequest, *, ends_s: float = math.inf) -> Leaving:
    """People left out of the cheapest culture-free tour; nobody without a price, or where there is no tour.

    Args:
        request: What was asked.
        ends_s: When the first answer has to do, by the machine's clock.
    """
    if all(visitee.skip_m is None for visitee in request.visitees):
        return Leaving(())
    found = _cheapest_alike(request, ends_s)
    if found is None:
        return Leaving((), in_time=monotonic() <= ends_s)
    return Leaving(found.skipped, found.in_time)


def left_out(request: VisitRequest) -> tuple[str, ...]:
    """The same, however long it takes."""
    return leaving(request).names


def cost_of_serving(request: VisitRequest, name: str) -> int | None:
    """What it would cost, in cm, not to leave a person out, their price not counted; None where no plan can.

    As in the decision itself, everybody is reached and greeted alike, and others may be left out instead.

    Args:
        request: What was asked.
        name: Who is left out at their price.
    """
    without = _cheapest_alike(request.without((name,))) if len(request.visitees) > 1 else None
    visitees = tuple(replace(one, skip_m=None) if one.name == name else one for one in request.visitees)
    served = _cheapest_alike(replace(request, visitees=visitees))
    return None if served is None else served.cost - (without.cost if without else 0)


def skip_steps(request: VisitRequest, names: tuple[str, ...]) -> tuple[PlanStep, ...]:
    """The steps that say so, with those of visits that the request drops already.

    Args:
        request: What was asked.
        names: Who is left out.
    """
    chosen = "the way to them costs more than leaving them out, whoever they are"
    forced = "no plan can serve them"
    return tuple(
        PlanStep(
            SKIP,
            (request.robot, name),
            origin=None,
            parameters={},
            cost=travel_cost(price),
            why=StepExplanation(chosen if name in names else forced, ()),
            cost_parts={"skip": travel_cost(price)},
        )
        for name, price in request.dropping(names).dropped_m.items()
    )


def served_part(request: VisitRequest, plan: Plan) -> VisitRequest:
    """The request for the people that a plan serves, without the prices of dropped visits."""
    return replace(request.without(dropped_by(plan)), dropped_m={})


def dropped_by(plan: Plan) -> tuple[str, ...]:
    """People whose visit a plan drops."""
    return tuple(step.person for step in plan.steps if step.action == SKIP)


def _cheapest_alike(request: VisitRequest, ends_s: float = math.inf) -> Cheapest | None:
    """The cheapest tour among people who are all alike, with all measured that it takes."""
    while True:
        alike = _alike(request)
        found = cheapest(alike, ends_s=ends_s)
        if found is None:
            return None
        missing = unmeasured_ways(request, path(best_tour(found.stops, alike), alike))
        if not missing:
            return found
        request = measured(request, missing, ends_s=ends_s)
        if monotonic() > ends_s:
            return replace(found, in_time=False)


def _alike(request: VisitRequest) -> Options:
    kept = {offer.place for visitee in request.visitees for offer in offers(visitee.agenda)}

    def spot(place: str) -> Spot:
        return location(place) if place in kept else Spot(place, ANY_SIDE.name)

    legs = {
        (START if start is None else spot(start), spot(end)): travel_cost(way_m)
        for (start, end), way_m in request.ways_m.items()
    }
    people = {visitee.name: _anybody(visitee) for visitee in request.visitees}
    return Options(request.robot, people, {}, legs, {}, request.durations_s)


def _anybody(visitee: Visitee) -> PersonOptions:
    return PersonOptions(
        visitee.name,
        visitee.values,  # not looked at
        sides={ANY_SIDE.name: ANY_SIDE},
        blocked_sides={},
        greetings={ANY_GREETING: 0},
        ruled_out={},
        priority=travel_cost(visitee.priority_m),
        by_s=visitee.by_s,
        skip=None if visitee.skip_m is None else travel_cost(visitee.skip_m),
        agenda=visitee.agenda,
        is_told=not visitee.now.sees,
        bringing={ANY_GREETING: 0} if offers(visitee.agenda) else None,
        greeted=visitee.greeted,
        in_hand=visitee.in_hand,
        after=None if visitee.greeted or visitee.in_hand else visitee.after,
    )
