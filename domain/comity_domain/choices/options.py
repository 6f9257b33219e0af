"""All options of a plan: sides, greetings and legs, with their costs."""

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
"""Cost of each greeting [cm], the cheapest first, then by tie-break."""


@dataclass(frozen=True, slots=True)
class PersonOptions:
    """The options for visiting one person."""

    name: str
    values: Inference
    sides: Mapping[str, Side]
    """Reachable sides, by name."""
    blocked_sides: Mapping[str, str]
    """Accepted but unreachable sides, with the reasons."""
    greetings: Priced
    ruled_out: Mapping[Greeting, str]
    """Greetings excluded by the circumstances, with the reasons."""
    priority: int
    """Cost of each person who is greeted before this one [cm]."""
    by_s: float | None
    skip: int | None = None
    """Cost of leaving this person out [cm]; None: they must be served."""
    agenda: Agenda = ()
    """Tasks after the greeting."""
    bringing: Priced | None = None
    """Greetings possible while carrying the first offered object; None: nothing can be brought."""
    ruled_out_bringing: Mapping[Greeting, str] | None = None
    """Greetings excluded while carrying it, with the reasons."""
    silent: str | None = None
    """Why words are inaudible; None: they are heard."""
    greeted: bool = False
    """Whether only the agenda is left."""
    in_hand: bool = False
    """Whether the robot holds the first offered object."""
    after: str | None = None
    """Person to be greeted first, if requested; ignored once a visit is under way."""
    at_rest: Mapping[str, str] = field(default_factory=dict)
    """Requests that cannot be met now, with the reasons in words; by parameter."""
    is_told: bool = False
    """Whether the person cannot see: the robot announces that it approaches, has stopped and leaves."""

    def spots(self) -> Iterator[Spot]:
        """Possible positions of the robot."""
        return (Spot(self.name, side) for side in self.sides)

    def priced(self, *, bringing: bool) -> Priced:
        """The greetings, empty-handed or while carrying what was fetched first."""
        return (self.bringing or {}) if bringing else self.greetings

    def best_greeting(self, *, bringing: bool = False) -> Greeting:
        """The cheapest greeting, after tie-breaking."""
        return next(iter(self.priced(bringing=bringing)))

    def least_dislike(self, *, bringing: bool = False) -> int:
        """Minimum cost of being greeted [cm]; 0 if that is done."""
        return 0 if self.greeted else min(self.priced(bringing=bringing).values())

    @property
    def greeting_s(self) -> float:
        """Duration of the greeting, as estimated for deadlines [s]."""
        if self.greeted:
            return 0.0
        return GREETING_S + (ANNOUNCING_S if self.is_told else 0.0)

    @property
    def agenda_s(self) -> float:
        """Duration of everything else without travel, as estimated for deadlines [s]."""
        return seconds_of(self.agenda, in_hand=self.in_hand)

    @property
    def may_come_bringing(self) -> bool:
        """Whether the robot may approach while carrying the first offered object."""
        return bool(self.bringing) or (self.greeted and bool(offers(self.agenda)))

    @property
    def fetched_at(self) -> tuple[Spot, ...]:
        """Positions for fetching offered objects, in order."""
        return tuple(location(offer.place) for offer in offers(self.agenda)[self.in_hand :])


@dataclass(frozen=True, slots=True)
class Options:
    """A request with every choice enumerated."""

    robot: str
    people: Mapping[str, PersonOptions]
    companies: Mapping[str, CompanyOptions]
    legs: Mapping[tuple[Spot, Spot], int]
    """Cost of a leg from START or a position to a position: route plus preference cost of its end [cm]."""
    side_dislikes: Mapping[Spot, int]
    """The preference cost within it [cm]."""
    durations_s: Mapping[Way, float]
    dropped: Mapping[str, int] = field(default_factory=dict)
    """People whose visit is dropped, with its cost [cm]."""

    def side(self, spot: Spot) -> Side:
        """The side of a position."""
        return self.people[spot.place].sides[spot.side]

    def leg_parts(self, start: Spot, end: Spot) -> Mapping[str, int]:
        """The parts of the cost of a leg [cm]."""
        dislike = self.side_dislikes.get(end, 0)  # at a location, no side is preferred
        return {"travel": self.legs[start, end] - dislike, "side": dislike}

    @property
    def locations(self) -> tuple[Spot, ...]:
        """Locations where something is fetched."""
        return tuple(dict.fromkeys(at for person in self.people.values() for at in person.fetched_at))

    @property
    def bearer_of(self) -> str | None:
        """The person for whom the robot holds something: that visit comes first."""
        return next((name for name, person in self.people.items() if person.in_hand), None)

    @property
    def has_priorities(self) -> bool:
        """Whether the number of people greeted before a person has a cost."""
        return any(person.priority for person in self.people.values())

    @property
    def has_order(self) -> bool:
        """Whether the scenario requires one person to be greeted before another."""
        return any(person.after in self.people for person in self.people.values())

    @property
    def has_deadlines(self) -> bool:
        """Whether there are deadlines."""
        return any(person.by_s is not None for person in self.people.values())


def options(request: VisitRequest) -> Options:
    """Enumerate what the planner may choose from.

    Raises:
        ValueError: If a person cannot be reached on any side they accept, or greeted in any way.
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
    """People who are greeted alone because they have an agenda, or must come first."""
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
    """The visitee with the robot carrying the first offered object; None if nothing is offered."""
    brought = offers(visitee.agenda)
    if not brought:
        return None
    return replace(visitee, now=replace(visitee.now, robot_carries=brought[0].thing))
