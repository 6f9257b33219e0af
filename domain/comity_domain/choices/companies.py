"""How people who stand together can be greeted at once, and at what price."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from comity_domain.choices.cost import dislike_cost
from comity_domain.choices.greeting import Greeting
from comity_domain.problem.request import Company, Nearness, Spot, Weights
from comity_domain.problem.setting import is_setting
from comity_fis.defuzzification.curve import Choice
from comity_fis.inference.value import Inference

Offers = Mapping[str, Mapping[Greeting, int]]
"""By person, the price of every greeting that is possible for them."""


@dataclass(frozen=True, slots=True)
class CompanyOptions:
    """How one company may be greeted; nothing on offer where its members have no greeting in common."""

    name: str
    members: tuple[str, ...]
    spots: Mapping[Spot, int]
    """Where the robot may stand, with the price in cm of coming nearer to the others than they like."""
    greetings: Mapping[tuple[str, str], int]
    """Modality and gesture that all accept, with the price: once, what it is worth to whom it suits least."""

    @property
    def best_greeting(self) -> tuple[str, str]:
        """The cheapest; the first member's inferred one wins ties."""
        return min(self.greetings, key=lambda way: self.greetings[way])

    def cost(self, spot: Spot, way: tuple[str, str]) -> int:
        """What a greeting of all of them from a spot costs."""
        return self.spots[spot] + self.greetings[way]


def company_options(
    company: Company, values: Mapping[str, Inference], offers: Offers, weights: Weights
) -> CompanyOptions:
    """The spots and greetings that all members accept."""
    accepted = [
        {greeting.way: price for greeting, price in offers[member].items()} for member in company.members
    ]
    common = {way: max(prices[way] for prices in accepted) for way in _in_all(accepted)}
    spots = {
        spot: price
        for spot, nearness in company.overlooks.items()
        if (price := _nearness_cost(nearness, values, weights)) is not None
    }
    return CompanyOptions(company.name, company.members, spots if common else {}, common)


def _in_all(accepted: list[dict[tuple[str, str], int]]) -> Iterator[tuple[str, str]]:
    return (way for way in accepted[0] if all(way in prices for prices in accepted))


def _nearness_cost(nearness: Nearness, values: Mapping[str, Inference], weights: Weights) -> int | None:
    """The price of standing nearer to others than suits them; None: nearer than somebody asked for.

    Farther than suits them costs nothing: the robot speaks to all, not to each.
    """
    cost = 0
    for name, distance_m in nearness.items():
        wanted = values[name]["conversational_distance"]
        if distance_m >= wanted.number:
            continue
        if is_setting(wanted):
            return None
        assert not isinstance(wanted.desirability, Choice)
        cost += dislike_cost(wanted.desirability(distance_m), weights.side_m)
    return cost
