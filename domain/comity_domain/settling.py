"""The order of visits where not all ways are measured: measure what the best plan takes, and plan again.

Planned with bounds, a plan costs no more than with lengths. A cheapest plan all of whose ways are measured is
therefore the cheapest of all. When time runs out, the best of those plans is taken whose ways are measured,
and no plan costs less than the last that was planned with bounds.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from time import monotonic

from comity_domain.errors import NoPlan, PlanningFailed, out_of_time
from comity_domain.insertion import cost_of_order, quick_order
from comity_domain.label_search import (
    LABELS,
    first_look,
)
from comity_domain.options import Options, options
from comity_domain.order import Order
from comity_domain.request import VisitRequest
from comity_domain.survey import measured, unmeasured
from comity_domain.together import from_elsewhere, one_by_one
from comity_domain.tour import Stay, Stop, Visit, best_tour, path, stays

Search = Callable[[Options, float], Order]
"""An engine: what may be chosen, and the seconds that are left."""
SHARE = 0.9
"""Of the time; the rest is for measuring what else each visit could be like."""
LEAST_S = 0.5
"""Even where time is over an engine is given so much."""


@dataclass(frozen=True, slots=True)
class Settled:
    """An order with the request of which all is measured that it takes."""

    request: VisitRequest
    order: Order


def settled(request: VisitRequest, search: Search, *, time_limit_s: float, ends_s: float) -> Settled:
    """The stops of the best plan.

    Args:
        request: What was asked.
        search: The engine that has the last word.
        time_limit_s: For engines and measuring together.
        ends_s: When that is over, by the machine's clock.

    Raises:
        PlanningFailed: There is no plan, or none was found in time.
    """
    if request.survey is None:
        return Settled(request, search(options(request), time_limit_s))
    return _Settling(request, search, ends_s - (1.0 - SHARE) * time_limit_s).settled(time_limit_s)


def measured_options(request: VisitRequest) -> Options:
    """What may be chosen by measured ways alone."""
    choices = options(request)
    if request.survey is None:
        return choices
    bounds = request.survey.legs
    return replace(choices, legs={leg: cost for leg, cost in choices.legs.items() if leg not in bounds})


def measured_around(
    request: VisitRequest, visits: Sequence[Visit], *, ends_s: float = math.inf
) -> tuple[VisitRequest, bool]:
    """The request with all measured that one visit made otherwise would take; and whether there was time.

    Args:
        request: What was asked.
        visits: The plan; each of its stops is looked at with every other way to make it.
        ends_s: When there is no more time, by the machine's clock; what is left then stays a bound.
    """
    if request.survey is None:
        return request, True
    choices = options(request)
    for index, visit in enumerate(visits):
        for stay in stays(Stop(visit.spot.place, visit.company), choices):
            if monotonic() > ends_s:
                return request, False
            before, after = visits[max(0, index - 1) : index], visits[index + 1 : index + 2]
            tour: tuple[Stay | Visit, ...] = (*before, stay, *after)
            spots = path(tour, choices)
            request = measured(request, unmeasured(request, spots if index < 2 else spots[1:]))
        if visit.company is not None:
            request, in_time = _measured_otherwise(request, index, visits, ends_s)
            if not in_time:
                return request, False
    return request, True


def _measured_otherwise(
    request: VisitRequest, index: int, visits: Sequence[Visit], ends_s: float
) -> tuple[VisitRequest, bool]:
    """The request with all measured that a group met from elsewhere, or one by one, would take."""
    choices = options(request)
    for _, tour in from_elsewhere(index, visits, choices):
        if monotonic() > ends_s:
            return request, False
        request = measured(request, unmeasured(request, path(tour, choices)))
    while monotonic() <= ends_s:
        choices = options(request)
        each = one_by_one(index, visits, choices)
        missing = unmeasured(request, path(each, choices)) if each else None
        if not missing:
            return request, True
        request = measured(request, missing)
    return request, False


class _Settling:
    """The rounds of one search.

    Args:
        request: What was asked; more and more of it is measured.
        search: The engine that has the last word.
        ends_s: When there is no more time, by the machine's clock.
    """

    def __init__(self, request: VisitRequest, search: Search, ends_s: float) -> None:
        self._request = request
        self._search = search
        self._ends_s = ends_s
        self._met: dict[tuple[Stop, ...], None] = {}
        """Orders of which all was measured that they took when they were the cheapest."""
        self._bound = 0

    def settled(self, time_limit_s: float) -> Settled:
        failure: PlanningFailed = out_of_time(time_limit_s)
        while self._look_ahead():
            choices = options(self._request)
            try:
                order = self._search(choices, max(self._ends_s - monotonic(), LEAST_S))
            except NoPlan:
                raise
            except PlanningFailed as failed:
                failure = failed
                break
            self._bound = max(self._bound, order.bound)
            if self._is_measured(order.stops, choices):
                return Settled(self._request, order if order.proven else self._best(order))
        cut_off = Order(LABELS, (), proven=False, reproducible=False)
        best = self._best(cut_off)
        if not best.stops and self._finds_any(monotonic() + time_limit_s):
            best = self._best(cut_off)
        if not best.stops:
            raise failure
        return Settled(self._request, best)

    def _finds_any(self, ends_s: float) -> bool:
        """Whether a quick order stands once measured, in as much time again: late is better than none."""
        while monotonic() < ends_s:
            choices = options(self._request)
            stops = quick_order(choices)
            if stops is None:
                return False
            if self._is_measured(stops, choices):
                return True
        return False

    def _look_ahead(self) -> bool:
        """Measure what quick answers take, until there is no more; whether there was time for it."""
        while monotonic() < self._ends_s:
            choices = options(self._request)
            found = first_look(choices)
            stops = found.stops if found else quick_order(choices)
            if stops is None:
                return True
            if found and found.exact:
                self._bound = max(self._bound, found.cost)
            if self._is_measured(stops, choices):
                return True
        return False

    def _is_measured(self, stops: tuple[Stop, ...], choices: Options) -> bool:
        """Whether all that an order takes is measured; what is not is now."""
        missing = unmeasured(self._request, path(best_tour(stops, choices), choices))
        self._met[stops] = None
        self._request = measured(self._request, missing)
        return not missing

    def _best(self, order: Order) -> Order:
        """The cheapest order that was met, by measured ways alone; what else is said of it is as given."""
        choices = measured_options(self._request) if self._met else None
        costs = {stops: cost for stops in self._met if choices and (cost := self._cost(stops, choices))}
        best = min(costs, key=lambda stops: costs[stops], default=order.stops)
        engine = order.engine if best == order.stops else LABELS
        return replace(order, engine=engine, stops=best, bound=self._bound)

    def _cost(self, stops: tuple[Stop, ...], choices: Options) -> int | None:
        """What an order costs; None where it takes what is not measured, or somebody waits too long."""
        cost = cost_of_order(stops, choices)
        if cost is None or unmeasured(self._request, path(best_tour(stops, choices), choices)):
            return None
        return cost
