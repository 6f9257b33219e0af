"""A plan as a tour: the visits in order, each with its side and greeting."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise, product

from comity_domain.choices.options import Options, PersonOptions
from comity_domain.problem.agenda import HANDOVER_S, takes_leave
from comity_domain.problem.spot import START, Spot, place_of


@dataclass(frozen=True, slots=True)
class Stop:
    """A visit: the person that the robot reaches, and whether it greets their whole group."""

    person: str
    company: str | None = None
    bringing: bool | None = None
    """Whether the first offered object is fetched beforehand; None: whichever is cheaper and in time."""


@dataclass(frozen=True, slots=True)
class PlannedVisit:
    """A visit with its choices."""

    spot: Spot
    company: str | None
    way: tuple[str, str] | None
    """Modality and gesture of the greeting; None if the person was greeted before."""
    bringing: bool = False
    """Whether the first offered object was fetched beforehand."""
    returns: tuple[Spot, ...] = ()
    """Docking poses after each object that the robot fetched during the visit."""
    farewell: tuple[str, str] | None = None
    """Modality and gesture of the farewell, or None."""

    @property
    def stop(self) -> Stop:
        """The visit without its choices."""
        return Stop(self.spot.place, self.company, self.bringing)

    @property
    def last_spot(self) -> Spot:
        """Where the visit ends."""
        return (self.spot, *self.returns)[-1]


@dataclass(frozen=True, slots=True, order=True)
class Stay:
    """The choices of a visit that affect its neighbours: its path and its sides.

    Sorted by the tie-break order: front, left, right.
    """

    spot: Spot
    bringing: bool = False
    returns: tuple[Spot, ...] = field(default=())

    @property
    def last_spot(self) -> Spot:
        """Where it ends."""
        return (self.spot, *self.returns)[-1]


def people_at(stop: Stop, options: Options) -> tuple[str, ...]:
    """The people greeted at a visit."""
    return (stop.person,) if stop.company is None else options.companies[stop.company].members


def stays(stop: Stop, options: Options) -> Iterator[Stay]:
    """All ways to make a visit: from each side, with or without fetching the first offered object before."""
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
    """The spots of a visit in order: up to reaching the person, and from then on."""
    fetched = person.fetched_at
    before = fetched[:1] if stay.bringing and not person.in_hand else ()
    later = fetched[len(before) :]
    after = [spot for pair in zip(later, stay.returns, strict=True) for spot in pair]
    return (*before, stay.spot), (stay.spot, *after)


def path(visits: Iterable[Stay | PlannedVisit], options: Options) -> tuple[Spot, ...]:
    """Every spot of a tour in order, with the start and locations."""
    spots = [START]
    for visit in visits:
        there, on = ways_through(visit, options.people[visit.spot.place])
        spots += [*there, *on[1:]]
    return tuple(spots)


def best_tour(order: Sequence[Stop], options: Options, *, start: Spot = START) -> tuple[PlannedVisit, ...]:
    """The cheapest sides and greetings for an order of visits; ties as in `choices.ties`.

    A person gets their inferred side and greeting unless another one is strictly cheaper. This also improves
    the plan of a search that was cut off.

    Args:
        order: The visits.
        options: The available options.
        start: Where the robot starts.

    Raises:
        ValueError: No route passes through these visits in this order.
    """
    chosen = _best_stays(order, options, start)
    return tuple(visit_as(stay, stop, options) for stay, stop in zip(chosen, order, strict=True))


def visit_as(stay: Stay, stop: Stop, options: Options) -> PlannedVisit:
    """The visit along a given path, with the cheapest greeting and farewell."""
    person = options.people[stop.person]
    leave = person.best_greeting().way if takes_leave(person.agenda) else None
    way = None if person.greeted else best_way(stop, options, bringing=stay.bringing)
    return PlannedVisit(stay.spot, stop.company, way, stay.bringing, stay.returns, leave)


def best_way(stop: Stop, options: Options, *, bringing: bool = False) -> tuple[str, str]:
    """Modality and gesture of the cheapest greeting at a visit."""
    if stop.company is None:
        return options.people[stop.person].best_greeting(bringing=bringing).way
    return options.companies[stop.company].best_greeting


def served(visit: PlannedVisit, options: Options) -> tuple[str, ...]:
    """People greeted at a visit, the one whom the robot reaches first."""
    reached = visit.spot.place
    people = people_at(Stop(reached, visit.company), options)
    return (reached, *(name for name in people if name != reached))


def greeting_parts(visits: Sequence[PlannedVisit], options: Options) -> list[Mapping[str, int]]:
    """The parts of each greeting's cost [cm].

    `greeting`: its preference cost. `nearness`: the preference cost of how near the robot is to others of a
    group. `waiting`: the cost of greeting others first.
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
    """Preference cost of a greeting and of the nearness to others of the group; 0 if greeted before."""
    if visit.way is None:
        return 0
    if visit.company is not None:
        return options.companies[visit.company].cost(visit.spot, visit.way)
    return _price(visit.way, options.people[visit.spot.place], bringing=visit.bringing)


def farewell_cost(visit: PlannedVisit, options: Options) -> int:
    """Preference cost of the farewell; 0 if there is none."""
    return 0 if visit.farewell is None else _price(visit.farewell, options.people[visit.spot.place])


def _price(way: tuple[str, str], person: PersonOptions, *, bringing: bool = False) -> int:
    priced = person.priced(bringing=bringing)
    return next(price for greeting, price in priced.items() if greeting.way == way)


def tie_break(stay: Stay, stop: Stop, options: Options) -> int:
    """The tie-break between equally expensive ways to make a visit, each with its best greetings."""
    person = options.people[stop.person]
    found = sum(person.sides[spot.side].tie_break for spot in (stay.spot, *stay.returns))
    if takes_leave(person.agenda):
        found += person.best_greeting().tie_break
    if stop.company is not None:
        return found + options.companies[stop.company].tie_break(stay.spot)
    return found if person.greeted else found + person.best_greeting(bringing=stay.bringing).tie_break


def cost_of(spots: Sequence[Spot], options: Options) -> int | None:
    """Cost of the legs through these spots [cm]; None if a route is missing."""
    costs = [options.legs.get(leg) for leg in pairwise(spots)]
    known = [cost for cost in costs if cost is not None]
    return sum(known) if len(known) == len(costs) else None


def tour_cost(visits: Sequence[PlannedVisit], options: Options) -> int | None:
    """Total cost [cm]; None if an option is not available."""
    if any(not _is_offered(visit, options) for visit in visits):
        return None
    legs = cost_of(path(visits, options), options)
    if legs is None:
        return None
    acts = sum(sum(parts.values()) for parts in greeting_parts(visits, options))
    return legs + acts + sum(farewell_cost(visit, options) for visit in visits)


def end_times_s(visits: Sequence[PlannedVisit], options: Options) -> list[float]:
    """End time of each greeting [s], as estimated for deadlines; needs durations."""
    return [greeted for greeted, _ in times_s(visits, options)]


def times_s(visits: Sequence[PlannedVisit], options: Options) -> list[tuple[float, float]]:
    """End times of each greeting and of the whole visit [s]; likewise."""
    times, now, here = [], 0.0, START
    for visit in visits:
        greeted = now + seconds_to_greeting(here, visit, options)
        now = greeted + seconds_after_greeting(visit, options)
        here = visit.last_spot
        times.append((greeted, now))
    return times


def seconds_to_greeting(start: Spot, stay: Stay | PlannedVisit, options: Options) -> float:
    """Time from a spot until the person has been greeted, with fetching before [s]."""
    person = options.people[stay.spot.place]
    there, _ = ways_through(stay, person)
    return seconds_through((start, *there), options) + _picking_up_s(stay, person) + person.greeting_s


def seconds_after_greeting(stay: Stay | PlannedVisit, options: Options) -> float:
    """Time for the rest of a visit [s]."""
    person = options.people[stay.spot.place]
    _, on = ways_through(stay, person)
    return seconds_through(on, options) + person.agenda_s - _picking_up_s(stay, person)


def _picking_up_s(stay: Stay | PlannedVisit, person: PersonOptions) -> float:
    """Time for picking up objects before the greeting [s]."""
    return HANDOVER_S if stay.bringing and not person.in_hand else 0.0


def seconds_through(spots: Sequence[Spot], options: Options) -> float:
    """Travel time through these spots [s]."""
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
    """Dynamic programming along the order: the best path to every spot where the last visit may end."""
    ways: dict[Spot, tuple[int, int, tuple[Stay, ...]]] = {start: (0, 0, ())}  # cost, tie-break, stays
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
    """Cost of a stay without its legs, up to a constant that all stays of the visit share."""
    if stop.company is not None:
        return options.companies[stop.company].spots[stay.spot]
    return options.people[stop.person].least_dislike(bringing=stay.bringing)
