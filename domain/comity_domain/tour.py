"""A plan as people see it: where the robot stops in which order, on which side, with which greeting."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

from comity_domain.options import Options
from comity_domain.request import GREETING_S, START, Spot, place_of


@dataclass(frozen=True, slots=True)
class Stop:
    """Whom the robot reaches, and whether it greets their company at once."""

    person: str
    company: str | None = None


@dataclass(frozen=True, slots=True)
class Visit:
    """A stop with its choices."""

    spot: Spot
    company: str | None
    way: tuple[str, str]
    """The modality and the gesture of the greeting."""


def best_tour(order: Sequence[Stop], options: Options) -> tuple[Visit, ...]:
    """The cheapest sides and greetings for this order; ties go to what was inferred, then to the left.

    The planner returns any one of the cheapest plans. This settles which, without a change to order or cost:
    a person meets the side and greeting inferred for them unless another is really cheaper. It also
    improves the plan of a search that was cut off.

    Raises:
        ValueError: No route goes through these stops in this order.
    """
    spots = _best_spots(order, options)
    return tuple(
        Visit(spot, stop.company, best_way(stop, options)) for spot, stop in zip(spots, order, strict=True)
    )


def best_way(stop: Stop, options: Options) -> tuple[str, str]:
    """The cheapest greeting at a stop."""
    if stop.company is None:
        return options.people[stop.person].best_greeting.way
    return options.companies[stop.company].best_greeting


def served(visit: Visit, options: Options) -> tuple[str, ...]:
    """Who is greeted in a visit, whoever was reached first."""
    reached = visit.spot.place
    if visit.company is None:
        return (reached,)
    return (reached, *(name for name in options.companies[visit.company].members if name != reached))


def greeting_parts(visits: Sequence[Visit], options: Options) -> list[Mapping[str, int]]:
    """What the cost of each greeting is made of, in cm.

    `greeting`: the dislike of it. `nearness`: the dislike of how near others of a company stand. `waiting`:
    that others were greeted before.
    """
    parts: list[Mapping[str, int]] = []
    before = 0
    for visit in visits:
        people = served(visit, options)
        waiting = before * sum(options.people[name].priority for name in people)
        near = 0 if visit.company is None else options.companies[visit.company].spots[visit.spot]
        own = greeting_cost(visit, options) - near
        parts.append({"greeting": own, "nearness": near, "waiting": waiting})
        before += len(people)
    return parts


def greeting_cost(visit: Visit, options: Options) -> int:
    """The dislike of one greeting, and of how near others stand to it."""
    if visit.company is not None:
        return options.companies[visit.company].cost(visit.spot, visit.way)
    priced = options.people[visit.spot.place].greetings
    return next(price for greeting, price in priced.items() if greeting.way == visit.way)


def cost_of(spots: Sequence[Spot], options: Options) -> int | None:
    """What the legs from the start through these spots cost, in cm; None where a route is missing."""
    costs = [options.legs.get(leg) for leg in pairwise((START, *spots))]
    known = [cost for cost in costs if cost is not None]
    return sum(known) if len(known) == len(costs) else None


def tour_cost(visits: Sequence[Visit], options: Options) -> int | None:
    """What all of it costs; None where an option of it is not on offer."""
    legs = cost_of([visit.spot for visit in visits], options)
    if legs is None or any(not _is_offered(visit, options) for visit in visits):
        return None
    return legs + sum(sum(parts.values()) for parts in greeting_parts(visits, options))


def end_times_s(visits: Sequence[Visit], options: Options) -> list[float]:
    """When each greeting is over, as deadlines reckon it; needs durations."""
    times, now, here = [], 0.0, START
    for visit in visits:
        now += options.durations_s[place_of(here), visit.spot.place] + GREETING_S
        here = visit.spot
        times.append(now)
    return times


def _is_offered(visit: Visit, options: Options) -> bool:
    if visit.company is not None:
        company = options.companies[visit.company]
        return visit.spot in company.spots and visit.way in company.greetings
    return any(greeting.way == visit.way for greeting in options.people[visit.spot.place].greetings)


def _best_spots(order: Sequence[Stop], options: Options) -> tuple[Spot, ...]:
    """Dynamic programming along the order: the best way to every spot of the person reached last."""
    ways: list[tuple[int, int, tuple[Spot, ...]]] = [(0, 0, ())]  # cost, sides not inferred, spots
    for stop in order:
        person = options.people[stop.person]
        longer = []
        for spot in person.spots():
            near = 0 if stop.company is None else options.companies[stop.company].spots.get(spot)
            departs = not person.sides[spot.side].inferred
            arrivals = [
                (cost + options.legs[last, spot] + near, departures + departs, (*spots, spot))
                for cost, departures, spots in ways
                if near is not None and (last := spots[-1] if spots else START, spot) in options.legs
            ]
            longer.extend([min(arrivals)] if arrivals else [])
        ways = longer
    if not ways:
        names = ", ".join(stop.person for stop in order)
        raise ValueError(f"no route goes through {names} in this order")
    return min(ways)[2]
