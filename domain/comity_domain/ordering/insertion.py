"""A whole order of visits at once, where the label search has lost all that keep the deadlines.

Begun with an order that greets everybody with a deadline in time; everybody else is put where they seem
to cost least without making anybody late, whoever is worth most first. One stop at a time is then moved
elsewhere while that saves anything, as in what the label search finds where it proves nothing.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from time import monotonic

from comity_domain.choices.options import Options
from comity_domain.errors import NoPlan
from comity_domain.labelling.punctual import punctual
from comity_domain.tours.glance import Glance
from comity_domain.tours.lateness import late
from comity_domain.tours.tour import Stop, best_tour, people_at, tour_cost

Stops = tuple[Stop, ...]

MOST_ORDERS = 2_500
"""Looked at to make one better, a millisecond each: of 25 stops each is put everywhere a few times."""


def quick_order(choices: Options, *, ends_s: float = math.inf) -> Stops | None:
    """An order for everybody that keeps all deadlines; None where none is found.

    Args:
        choices: What may be chosen.
        ends_s: When it is looked for no longer, by the machine's clock.

    Raises:
        NoPlan: No order keeps all deadlines.
    """
    first = punctual(choices, ends_s=ends_s)
    if first.stops is None and first.sure:
        raise NoPlan(
            "no order of visits keeps every deadline",
            remedy="Name later deadlines, or ask for less at once, such as fewer people.",
        )
    return None if first.stops is None else completed(first.stops, choices, ends_s=ends_s)


def completed(start: Sequence[Stop], choices: Options, *, ends_s: float = math.inf) -> Stops | None:
    """An order for everybody that keeps all deadlines; None where somebody fits in nowhere.

    Args:
        start: An order that greets everybody with a deadline in time.
        choices: What may be chosen.
        ends_s: When the answer is None, by the machine's clock.
    """
    stops, glance = tuple(start), Glance(choices)
    while missing := _missing(stops, choices):
        first = max(missing, key=lambda name: choices.people[name].priority)
        orders = sorted(_with(first, stops, choices, missing), key=glance.cost)
        longer = (order for order in orders if cost_of_order(order, choices) is not None)
        if monotonic() > ends_s or (found := next(longer, None)) is None:
            return None
        stops = found
    return stops


def improved(stops: Stops, choices: Options, *, ends_s: float = math.inf) -> tuple[Stops, bool]:
    """The order after moving single stops while that saves anything; and whether there was time to end.

    Args:
        stops: An order that keeps all deadlines.
        choices: What may be chosen.
        ends_s: When the first answer has to do, by the machine's clock.
    """
    cost, in_vain = cost_of_order(stops, choices), 0
    for turn in range(MOST_ORDERS // max(1, len(stops))):
        if cost is None or in_vain == len(stops):
            break
        if monotonic() > ends_s:
            return stops, False
        place = turn % len(stops)
        rest = (*stops[:place], *stops[place + 1 :])
        moved = _cheapest(_inserted(stops[place], rest), choices)
        better = None if moved is None else cost_of_order(moved, choices)
        in_vain += 1
        if moved is not None and better is not None and better < cost:
            stops, cost, in_vain = moved, better, 0
    return stops, True


def cost_of_order(stops: Sequence[Stop], choices: Options) -> int | None:
    """What an order costs; None where no route leads through it, or somebody is late."""
    try:
        visits = best_tour(stops, choices)
    except ValueError:
        return None
    return None if late(visits, choices) else tour_cost(visits, choices)


def _missing(stops: Sequence[Stop], choices: Options) -> tuple[str, ...]:
    served = {name for stop in stops for name in people_at(stop, choices)}
    return tuple(name for name in choices.people if name not in served)


def _with(name: str, stops: Stops, choices: Options, missing: Sequence[str]) -> Iterator[Stops]:
    """The order with one visit more, to somebody alone or, where all of it is missing, to their company."""
    for company in choices.companies.values():
        if name in company.members and company.spots and set(company.members) <= set(missing):
            for member in dict.fromkeys(spot.place for spot in company.spots):
                yield from _inserted(Stop(member, company.name), stops)
            return
    yield from _inserted(Stop(name), stops)


def _inserted(stop: Stop, stops: Stops) -> Iterator[Stops]:
    for place in range(len(stops) + 1):
        yield (*stops[:place], stop, *stops[place:])


def _cheapest(orders: Iterable[Stops], choices: Options) -> Stops | None:
    costs = {order: cost for order in orders if (cost := cost_of_order(order, choices)) is not None}
    return min(costs, key=lambda order: costs[order], default=None)
