"""Everything a plan can be made of: the sides, greetings and legs on offer, with their prices."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from comity_domain.cost import dislike_cost, travel_cost
from comity_domain.greeting import Greeting, greetings
from comity_domain.request import START, Spot, Visitee, VisitRequest
from comity_domain.side import Side, sides
from comity_fis.value import Inference


@dataclass(frozen=True, slots=True)
class PersonOptions:
    """How one person may be visited."""

    name: str
    values: Inference
    sides: Mapping[str, Side]
    """By name; a route leads to each of them."""
    greetings: Mapping[Greeting, int]
    """The price of each in cm; the inferred one first."""

    def spots(self) -> Iterator[Spot]:
        """Where the robot may stand."""
        return (Spot(self.name, side) for side in self.sides)


@dataclass(frozen=True, slots=True)
class Options:
    """A request with every choice spelt out."""

    robot: str
    people: Mapping[str, PersonOptions]
    legs: Mapping[tuple[Spot, Spot], int]
    """The price in cm of a leg, from START or a spot to a spot: the route and the dislike of its end."""

    def side(self, spot: Spot) -> Side:
        """The side that a spot is on."""
        return self.people[spot.place].sides[spot.side]


def options(request: VisitRequest) -> Options:
    """What the planner may choose from.

    Raises:
        ValueError: A person cannot be reached on any side they accept, or may not be greeted in any way.
    """
    people = {visitee.name: _person(visitee, request) for visitee in request.visitees}
    spots = [spot for person in people.values() for spot in person.spots()]
    legs = {
        (start, end): travel_cost(length_m)
        + dislike_cost(people[end.place].sides[end.side].desirability, request.weights.side_m)
        for start in (START, *spots)
        for end in spots
        if start.place != end.place or start == START
        if (length_m := request.travel.get((start, end))) is not None
    }
    return Options(request.robot, people, legs)


def _person(visitee: Visitee, request: VisitRequest) -> PersonOptions:
    reached = {end for _, end in request.travel}
    on_offer = {
        name: side for name, side in sides(visitee.values).items() if Spot(visitee.name, name) in reached
    }
    if not on_offer:
        raise ValueError(f"no route leads to {visitee.name!r} on a side they accept: leave them out")
    priced = {
        greeting: dislike_cost(greeting.desirability, request.weights.greeting_m)
        for greeting in greetings(visitee.values)
    }
    if not priced:
        raise ValueError(f"no greeting is permitted for {visitee.name!r}")
    return PersonOptions(visitee.name, visitee.values, on_offer, priced)
