"""Quick cost of an order of visits: legs from person to person, each from the cheapest sides."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from comity_domain.choices.options import Options
from comity_domain.problem.spot import Way, place_of
from comity_domain.tours.tour import Stop, people_at

FAR = 10**7
"""Leg cost where no route is known, though an object may be fetched in between [cm]."""


class Glance:
    """Ranks orders of visits by a quick cost, a thousand times as fast as their true cost.

    Args:
        choices: The available options.
    """

    def __init__(self, choices: Options) -> None:
        self._choices = choices
        self._least: dict[Way, int] = {}
        for (start, end), cost in choices.legs.items():
            way = place_of(start), end.place
            self._least[way] = min(cost, self._least.get(way, cost))

    def cost(self, stops: Sequence[Stop]) -> int:
        """Minimum legs plus waiting [cm]; greetings cost the same in every order."""
        places = [None, *(stop.person for stop in stops)]
        total, before = 0, 0
        for start, end in pairwise(places):
            total += self._least.get((start, str(end)), FAR)
        for stop in stops:
            people = people_at(stop, self._choices)
            total += before * sum(self._choices.people[name].priority for name in people)
            before += len(people)
        return total
