"""How people who stand together can be greeted at once, and at what price."""

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
"""By person, the price of every greeting that is possible for them."""

Words = tuple[str, str]
"""The modality and the gesture of a greeting."""


@dataclass(frozen=True, slots=True)
class CompanyOptions:
    """How one company may be greeted; nothing on offer where its members have no greeting in common."""

    name: str
    members: tuple[str, ...]
    spots: Mapping[Spot, int]
    """Where the robot may stand, with the price in cm of coming nearer to the others than they like."""
    greetings: Mapping[Words, int]
    """What all accept, with the price: once, what it is worth to the member it suits least. Sorted by price,
    equal prices by the law of ties."""
    spot_ties: Mapping[Spot, int] = field(default_factory=dict)
    """What decides between spots of equal price (`choices.ties`); 0 where there is no entry."""
    greeting_ties: Mapping[Words, int] = field(default_factory=dict)
    """The same of greetings."""

    @property
    def best_greeting(self) -> Words:
        """The cheapest one, by the law of ties."""
        return next(iter(self.greetings))

    def cost(self, spot: Spot, way: Words) -> int:
        """What a greeting of all of them from a spot costs."""
        return self.spots[spot] + self.greetings[way]

    def tie_break(self, spot: Spot) -> int:
        """What decides between spots of equal cost, with the best greeting."""
        return self.spot_ties.get(spot, 0) + self.greeting_ties.get(self.best_greeting, 0)


def company_options(
    company: Company,
    open_spots: Collection[Spot],
    values: Mapping[str, Inference],
    offers: Offers,
    weights: Weights,
) -> CompanyOptions:
    """The greetings that all members accept, and those of the open spots that they do."""
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
    """The greetings that everybody accepts, with the highest price; and each with its worst rank."""
    by_words = [{greeting.way: (greeting, price) for greeting, price in prices.items()} for prices in offers]
    everyones = [way for way in by_words[0] if all(way in accepted for accepted in by_words)]
    prices = {way: max(accepted[way][1] for accepted in by_words) for way in everyones}
    ranks = {way: max(accepted[way][0].rank for accepted in by_words) for way in everyones}
    return {way: prices[way] for way in sorted(everyones, key=lambda way: (prices[way], ranks[way]))}, ranks


def _nearness_cost(nearness: Nearness, values: Mapping[str, Inference], weights: Weights) -> int | None:
    """The price of standing nearer to others than suits them; None: nearer than a person asked for.

    Farther than suits them costs nothing: the robot speaks to all, not to each.
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
