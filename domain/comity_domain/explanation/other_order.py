"""The effect of visiting people in another order: additional cost, or who is late."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from comity_domain.choices.options import Options, options
from comity_domain.explanation.what_if import MOST_PEOPLE
from comity_domain.labelling.search import cheapest
from comity_domain.labelling.skipping import served_part
from comity_domain.plans.actions import SKIP
from comity_domain.plans.plan import Plan
from comity_domain.problem.measuring import measured, unmeasured
from comity_domain.problem.request import VisitRequest
from comity_domain.tours.lateness import Late, late
from comity_domain.tours.tour import PlannedVisit, best_tour, farewell_cost, greeting_parts, path


@dataclass(frozen=True, slots=True)
class OtherOrder:
    """The cheapest plan that visits some people in a given order."""

    people: tuple[str, ...]
    """All people reached then, in order."""
    extra_parts: Mapping[str, int]
    """Additional cost by part [cm]; none are 0."""
    too_late: Late | None
    """The missed deadline; None if all are kept."""

    @property
    def extra_cost(self) -> int:
        """Additional cost in plan cost units; negative if missed deadlines make it cheaper."""
        return sum(self.extra_parts.values())


def in_order(request: VisitRequest, plan: Plan, people: Sequence[str]) -> OtherOrder | None:
    """The cheapest plan that reaches some people in an order, with any others in between.

    Args:
        request: The planning request.
        plan: Its plan; people left out by it stay left out.
        people: The people in the order in question; each must be reached, not only greeted with others.

    Returns:
        None if unknown: no other order is possible, or there are too many people.
    """
    request = served_part(request, plan)
    order = [name for name in people if any(each.name == name for each in request.visitees)]
    if len(request.visitees) > MOST_PEOPLE:
        return None
    loosened = (_cheapest(each, order) for each in _with_fewer_deadlines(request, order))
    found = next((one for one in loosened if one is not None), None)
    if found is None:
        return None
    visits, rest = found
    timed = replace(rest, visitees=request.visitees)
    choices = options(measured(timed, unmeasured(timed, path(visits, options(timed)))))
    people_reached = tuple(visit.spot.place for visit in visits)
    return OtherOrder(people_reached, _extra(visits, choices, plan), late(visits, choices))


def _with_fewer_deadlines(request: VisitRequest, order: Sequence[str]) -> Iterator[VisitRequest]:
    """The request; then without one deadline, of those whom the order names first; then without any."""
    yield request
    hurried = [each.name for each in request.visitees if each.by_s is not None]
    singles = [(name,) for name in sorted(hurried, key=lambda name: name not in order)]
    for names in (*singles, tuple(hurried)) if len(hurried) > 1 else singles:
        visitees = (replace(each, by_s=None) if each.name in names else each for each in request.visitees)
        yield replace(request, visitees=tuple(visitees))


def _cheapest(
    request: VisitRequest, order: Sequence[str]
) -> tuple[tuple[PlannedVisit, ...], VisitRequest] | None:
    """The visits, and the request with all measured that they take."""
    while True:
        choices = options(request)
        found = cheapest(choices, order=order)
        if found is None:
            return None
        visits = best_tour(found.stops, choices)
        missing = unmeasured(request, path(visits, choices))
        if not missing:
            return visits, request
        request = measured(request, missing)


def _extra(visits: Sequence[PlannedVisit], choices: Options, plan: Plan) -> dict[str, int]:
    """By part, what the visits cost more than those of a plan."""
    before = _summed(step.cost_parts for step in plan.steps if step.action != SKIP)
    legs = (choices.leg_parts(start, end) for start, end in pairwise(path(visits, choices)))
    farewells = ({"farewell": farewell_cost(visit, choices)} for visit in visits)
    now = _summed((*legs, *greeting_parts(visits, choices), *farewells))
    parts = {part: now[part] - before[part] for part in {**now, **before}}
    return {part: extra for part, extra in parts.items() if extra}


def _summed(parts: Iterable[Mapping[str, int]]) -> Counter[str]:
    total = Counter[str]()
    for each in parts:
        total.update(each)
    return total
