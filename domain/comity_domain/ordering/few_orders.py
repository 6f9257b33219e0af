"""The order of few visits without a search: all orders are looked at, and one of them alone is the cheapest.

An optimal engine can then find no other, so that the plan is the same, and known without starting one.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain, permutations, product

from comity_domain.choices.companies import CompanyOptions
from comity_domain.choices.options import Options
from comity_domain.ordering.order import Order
from comity_domain.tours.tour import Stop, best_tour, tour_cost

EVERY_ORDER = "every-order"
"""The name of this engine."""
MOST_PEOPLE = 5
"""120 orders; an engine has started before many more are looked at."""


def only_cheapest(options: Options) -> Order | None:
    """The order that is cheaper than every other; None where several are, or it would take long."""
    if len(options.people) > MOST_PEOPLE:
        return None
    if options.has_deadlines or options.has_priorities or options.under_way:
        return None
    costs = {stops: cost for stops in _orders(options) if (cost := _cost(stops, options)) is not None}
    if not costs:
        return None
    least = min(costs.values())
    best = [stops for stops, cost in costs.items() if cost == least]
    if len(best) > 1:
        return None
    return Order(EVERY_ORDER, best[0], proven=True, reproducible=True, bound=least)


def _orders(options: Options) -> Iterator[tuple[Stop, ...]]:
    in_company = {name for company in options.companies.values() for name in company.members}
    alone = [Stop(name) for name in options.people if name not in in_company]
    for stops in product(*map(_greeted, options.companies.values())):
        yield from permutations((*alone, *chain(*stops)))


def _greeted(company: CompanyOptions) -> Iterator[tuple[Stop, ...]]:
    """Its members one by one, or all of them at once beside any of them."""
    yield tuple(map(Stop, company.members))
    yield from ((Stop(member, company.name),) for member in company.members)


def _cost(stops: tuple[Stop, ...], options: Options) -> int | None:
    try:
        return tour_cost(best_tour(stops, options), options)
    except ValueError:
        return None
