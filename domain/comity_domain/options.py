"""Everything a plan can be made of: the sides, greetings and legs on offer, with their prices."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from comity_domain.companies import CompanyOptions, company_options
from comity_domain.cost import dislike_cost, travel_cost
from comity_domain.greeting import Greeting, greetings, ruled_out
from comity_domain.request import START, Spot, Visitee, VisitRequest, Way
from comity_domain.side import Side, sides
from comity_fis.value import Inference


@dataclass(frozen=True, slots=True)
class PersonOptions:
    """How one person may be visited."""

    name: str
    values: Inference
    sides: Mapping[str, Side]
    """By name; a route leads to each of them."""
    blocked_sides: tuple[str, ...]
    """Sides that the person accepts and no route leads to."""
    greetings: Mapping[Greeting, int]
    """The price of each in cm; the inferred one first."""
    ruled_out: Mapping[Greeting, str]
    """Greetings that the moment forbids, with what is against each."""
    priority: int
    """In cm, for each person who is greeted before."""
    by_s: float | None
    skip: int | None = None
    """In cm, what leaving this person out costs; None: they are served."""

    def spots(self) -> Iterator[Spot]:
        """Where the robot may stand."""
        return (Spot(self.name, side) for side in self.sides)

    @property
    def best_greeting(self) -> Greeting:
        """The cheapest; they are sorted so that the first of equals is the nearest to what was inferred."""
        return min(self.greetings, key=lambda greeting: self.greetings[greeting])


@dataclass(frozen=True, slots=True)
class Options:
    """A request with every choice spelt out."""

    robot: str
    people: Mapping[str, PersonOptions]
    companies: Mapping[str, CompanyOptions]
    legs: Mapping[tuple[Spot, Spot], int]
    """The price in cm of a leg, from START or a spot to a spot: the route and the dislike of its end."""
    side_dislikes: Mapping[Spot, int]
    """The part of it that is the dislike."""
    durations_s: Mapping[Way, float]

    def side(self, spot: Spot) -> Side:
        """The side that a spot is on."""
        return self.people[spot.place].sides[spot.side]

    @property
    def has_priorities(self) -> bool:
        """Whether it matters how many people are greeted before somebody."""
        return any(person.priority for person in self.people.values())

    @property
    def has_deadlines(self) -> bool:
        """Whether time matters."""
        return any(person.by_s is not None for person in self.people.values())


def options(request: VisitRequest) -> Options:
    """What the planner may choose from.

    Raises:
        ValueError: A person cannot be reached on any side they accept, or may not be greeted in any way.
    """
    people = {visitee.name: _person(visitee, request) for visitee in request.visitees}
    spots = [spot for person in people.values() for spot in person.spots()]
    dislikes = {
        spot: dislike_cost(people[spot.place].sides[spot.side].desirability, request.weights.side_m)
        for spot in spots
    }
    legs = {
        (start, end): travel_cost(length_m) + dislikes[end]
        for start in (START, *spots)
        for end in spots
        if start.place != end.place or start == START
        if (length_m := request.travel.get((start, end))) is not None
    }
    values = {name: person.values for name, person in people.items()}
    offers = {name: person.greetings for name, person in people.items()}
    companies = {
        company.name: company_options(company, values, offers, request.weights)
        for company in request.companies
    }
    return Options(request.robot, people, companies, legs, dislikes, request.durations_s)


def _person(visitee: Visitee, request: VisitRequest) -> PersonOptions:
    reached = {end for _, end in request.travel}
    accepted = sides(visitee.values)
    on_offer = {name: side for name, side in accepted.items() if Spot(visitee.name, name) in reached}
    if not on_offer:
        raise ValueError(f"no route leads to {visitee.name!r} on a side they accept: leave them out")
    priced = {
        greeting: dislike_cost(greeting.desirability, request.weights.greeting_m)
        for greeting in greetings(visitee.values, visitee.now)
    }
    if not priced:
        raise ValueError(f"no greeting is permitted for {visitee.name!r}: leave them out")
    return PersonOptions(
        visitee.name,
        visitee.values,
        on_offer,
        tuple(name for name in accepted if name not in on_offer),
        priced,
        ruled_out(visitee.values, visitee.now),
        travel_cost(visitee.priority_m),
        visitee.by_s,
    )
