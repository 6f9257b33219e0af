"""What else a group that is greeted at once could be met like: from elsewhere, or one by one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import permutations

from comity_domain.options import Options
from comity_domain.request import Spot
from comity_domain.tour import Stop, Visit, best_tour, tour_cost

MOST_ORDERS_OF = 4
"""Members whose every order is looked at; of more only the one in which they are named, and back."""

Tour = tuple[Visit, ...]


def from_elsewhere(index: int, visits: Sequence[Visit], options: Options) -> Iterator[tuple[Spot, Tour]]:
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


def one_by_one(index: int, visits: Sequence[Visit], options: Options) -> Tour | None:
    """The cheapest tour that greets the members one after the other in the group's place; None: none does.

    Args:
        index: The visit to the group.
        visits: All.
        options: What may be chosen.
    """
    stops = [Stop(visit.spot.place, visit.company, visit.bringing) for visit in visits]
    company = visits[index].company
    assert company is not None
    found: dict[Tour, int] = {}
    for members in _orders(options.companies[company].members):
        try:
            tour = best_tour((*stops[:index], *map(Stop, members), *stops[index + 1 :]), options)
        except ValueError:
            continue
        if (cost := tour_cost(tour, options)) is not None:
            found[tour] = cost
    return min(found, key=lambda tour: found[tour], default=None)


def _orders(members: Sequence[str]) -> Iterator[tuple[str, ...]]:
    if len(members) <= MOST_ORDERS_OF:
        return permutations(members)
    return iter((tuple(members), tuple(reversed(members))))
