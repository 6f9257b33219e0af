"""A plan as people see it: whom to visit in which order, on which side, with which greeting."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from comity_domain.greeting import Greeting
from comity_domain.options import Options
from comity_domain.request import START, Spot


@dataclass(frozen=True, slots=True)
class Visit:
    """One person, reached and greeted."""

    spot: Spot
    greeting: Greeting


def best_tour(order: Sequence[str], options: Options) -> tuple[Visit, ...]:
    """The cheapest sides and greetings for this order; ties go to what was inferred, then to the left.

    The planner returns any one of the cheapest plans. This settles which, without a change to order or cost:
    a person meets the side and greeting inferred for them unless another is really cheaper. It also
    improves the plan of a search that was cut off.

    Raises:
        ValueError: No route goes through these people in this order.
    """
    spots = _best_spots(order, options)
    return tuple(Visit(spot, _best_greeting(spot.place, options)) for spot in spots)


def cost_of(spots: Sequence[Spot], options: Options) -> int | None:
    """What the legs from the start through these spots cost, in cm; None where a route is missing."""
    costs = [options.legs.get(leg) for leg in pairwise((START, *spots))]
    known = [cost for cost in costs if cost is not None]
    return sum(known) if len(known) == len(costs) else None


def _best_spots(order: Sequence[str], options: Options) -> tuple[Spot, ...]:
    """Dynamic programming along the order: the best way to every spot of the person reached last."""
    ways: list[tuple[int, int, tuple[Spot, ...]]] = [(0, 0, ())]  # cost, sides not inferred, spots
    for name in order:
        person = options.people[name]
        longer = []
        for spot in person.spots():
            departs = not person.sides[spot.side].inferred
            arrivals = [
                (cost + options.legs[last, spot], departures + departs, (*spots, spot))
                for cost, departures, spots in ways
                if (last := spots[-1] if spots else START, spot) in options.legs
            ]
            longer.extend([min(arrivals)] if arrivals else [])
        ways = longer
    if not ways:
        raise ValueError(f"no route goes through {', '.join(order)} in this order")
    return min(ways)[2]


def _best_greeting(name: str, options: Options) -> Greeting:
    """The cheapest; they are sorted so that the first of equals is the nearest to what was inferred."""
    priced = options.people[name].greetings
    return min(priced, key=lambda greeting: priced[greeting])
