"""The order of visits if not all paths are measured: measure those of the best plan, and replan.

With lower bounds of path lengths, a plan costs no more than with true lengths. So a cheapest plan whose paths
are all measured is the cheapest of all. When time runs out, the best fully measured plan is taken, and the
last one planned with bounds gives the lower bound. If the search would not be exact, a quickly found order is
measured first, and then each that seems cheaper.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from time import monotonic

from comity_domain.choices.options import Options, options
from comity_domain.errors import NoPlan, PlanningFailed, out_of_time
from comity_domain.labelling.search import MOST_BY_WAYS, MOST_PROVEN, first_look
from comity_domain.ordering.insertion import Stops, quick_order
from comity_domain.ordering.local_search import improved
from comity_domain.ordering.measuring import Measuring
from comity_domain.ordering.none_found import none_found, require_free_hands
from comity_domain.ordering.order import Order
from comity_domain.problem.request import VisitRequest

Search = Callable[[Options, float], Order]
"""A search function of the options and the remaining time [s]."""
SHARE = 0.9
"""Share of the time for the search; the rest is for measuring alternatives to each visit."""
LEAST_S = 0.5
"""Minimum time given to a search [s]."""
LATE_S = 1.0
"""Extra time for finding a first order that keeps all deadlines [s]: late is better than none."""


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
        search: The one that has the last word, for as few people as it can be exact for.
        time_limit_s: For engines and measuring together.
        ends_s: When that is over, by the machine's clock.

    Raises:
        PlanningFailed: There is no plan, or none was found in time.
    """
    if len(request.visitees) > MOST_BY_WAYS:
        return _by_moves(request, time_limit_s, ends_s)
    if request.survey is None:
        choices = options(request)
        return Settled(request, choices, search(choices, time_limit_s))
    return _Settling(request, search, time_limit_s, ends_s).settled()


def _by_moves(request: VisitRequest, time_limit_s: float, ends_s: float) -> Settled:
    """A first order, made cheaper as long as there is time."""
    measuring, search_ends_s = Measuring(request), ends_s - (1.0 - SHARE) * time_limit_s
    require_free_hands(measuring.choices)
    first, in_time = measuring.first_order(ends_s=ends_s + LATE_S)
    if first is None:
        raise none_found(time_limit_s, in_time=in_time)
    measure = partial(measuring.news, ends_s=search_ends_s)
    stops, ended = improved(first, measuring.choices, measure, ends_s=search_ends_s)
    return Settled(measuring.request, measuring.choices, Order(stops, proven=False, reproducible=ended))


class _Settling:
    """The rounds of one search.

    Args:
        request: What was asked; more and more of it is measured.
        search: The one that has the last word.
        time_limit_s: For all.
        ends_s: When that is over, by the machine's clock.
    """

    def __init__(self, request: VisitRequest, search: Search, time_limit_s: float, ends_s: float) -> None:
        self._measuring = Measuring(request)
        self._search = search
        self._limit_s = time_limit_s
        self._last_s = ends_s + LATE_S
        self._ends_s = ends_s - (1.0 - SHARE) * time_limit_s
        self._met: dict[Stops, None] = {}
        """Orders of which all was to be measured that they took when they were the cheapest."""
        self._bound = 0

    def settled(self) -> Settled:
        if len(self._measuring.request.visitees) > MOST_PROVEN:
            self._take_one()
        failure: PlanningFailed = out_of_time(self._limit_s)
        while self._look_ahead():
            choices = self._measuring.choices
            try:
                order = self._search(choices, max(self._ends_s - monotonic(), LEAST_S))
            except NoPlan:
                raise
            except PlanningFailed as failed:
                failure = failed
                break
            self._bound = max(self._bound, order.bound)
            if self._is_measured(order.stops):
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
        return Settled(self._measuring.request, self._measuring.choices, order)

    def _take_one(self) -> None:
        """Measure an order that is found at once; insertion knows of none that is asked for."""
        if self._measuring.choices.has_order:
            return
        first, _ = self._measuring.first_order(ends_s=self._last_s)
        if first is not None:
            self._met[first] = None

    def _look_ahead(self) -> bool:
        """Measure what quick answers take, until there is no more; whether there was time for it."""
        while monotonic() < self._ends_s:
            choices = self._measuring.choices
            try:
                found = first_look(choices, ends_s=self._ends_s)
            except TimeoutError:
                return False
            if found is None and choices.has_order:  # insertion knows of no order
                return monotonic() < self._ends_s
            stops = found.stops if found else quick_order(choices, ends_s=self._ends_s)
            if stops is None:
                return monotonic() < self._ends_s
            if found and found.exact:
                self._bound = max(self._bound, found.cost)
            if self._is_measured(stops):
                return True
        return False

    def _is_measured(self, stops: Stops) -> bool:
        self._met[stops] = None
        return self._measuring.is_measured(stops, ends_s=self._ends_s)

    def _best(self, order: Order) -> Order:
        """The cheapest order that was met, by measured ways alone; what else is said of it is as given."""
        choices = self._measuring.measured_choices if self._met else None
        costs = {
            stops: cost for stops in self._met if choices and (cost := self._measuring.cost(stops, choices))
        }
        best = min(costs, key=lambda stops: costs[stops], default=order.stops)
        return replace(order, stops=best, bound=self._bound)
