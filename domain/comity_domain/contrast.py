"""The contrast plan: the best plan that reaches a person from another side, with the rest replanned."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from comity_domain.errors import PlanningFailed
from comity_domain.explanation.what_if import MOST_PEOPLE
from comity_domain.labelling.skipping import served_part
from comity_domain.planner import make_plan
from comity_domain.plans.actions import SKIP
from comity_domain.plans.plan import Plan
from comity_domain.problem.request import Company, VisitRequest
from comity_domain.problem.spot import Spot


@dataclass(frozen=True, slots=True)
class Contrast:
    """The best plan with another choice."""

    side: str
    plan: Plan | None
    """The plan, or None."""
    extra_cost: int | None
    """Additional cost in plan cost units; None if there is no such plan."""


def from_other_sides(
    request: VisitRequest, plan: Plan, person: str, sides: Iterable[str], *, time_limit_s: float = 30.0
) -> tuple[Contrast, ...]:
    """The best plan for each of these sides, cheapest first; none beyond `MOST_PEOPLE` people.

    People who are left out stay left out.

    Args:
        request: What was planned.
        plan: Its plan.
        person: The person reached from elsewhere.
        sides: Their names.
        time_limit_s: Wall-clock seconds for each, > 0.
    """
    if len(request.visitees) > MOST_PEOPLE:
        return ()
    served = served_part(request, plan)
    planned = sum(step.cost for step in plan.steps if step.action != SKIP)
    found = [_contrast(served, planned, person, side, time_limit_s) for side in sides]
    return tuple(sorted(found, key=lambda one: (one.extra_cost is None, one.extra_cost)))


def _contrast(served: VisitRequest, planned: int, person: str, side: str, time_limit_s: float) -> Contrast:
    visitees = tuple(replace(visitee, skip_m=None) for visitee in served.visitees)
    only = replace(_reached_from(served, person, side), visitees=visitees)
    try:
        plan = make_plan(only, time_limit_s=time_limit_s)
    except (PlanningFailed, ValueError):  # no way leads there, or none in time
        return Contrast(side, None, None)
    return Contrast(side, plan, plan.cost - planned)


def _reached_from(request: VisitRequest, person: str, side: str) -> VisitRequest:
    """The request with one person reached from that side alone."""

    def open_(spot: Spot) -> bool:
        return spot.place != person or spot.side == side

    return replace(
        request,
        travel={leg: length for leg, length in request.travel.items() if all(map(open_, leg))},
        companies=tuple(
            _overlooked(company, filter(open_, company.overlooks)) for company in request.companies
        ),
    )


def _overlooked(company: Company, spots: Iterable[Spot]) -> Company:
    return replace(company, overlooks={spot: company.overlooks[spot] for spot in spots})
