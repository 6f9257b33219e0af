"""A whole order of visits at once: each person is inserted where that seems to cost least without lateness.

It begins with an order that keeps all deadlines, if one is found; the others are inserted by priority.
Otherwise it begins with nobody, and the person with the earliest deadline is inserted first.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from comity_domain.choices.options import Options, PersonOptions
from comity_domain.errors import NoPlan
from comity_domain.labelling.punctual import punctual
from comity_domain.tours.glance import Glance
from comity_domain.tours.lateness import late
from comity_domain.tours.tour import Stop, best_tour, people_at, tour_cost

Stops = tuple[Stop, ...]


def quick_order(choices: Options, *, ends_s: float = math.inf) -> Stops | None:
    """An order for everybody that keeps all deadlines; None where none is found.

    Args:
        choices: What may be chosen.
        ends_s: When the search for an order that keeps all deadlines is cut off, by the machine's clock.
            Inserting is not: it takes 0.1 s for 40 people.

    Raises:
        NoPlan: No order keeps all deadlines.
    """
    first = punctual(choices, ends_s=ends_s)
    if first.stops is None and first.sure:
        raise NoPlan(
            "no order of visits keeps every deadline",
            remedy="Name later deadlines, or ask for less at once, such as fewer people.",
        )
    begun = completed(first.stops, choices) if first.stops else None
    bearer = choices.bearer_of
    return begun or completed(() if bearer is None else (Stop(bearer),), choices)


def completed(start: Sequence[Stop], choices: Options) -> Stops | None:
    """An order for everybody that keeps all deadlines; None where a person fits in nowhere.

    Args:
        start: The order to insert the others into.
        choices: What may be chosen.
    """
    stops, glance = tuple(start), Glance(choices)
    while missing := _missing(stops, choices):
        first = min(missing, key=lambda name: _urgency(choices.people[name]))
        orders = sorted(_with(first, stops, choices, missing), key=glance.cost)
        found = next((order for order in orders if cost_of_order(order, choices) is not None), None)
        if found is None:
            return None
        stops = found
    return None if cost_of_order(stops, choices) is None else stops


def _urgency(person: PersonOptions) -> tuple[float, int]:
    """Less for people who are inserted earlier."""
    return (math.inf if person.by_s is None else person.by_s, -person.priority)


def cost_of_order(stops: Sequence[Stop], choices: Options) -> int | None:
    """What an order costs; None where no route leads through it, or a person is late.

    The same where it does not begin with the person for whom the robot already holds something.
    """
    if choices.bearer_of not in (None, stops[0].person if stops else None):
        return None
    try:
        visits = best_tour(stops, choices)
    except ValueError:
        return None
    return None if late(visits, choices) else tour_cost(visits, choices)


def _missing(stops: Sequence[Stop], choices: Options) -> tuple[str, ...]:
    served = {name for stop in stops for name in people_at(stop, choices)}
    return tuple(name for name in choices.people if name not in served)


def _with(name: str, stops: Stops, choices: Options, missing: Sequence[str]) -> Iterator[Stops]:
    """The order with one visit more, to a person alone or, where all of it is missing, to their company."""
    for company in choices.companies.values():
        if name in company.members and company.spots and set(company.members) <= set(missing):
            for member in dict.fromkeys(spot.place for spot in company.spots):
                yield from _inserted(Stop(member, company.name), stops)
            return
    yield from _inserted(Stop(name), stops)


def _inserted(stop: Stop, stops: Stops) -> Iterator[Stops]:
    for place in range(len(stops) + 1):
        yield (*stops[:place], stop, *stops[place:])
