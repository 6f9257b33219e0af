"""A plan as people see it: where the robot stops in which order, on which side, with which greeting."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise, product

from comity_domain.choices.options import Options, PersonOptions
from comity_domain.problem.agenda import HANDOVER_S, takes_leave
from comity_domain.problem.spot import START, Spot, place_of


@dataclass(frozen=True, slots=True)
class Stop:
    """The person whom the robot reaches, and whether it greets their company at once."""

    person: str
    company: str | None = None
    bringing: bool | None = None
    """Whether what is offered first is fetched before; None: as is cheaper, where there is time for both."""


@dataclass(frozen=True, slots=True)
class PlannedVisit:
    """A stop with its choices."""

    spot: Spot
    company: str | None
    way: tuple[str, str] | None
    """The modality and the gesture of the greeting; None: they were greeted before."""
    bringing: bool = False
    """Whether what is offered first was fetched before."""
    returns: tuple[Spot, ...] = ()
    """Where the robot stops again, with each thing that it fetched in the middle of the visit."""
    farewell: tuple[str, str] | None = None
    """The modality and the gesture of the farewell; None where there is none."""

    @property
    def stop(self) -> Stop:
        """The stop without its choices."""
        return Stop(self.spot.place, self.company, self.bringing)

    @property
    def last_spot(self) -> Spot:
        """Where the visit ends."""
        return (self.spot, *self.returns)[-1]


@dataclass(frozen=True, slots=True, order=True)
class Stay:
    """How a visit may be made, apart from what is always best: which way it leads, and on which sides.

    Sorted as the law of ties has it: front, left, right.
    """

    spot: Spot
    bringing: bool = False
    returns: tuple[Spot, ...] = field(default=())

    @property
    def last_spot(self) -> Spot:
        """Where it ends."""
        return (self.spot, *self.returns)[-1]


def people_at(stop: Stop, options: Options) -> tuple[str, ...]:
    """The people whom a stop serves."""
    return (stop.person,) if stop.company is None else options.companies[stop.company].members


def stays(stop: Stop, options: Options) -> Iterator[Stay]:
    """All ways to make a visit: from each side, and with what is offered first in the hands, or without."""
    person = options.people[stop.person]
    fetched = len(person.fetched_at)
    for spot in person.spots():
        if stop.company is not None:
            if spot in options.companies[stop.company].spots:
                yield Stay(spot)
            continue
        if not person.in_hand:
            yield from (Stay(spot, False, back) for back in product(person.spots(), repeat=fetched))
        if person.may_come_bringing:
            left = fetched if person.in_hand else fetched - 1
            yield from (Stay(spot, True, back) for back in product(person.spots(), repeat=left))


def ways_through(
    stay: Stay | PlannedVisit, person: PersonOptions
) -> tuple[tuple[Spot, ...], tuple[Spot, ...]]:
    """The spots of a visit in order: until the robot is before the person, and from there on."""
    fetched = person.fetched_at
    before = fetched[:1] if stay.bringing and not person.in_hand else ()
    later = fetched[len(before) :]
    after = [spot for pair in zip(later, stay.returns, strict=True) for spot in pair]
    return (*before, stay.spot), (stay.spot, *after)


def path(visits: Iterable[Stay | PlannedVisit], options: Options) -> tuple[Spot, ...]:
    """Every spot of a tour, locations included, from the start on."""
    spots = [START]
    for visit in visits:
        there, on = ways_through(visit, options.people[visit.spot.place])
        spots += [*there, *on[1:]]
    return tuple(spots)


def best_tour(order: Sequence[Stop], options: Options, *, start: Spot = START) -> tuple[PlannedVisit, ...]:
    """The cheapest sides and greetings for this order, by the law of ties (`choices.ties`).

    A person meets the side and greeting inferred for them unless another is really cheaper. It also improves
    the plan of a search that was cut off.

    Args:
        order: The stops.
        options: What may be chosen.
        start: Where the robot sets out.

    Raises:
        ValueError: No route goes through these stops in this order.
    """
    chosen = _best_stays(order, options, start)
    return tuple(visit_as(stay, stop, options) for stay, stop in zip(chosen, order, strict=True))


def visit_as(stay: Stay, stop: Stop, options: Options) -> PlannedVisit:
    """A visit with what is best once its way is settled."""
    person = options.people[stop.person]
    leave = person.best_greeting().way if takes_leave(person.agenda) else None
    way = None if person.greeted else best_way(stop, options, bringing=stay.bringing)
    return PlannedVisit(stay.spot, stop.company, way, stay.bringing, stay.returns, leave)


def best_way(stop: Stop, options: Options, *, bringing: bool = False) -> tuple[str, str]:
    """The cheapest greeting at a stop."""
    if stop.company is None:
        return options.people[stop.person].best_greeting(bringing=bringing).way
    return options.companies[stop.company].best_greeting


def served(visit: PlannedVisit, options: Options) -> tuple[str, ...]:
    """People who are greeted in a visit, in whatever order they were reached."""
    reached = visit.spot.place
    people = people_at(Stop(reached, visit.company), options)
    return (reached, *(name for name in people if name != reached))


def greeting_parts(visits: Sequence[PlannedVisit], options: Options) -> list[Mapping[str, int]]:
    """What the cost of each greeting is made of, in cm.

    `greeting`: the dislike of it. `nearness`: the dislike of how near others of a company stand. `waiting`:
    that others were greeted before.
    """
    parts: list[Mapping[str, int]] = []
    before = 0
    for visit in visits:
        if visit.way is None:
            parts.append({})
            continue
        people = served(visit, options)
        waiting = before * sum(options.people[name].priority for name in people)
        near = 0 if visit.company is None else options.companies[visit.company].spots[visit.spot]
        own = greeting_cost(visit, options) - near
        parts.append({"greeting": own, "nearness": near, "waiting": waiting})
        before += len(people)
    return parts


def greeting_cost(visit: PlannedVisit, options: Options) -> int:
    """The dislike of one greeting, and of how near others stand to it; 0 where it is over."""
    if visit.way is None:
        return 0
    if visit.company is not None:
        return options.companies[visit.company].cost(visit.spot, visit.way)
    return _price(visit.way, options.people[visit.spot.place], bringing=visit.bringing)


def farewell_cost(visit: PlannedVisit, options: Options) -> int:
    """The dislike of the farewell; 0 where there is none."""
    return 0 if visit.farewell is None else _price(visit.farewell, options.people[visit.spot.place])


def _price(way: tuple[str, str], person: PersonOptions, *, bringing: bool = False) -> int:
    priced = person.priced(bringing=bringing)
    return next(price for greeting, price in priced.items() if greeting.way == way)


def tie_break(stay: Stay, stop: Stop, options: Options) -> int:
    """What decides between ways to make a visit that cost the same, each with its best greetings."""
    person = options.people[stop.person]
    found = sum(person.sides[spot.side].tie_break for spot in (stay.spot, *stay.returns))
    if takes_leave(person.agenda):
        found += person.best_greeting().tie_break
    if stop.company is not None:
        return found + options.companies[stop.company].tie_break(stay.spot)
    return found if person.greeted else found + person.best_greeting(bringing=stay.bringing).tie_break


def cost_of(spots: Sequence[Spot], options: Options) -> int | None:
    """What the legs through these spots cost, in cm; None where a route is missing."""
    costs = [options.legs.get(leg) for leg in pairwise(spots)]
    known = [cost for cost in costs if cost is not None]
    return sum(known) if len(known) == len(costs) else None


def tour_cost(visits: Sequence[PlannedVisit], options: Options) -> int | None:
    """What all of it costs; None where an option of it is not on offer."""
    if any(not _is_offered(visit, options) for visit in visits):
        return None
    legs = cost_of(path(visits, options), options)
    if legs is None:
        return None
    acts = sum(sum(parts.values()) for parts in greeting_parts(visits, options))
    return legs + acts + sum(farewell_cost(visit, options) for visit in visits)


def end_times_s(visits: Sequence[PlannedVisit], options: Options) -> list[float]:
    """When each greeting is over, as deadlines compute it; needs durations."""
    return [greeted for greeted, _ in times_s(visits, options)]


def times_s(visits: Sequence[PlannedVisit], options: Options) -> list[tuple[float, float]]:
    """When each greeting is over, and when the visit; as above."""
    times, now, here = [], 0.0, START
    for visit in visits:
        greeted = now + seconds_to_greeting(here, visit, options)
        now = greeted + seconds_after_greeting(visit, options)
        here = visit.last_spot
        times.append((greeted, now))
    return times


def seconds_to_greeting(start: Spot, stay: Stay | PlannedVisit, options: Options) -> float:
    """What it takes from a spot until a person was greeted, with what is fetched before."""
    person = options.people[stay.spot.place]
    there, _ = ways_through(stay, person)
    return seconds_through((start, *there), options) + _picking_up_s(stay, person) + person.greeting_s


def seconds_after_greeting(stay: Stay | PlannedVisit, options: Options) -> float:
    """What the rest of a visit takes."""
    person = options.people[stay.spot.place]
    _, on = ways_through(stay, person)
    return seconds_through(on, options) + person.agenda_s - _picking_up_s(stay, person)


def _picking_up_s(stay: Stay | PlannedVisit, person: PersonOptions) -> float:
    """What of an agenda comes before the greeting: to take up what is fetched by then."""
    return HANDOVER_S if stay.bringing and not person.in_hand else 0.0


def seconds_through(spots: Sequence[Spot], options: Options) -> float:
    """What the ways through these spots take."""
    return sum(options.durations_s[place_of(start), end.place] for start, end in pairwise(spots))


def _is_offered(visit: PlannedVisit, options: Options) -> bool:
    if visit.company is not None:
        company = options.companies.get(visit.company)
        return company is not None and visit.spot in company.spots and visit.way in company.greetings
    person = options.people[visit.spot.place]
    ways = {None if person.greeted else greeting.way for greeting in person.priced(bringing=visit.bringing)}
    leave = {greeting.way for greeting in person.greetings}
    return visit.way in ways and (visit.farewell is None or visit.farewell in leave)


def _best_stays(order: Sequence[Stop], options: Options, start: Spot) -> tuple[Stay, ...]:
    """Dynamic programming along the order: the best way to every spot where the last visit may end."""
    ways: dict[Spot, tuple[int, int, tuple[Stay, ...]]] = {start: (0, 0, ())}  # cost, tie break, before
    for stop in order:
        longer: dict[Spot, list[tuple[int, int, tuple[Stay, ...]]]] = {}
        for stay in stays(stop, options):
            if stop.bringing not in (None, stay.bringing):
                continue
            price, tie = _price_of(stay, stop, options), tie_break(stay, stop, options)
            for last, (cost, ties, before) in ways.items():
                way = cost_of((last, *path([stay], options)[1:]), options)
                if way is not None:
                    found = (cost + way + price, ties + tie, (*before, stay))
                    longer.setdefault(stay.last_spot, []).append(found)
        ways = {spot: min(found) for spot, found in longer.items()}
    if not ways:
        names = ", ".join(stop.person for stop in order)
        raise ValueError(f"no route goes through {names} in this order")
    return min(ways.values())[2]


def _price_of(stay: Stay, stop: Stop, options: Options) -> int:
    """What a stay costs beside its ways, but for what all stays of a stop cost."""
    if stop.company is not None:
        return options.companies[stop.company].spots[stay.spot]
    return options.people[stop.person].least_dislike(bringing=stay.bringing)
