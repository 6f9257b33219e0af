"""What else a group that is greeted at once could be met like: from elsewhere, or one by one."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import permutations

from comity_domain.choices.options import Options
from comity_domain.problem.spot import Spot
from comity_domain.tours.lateness import late
from comity_domain.tours.tour import PlannedVisit, Stop, best_tour, tour_cost

MOST_ORDERS_OF = 4
"""Members whose every order is looked at; of more only as they are named, back, and by deadlines."""

Tour = tuple[PlannedVisit, ...]


def from_elsewhere(
    index: int, visits: Sequence[PlannedVisit], options: Options
) -> Iterator[tuple[Spot, Tour]]:
    """The tours in which the group is greeted from another place, before any of them, all else being alike.

    Args:
        index: The visit to the group.
        visits: All.
        options: What may be chosen.
    """
    visit = visits[index]
    assert visit.company is not None
    for spot in options.companies[visit.company].spots:
        if spot != visit.spot:
            yield spot, (*visits[:index], replace(visit, spot=spot), *visits[index + 1 :])


def one_by_one(index: int, visits: Sequence[PlannedVisit], options: Options) -> Tour | None:
    """The cheapest tour that greets the members one after the other in the group's place; None: none does.

    It keeps all deadlines wherever one that is looked at does.

    Args:
        index: The visit to the group.
        visits: All.
        options: What may be chosen.
    """
    stops = [visit.stop for visit in visits]
    company = visits[index].company
    assert company is not None
    found: dict[Tour, tuple[bool, int]] = {}
    for members in _orders(options.companies[company].members, options):
        try:
            tour = best_tour((*stops[:index], *map(Stop, members), *stops[index + 1 :]), options)
        except ValueError:
            continue
        if (cost := tour_cost(tour, options)) is not None:
            found[tour] = late(tour, options) is not None, cost
    return min(found, key=lambda tour: found[tour], default=None)


def _orders(members: Sequence[str], options: Options) -> Iterator[tuple[str, ...]]:
    if len(members) <= MOST_ORDERS_OF:
        return permutations(members)
    deadlines = ((options.people[name].by_s, name) for name in members)
    hurried = sorted((math.inf if by_s is None else by_s, name) for by_s, name in deadlines)
    return iter((tuple(members), tuple(reversed(members)), tuple(name for _, name in hurried)))
