"""The order of visits where not all ways are measured: measure what the best plan takes, and plan again.

Planned with bounds, a plan costs no more than with lengths. A cheapest plan all of whose ways are measured is
therefore the cheapest of all. When time runs out, the best of those plans is taken whose ways are measured,
and no plan costs less than the last that was planned with bounds. Among many people an order that is found at
once is measured first, so that there is one.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from time import monotonic

from comity_domain.choices.options import Options, options
from comity_domain.errors import NoPlan, PlanningFailed, out_of_time
from comity_domain.labelling.punctual import is_punctual
from comity_domain.labelling.search import MOST_PROVEN, first_look
from comity_domain.ordering.insertion import cost_of_order, quick_order
from comity_domain.ordering.order import Order
from comity_domain.problem.request import VisitRequest
from comity_domain.problem.survey import Unmeasured, measured, unmeasured_legs, unmeasured_ways
from comity_domain.tours.lateness import until_last_deadline
from comity_domain.tours.tour import Stop, best_tour, path

Search = Callable[[Options, float], Order]
"""A search: what may be chosen, and the seconds that are left."""
SHARE = 0.9
"""Of the time; the rest is for measuring what else each visit could be like."""
LEAST_S = 0.5
"""Even where time is over a search is given so much."""
LATE_S = 1.0
"""So much longer a first plan is looked for: late is better than none."""


@dataclass(frozen=True, slots=True)
class Settled:
    """An order with the request of which all is measured that it takes."""

    request: VisitRequest
    choices: Options
    """All that it may choose from, bounds included."""
    order: Order


def settled(request: VisitRequest, search: Search, *, time_limit_s: float, ends_s: float) -> Settled:
    """The stops of the best plan.

    Args:
        request: What was asked.
        search: The one that has the last word.
        time_limit_s: For engines and measuring together.
        ends_s: When that is over, by the machine's clock.

    Raises:
        PlanningFailed: There is no plan, or none was found in time.
    """
    if request.survey is None:
        choices = options(request)
        return Settled(request, choices, search(choices, time_limit_s))
    return _Settling(request, search, time_limit_s, ends_s).settled()


def measured_options(choices: Options, request: VisitRequest) -> Options:
    """Of what may be chosen for a request, that by measured ways alone."""
    if request.survey is None:
        return choices
    bounds = request.survey.legs
    return replace(choices, legs={leg: cost for leg, cost in choices.legs.items() if leg not in bounds})


class _Settling:
    """The rounds of one search.

    Args:
        request: What was asked; more and more of it is measured.
        search: The one that has the last word.
        time_limit_s: For all.
        ends_s: When that is over, by the machine's clock.
    """

    def __init__(self, request: VisitRequest, search: Search, time_limit_s: float, ends_s: float) -> None:
        self._request = request
        self._search = search
        self._limit_s = time_limit_s
        self._last_s = ends_s + LATE_S
        self._ends_s = ends_s - (1.0 - SHARE) * time_limit_s
        self._met: dict[tuple[Stop, ...], None] = {}
        """Orders of which all was to be measured that they took when they were the cheapest."""
        self._bound = 0
        self._spelt_out: tuple[VisitRequest, Options] | None = None

    @property
    def _choices(self) -> Options:
        """What may be chosen now: spelt out once, until more is measured."""
        if self._spelt_out is None or self._spelt_out[0] is not self._request:
            self._spelt_out = (self._request, options(self._request))
        return self._spelt_out[1]

    def settled(self) -> Settled:
        if len(self._request.visitees) > MOST_PROVEN:
            self._take_one()
        failure: PlanningFailed = out_of_time(self._limit_s)
        while self._look_ahead():
            choices = self._choices
            try:
                order = self._search(choices, max(self._ends_s - monotonic(), LEAST_S))
            except NoPlan:
                raise
            except PlanningFailed as failed:
                failure = failed
                break
            self._bound = max(self._bound, order.bound)
            if self._is_measured(order.stops, choices, self._ends_s):
                return self._settled(order if order.proven else self._best(order))
        cut_off = Order((), proven=False, reproducible=False)
        best = self._best(cut_off)
        if not best.stops:
            self._take_one()
            best = self._best(cut_off)
        if not best.stops:
            raise failure
        return self._settled(best)

    def _settled(self, order: Order) -> Settled:
        return Settled(self._request, self._choices, order)

    def _take_one(self) -> None:
        """Measure an order that is found at once, until one stands."""
        while monotonic() < self._last_s:
            choices = self._choices
            stops = quick_order(choices, ends_s=self._last_s)
            if stops is None:
                return
            news = not self._is_measured(stops, choices, self._last_s)
            if not news or self._cost(stops, self._measured_choices) is not None:
                return

    def _look_ahead(self) -> bool:
        """Measure what quick answers take, until there is no more; whether there was time for it."""
        while monotonic() < self._ends_s:
            choices = self._choices
            try:
                found = first_look(choices, ends_s=self._ends_s)
            except TimeoutError:
                return False
            stops = found.stops if found else quick_order(choices, ends_s=self._ends_s)
            if stops is None:
                return monotonic() < self._ends_s
            if found and found.exact:
                self._bound = max(self._bound, found.cost)
            if self._is_measured(stops, choices, self._ends_s):
                return True
        return False

    def _is_measured(self, stops: tuple[Stop, ...], choices: Options, ends_s: float) -> bool:
        """Whether all that an order takes is measured; what is not is now, as far as there is time.

        First what deadlines hang on, and no more where that makes somebody late.
        """
        missing = self._missing(stops, choices)
        self._met[stops] = None
        if missing.ways:
            self._request = measured(self._request, Unmeasured(ways=missing.ways), ends_s=ends_s)
            if not is_punctual(stops, self._choices):
                return False
        self._request = measured(self._request, Unmeasured(missing.legs), ends_s=ends_s)
        return not missing

    def _best(self, order: Order) -> Order:
        """The cheapest order that was met, by measured ways alone; what else is said of it is as given."""
        choices = self._measured_choices if self._met else None
        costs = {stops: cost for stops in self._met if choices and (cost := self._cost(stops, choices))}
        best = min(costs, key=lambda stops: costs[stops], default=order.stops)
        return replace(order, stops=best, bound=self._bound)

    @property
    def _measured_choices(self) -> Options:
        return measured_options(self._choices, self._request)

    def _cost(self, stops: tuple[Stop, ...], choices: Options) -> int | None:
        """What an order costs; None where it takes what is not measured, or somebody waits too long."""
        cost = cost_of_order(stops, choices)
        return None if cost is None or self._missing(stops, choices) else cost

    def _missing(self, stops: tuple[Stop, ...], choices: Options) -> Unmeasured:
        """What is not measured of what an order takes, and what its deadlines hang on."""
        visits = best_tour(stops, choices)
        legs = unmeasured_legs(self._request, path(visits, choices))
        ways = unmeasured_ways(self._request, path(until_last_deadline(visits, choices), choices))
        return replace(legs, ways=ways.ways)
