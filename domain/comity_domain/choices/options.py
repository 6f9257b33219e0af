"""Everything that a plan can be made of: the sides, greetings and legs on offer, with their prices."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field, replace

from comity_domain.choices.companies import CompanyOptions, company_options
from comity_domain.choices.cost import dislike_cost, travel_cost
from comity_domain.choices.earshot import drowned
from comity_domain.choices.greeting import Greeting, greetings, ruled_out
from comity_domain.choices.side import Side, sides
from comity_domain.problem.agenda import Agenda, offers, seconds_of, takes_leave
from comity_domain.problem.request import ANNOUNCING_S, GREETING_S, Visitee, VisitRequest
from comity_domain.problem.spot import START, Spot, Way, location
from comity_fis.inference.value import Inference

Priced = Mapping[Greeting, int]
"""The price of each in cm; the cheapest first, and of equals the one that ties go to."""


@dataclass(frozen=True, slots=True)
class PersonOptions:
    """How one person may be visited."""

    name: str
    values: Inference
    sides: Mapping[str, Side]
    """By name; a route leads to each of them."""
    blocked_sides: Mapping[str, str]
    """Sides that the person accepts and no route leads to, with what is against each."""
    greetings: Priced
    ruled_out: Mapping[Greeting, str]
    """Greetings that the moment forbids, with what is against each."""
    priority: int
    """In cm, for each person who is greeted before."""
    by_s: float | None
    skip: int | None = None
    """In cm, what leaving this person out costs; None: they are served."""
    agenda: Agenda = ()
    """What is to be done after the greeting."""
    bringing: Priced | None = None
    """The greetings that are left with what is offered first in the hands; None: nothing can be brought."""
    ruled_out_bringing: Mapping[Greeting, str] | None = None
    """What that forbids."""
    silent: str | None = None
    """Why words are useless; None: they are heard."""
    greeted: bool = False
    """Nothing but the agenda is left."""
    in_hand: bool = False
    """The robot holds what is offered first."""
    after: str | None = None
    """Who is greeted before, if anybody asked for; nobody waits whose visit is under way."""
    at_rest: Mapping[str, str] = field(default_factory=dict)
    """What they asked for and cannot have now, with why, in words; by parameter."""
    is_told: bool = False
    """They do not see: words tell them that the robot comes, has stopped and leaves."""

    def spots(self) -> Iterator[Spot]:
        """Where the robot may stand."""
        return (Spot(self.name, side) for side in self.sides)

    def priced(self, *, bringing: bool) -> Priced:
        """The greetings, empty-handed or with what was fetched first."""
        return (self.bringing or {}) if bringing else self.greetings

    def best_greeting(self, *, bringing: bool = False) -> Greeting:
        """The cheapest, by the law of ties."""
        return next(iter(self.priced(bringing=bringing)))

    def least_dislike(self, *, bringing: bool = False) -> int:
        """What being greeted costs at least; nothing where that is over."""
        return 0 if self.greeted else min(self.priced(bringing=bringing).values())

    @property
    def greeting_s(self) -> float:
        """What the greeting takes, as deadlines compute it."""
        if self.greeted:
            return 0.0
        return GREETING_S + (ANNOUNCING_S if self.is_told else 0.0)

    @property
    def agenda_s(self) -> float:
        """What all else takes without the ways, likewise."""
        return seconds_of(self.agenda, in_hand=self.in_hand)

    @property
    def may_come_bringing(self) -> bool:
        """Whether the robot may come with what is offered first in its hands."""
        return bool(self.bringing) or (self.greeted and bool(offers(self.agenda)))

    @property
    def fetched_at(self) -> tuple[Spot, ...]:
        """Where the robot has to go for what is offered, in order."""
        return tuple(location(offer.place) for offer in offers(self.agenda)[self.in_hand :])


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
    dropped: Mapping[str, int] = field(default_factory=dict)
    """People whose visit is dropped, with its price in cm."""

    def side(self, spot: Spot) -> Side:
        """The side that a spot is on."""
        return self.people[spot.place].sides[spot.side]

    def leg_parts(self, start: Spot, end: Spot) -> Mapping[str, int]:
        """What the price of a leg is made of."""
        dislike = self.side_dislikes.get(end, 0)  # where something is kept, no side is liked or not
        return {"travel": self.legs[start, end] - dislike, "side": dislike}

    @property
    def locations(self) -> tuple[Spot, ...]:
        """Where something is fetched for a person."""
        return tuple(dict.fromkeys(at for person in self.people.values() for at in person.fetched_at))

    @property
    def bearer_of(self) -> str | None:
        """For whom the robot holds something: that visit comes first."""
        return next((name for name, person in self.people.items() if person.in_hand), None)

    @property
    def has_priorities(self) -> bool:
        """Whether it matters how many people are greeted before a person."""
        return any(person.priority for person in self.people.values())

    @property
    def has_order(self) -> bool:
        """Whether the scenario wants a person greeted before another person."""
        return any(person.after in self.people for person in self.people.values())

    @property
    def has_deadlines(self) -> bool:
        """Whether time matters."""
        return any(person.by_s is not None for person in self.people.values())


def options(request: VisitRequest) -> Options:
    """What the planner may choose from.

    Raises:
        ValueError: A person cannot be reached on any side they accept, or may not be greeted in any way.
    """
    reached = {end for _, end in request.travel}
    people = {visitee.name: _person(visitee, request, reached) for visitee in request.visitees}
    spots = [spot for person in people.values() for spot in person.spots()]
    dislikes = {
        spot: dislike_cost(people[spot.place].sides[spot.side].desirability, request.weights.side_m)
        for spot in spots
    }
    values = {name: person.values for name, person in people.items()}
    offers = {name: person.greetings for name, person in people.items()}
    companies = {
        company.name: company_options(company, spots, values, offers, request.weights)
        for company in (each.without(_busy(people)) for each in request.companies)
        if company is not None
    }
    dropped = {name: travel_cost(price) for name, price in request.dropped_m.items()}
    chosen = Options(request.robot, people, companies, {}, dislikes, request.durations_s, dropped)
    return _with_legs(chosen, spots, request)


def _busy(people: Mapping[str, PersonOptions]) -> list[str]:
    """Those who are greeted alone: more is to be done with them, or a person comes first."""
    return [
        name for name, person in people.items() if person.agenda or person.is_told or person.after in people
    ]


def _with_legs(chosen: Options, spots: list[Spot], request: VisitRequest) -> Options:
    ends = [*spots, *chosen.locations]
    dislikes = {**chosen.side_dislikes, **dict.fromkeys(chosen.locations, 0)}
    legs = {
        (start, end): travel_cost(length_m) + dislikes[end]
        for start in (START, *ends)
        for end in ends
        if start.place != end.place or start == START
        if (length_m := request.travel.get((start, end))) is not None
    }
    return replace(chosen, legs=legs, side_dislikes=dislikes)


def _person(visitee: Visitee, request: VisitRequest, reached: Collection[Spot]) -> PersonOptions:
    accepted = sides(visitee.values)
    open_ = {name: side for name, side in accepted.items() if name not in visitee.not_from}
    on_offer = {name: side for name, side in open_.items() if Spot(visitee.name, name) in reached}
    if not on_offer:
        raise ValueError(f"no route leads to {visitee.name!r} on a side they accept: leave them out")
    priced = _priced(visitee, request)
    if not priced and (not visitee.greeted or takes_leave(visitee.agenda)):
        raise ValueError(f"no greeting is permitted for {visitee.name!r}: leave them out")
    carrying = _carrying(visitee)
    return PersonOptions(
        visitee.name,
        visitee.values,
        on_offer,
        {name: _against(name, visitee, request) for name in accepted if name not in on_offer},
        priced,
        ruled_out(visitee.values, visitee.now),
        travel_cost(visitee.priority_m),
        visitee.by_s,
        agenda=visitee.agenda,
        silent=drowned(visitee.values, visitee.now),
        bringing=None if carrying is None else _priced(carrying, request) or None,
        ruled_out_bringing=None if carrying is None else ruled_out(carrying.values, carrying.now),
        greeted=visitee.greeted,
        in_hand=visitee.in_hand,
        after=None if visitee.greeted or visitee.in_hand else visitee.after,
        at_rest=visitee.now.at_rest,
        is_told=not visitee.now.sees,
    )


def _against(side: str, visitee: Visitee, request: VisitRequest) -> str:
    if side in visitee.not_from:
        return "the scenario rules it out"
    return _in_its_way(Spot(visitee.name, side), request)


def _in_its_way(spot: Spot, request: VisitRequest) -> str:
    if (what := request.blocked.get(spot)) is None:
        return "no free place there that a route leads to"
    return f"no free place there: {what} is in the way"


def _priced(visitee: Visitee, request: VisitRequest) -> dict[Greeting, int]:
    prices = {
        greeting: dislike_cost(greeting.desirability, request.weights.greeting_m)
        for greeting in greetings(visitee.values, visitee.now)
    }
    return dict(sorted(prices.items(), key=lambda priced: (priced[1], priced[0].rank)))


def _carrying(visitee: Visitee) -> Visitee | None:
    """The same with what is offered first in the robot's hands; None where nothing is offered."""
    brought = offers(visitee.agenda)
    if not brought:
        return None
    return replace(visitee, now=replace(visitee.now, robot_carries=brought[0].thing))
