"""Greetings of a whole group at once, with their costs."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from comity_domain.choices.cost import dislike_cost
from comity_domain.choices.greeting import Greeting
from comity_domain.choices.ties import tie_break
from comity_domain.problem.request import Company, Weights
from comity_domain.problem.setting import is_setting
from comity_domain.problem.spot import Nearness, Spot
from comity_fis.defuzzification.curve import Choice
from comity_fis.inference.value import Inference

Offers = Mapping[str, Mapping[Greeting, int]]
"""By person, the cost of every greeting that is possible for them [cm]."""

Words = tuple[str, str]
"""The modality and the gesture of a greeting."""


@dataclass(frozen=True, slots=True)
class CompanyOptions:
    """The greeting options of one group; empty if its members have no greeting in common."""

    name: str
    members: tuple[str, ...]
    spots: Mapping[Spot, int]
    """Possible robot positions, with the cost of coming nearer to the others than they like [cm]."""
    greetings: Mapping[Words, int]
    """Greetings that all accept, with their cost for the member they suit least, counted once [cm]. Sorted by
    cost, then by tie-break."""
    spot_ties: Mapping[Spot, int] = field(default_factory=dict)
    """Tie-break between positions of equal cost (`choices.ties`); 0 if there is no entry."""
    greeting_ties: Mapping[Words, int] = field(default_factory=dict)
    """Tie-break between greetings of equal cost."""

    @property
    def best_greeting(self) -> Words:
        """The cheapest greeting, after tie-breaking."""
        return next(iter(self.greetings))

    def cost(self, spot: Spot, way: Words) -> int:
        """Cost of greeting all of them from a position [cm]."""
        return self.spots[spot] + self.greetings[way]

    def tie_break(self, spot: Spot) -> int:
        """Tie-break between positions of equal cost, with the best greeting."""
        return self.spot_ties.get(spot, 0) + self.greeting_ties.get(self.best_greeting, 0)


def company_options(
    company: Company,
    open_spots: Collection[Spot],
    values: Mapping[str, Inference],
    offers: Offers,
    weights: Weights,
) -> CompanyOptions:
    """The options of a group: greetings that all members accept, from positions that they accept."""
    greetings, ranks = _common([offers[member] for member in company.members])
    spots = {
        spot: price
        for spot, nearness in company.overlooks.items()
        if greetings
        and spot in open_spots
        and (price := _nearness_cost(nearness, values, weights)) is not None
    }
    near = {spot: sum(map(tie_break, _desirabilities(company.overlooks[spot], values))) for spot in spots}
    ties = {way: rank[0] for way, rank in ranks.items()}
    return CompanyOptions(company.name, company.members, spots, greetings, near, ties)


def _common(
    offers: Sequence[Mapping[Greeting, int]],
) -> tuple[Mapping[Words, int], Mapping[Words, tuple[int, int, str, str]]]:
    """Greetings that everyone accepts with their highest cost, and each with its worst rank."""
    by_words = [{greeting.way: (greeting, price) for greeting, price in prices.items()} for prices in offers]
    everyones = [way for way in by_words[0] if all(way in accepted for accepted in by_words)]
    prices = {way: max(accepted[way][1] for accepted in by_words) for way in everyones}
    ranks = {way: max(accepted[way][0].rank for accepted in by_words) for way in everyones}
    return {way: prices[way] for way in sorted(everyones, key=lambda way: (prices[way], ranks[way]))}, ranks


def _nearness_cost(nearness: Nearness, values: Mapping[str, Inference], weights: Weights) -> int | None:
    """Cost of standing nearer to others than they like [cm]; None: nearer than a person asked for.

    Standing farther away costs nothing: the robot speaks to the group, not to each person.
    """
    for name, distance_m in nearness.items():
        wanted = values[name]["conversational_distance"]
        if distance_m < wanted.number and is_setting(wanted):
            return None
    return sum(dislike_cost(each, weights.side_m) for each in _desirabilities(nearness, values))


def _desirabilities(nearness: Nearness, values: Mapping[str, Inference]) -> Iterator[float]:
    """Of the distances to those who are stood nearer to than suits them, in [0, 1]."""
    for name, distance_m in nearness.items():
        wanted = values[name]["conversational_distance"]
        if distance_m < wanted.number:
            assert not isinstance(wanted.desirability, Choice)
            yield wanted.desirability(distance_m)
