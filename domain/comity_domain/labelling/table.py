"""The options of a request as numbers in arrays, for the label search."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from comity_domain.choices.options import Options
from comity_domain.problem.request import GREETING_S
from comity_domain.problem.spot import START, Spot
from comity_domain.tours.bound import least_costs
from comity_domain.tours.tour import (
    PlannedVisit,
    Stay,
    Stop,
    cost_of,
    farewell_cost,
    greeting_cost,
    seconds_after_greeting,
    seconds_to_greeting,
    served,
    stays,
    tie_break,
    visit_as,
    ways_through,
)

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Whole = NDArray[np.int64]

NO_ROUTE = -1
_BITS = 62
"""Bits for the digits of an order of people: enough for all turns of 15."""
NEVER_MS = 2**50
"""A time later than any other: no deadline [ms]."""


@dataclass(frozen=True, slots=True)
class Arrival:
    """One way to make a visit: greeting its person alone, or their group at once."""

    spot: int
    """Index of the position where it ends."""
    person: int
    company: int
    """Index of the group; -1: the person alone."""
    bringing: bool
    """Whether the first offered object is fetched before."""
    people: int
    """People who are greeted, as bits."""
    turn: tuple[int, ...]
    """Their indices, the one who is reached first."""
    legs: Whole
    """Cost of the path to the person from every position [cm]; `NO_ROUTE` if there is none."""
    times_ms: Whole
    """Duration of that path including the greeting [ms]; 0 if there are no deadlines."""
    cost: int
    """All other costs, without that of waiting [cm]."""
    tie: int
    """Tie-break between visits of equal cost (`choices.ties`)."""
    after_ms: int
    """Duration of the visit after the greeting [ms]."""
    priority: int
    """Cost for each person who was greeted before [cm]."""
    by_ms: int
    """The earliest of their deadlines [ms]."""
    after: int = 0
    """People who must be served before, as bits, if an order is required."""


@dataclass(frozen=True, slots=True)
class LabelTable:
    """A whole request; people, groups and positions are given by index."""

    names: tuple[str, ...]
    companies: tuple[str, ...]
    spots: tuple[Spot, ...]
    """All positions; the last one is START."""
    arrivals: tuple[Arrival, ...]
    with_deadline: int
    """People with a deadline, as bits."""
    latest_departures_ms: Mapping[int, int]
    """By person with a deadline, the latest possible departure from anywhere [ms]."""
    least: tuple[int, ...]
    """By person, a share of the minimum cost of serving, or leaving out, all who are left."""
    greeted: int
    """People who were already greeted, as bits."""
    priorities: tuple[int, ...]
    """By person, cost for each person greeted before [cm]; 0 for optional people."""
    by_priority: tuple[int, ...]
    """All people by decreasing priority."""
    skips: tuple[int | None, ...]
    """By person, cost of leaving them out [cm]; None if they must be served."""

    def turns(self, people: Sequence[int], before: int) -> int:
        """The digits of people who are greeted one after the other.

        Among many people the last turns have no digit, as no 64 bits would hold all of them.

        Args:
            people: Their numbers, in order.
            before: How many were greeted before them.
        """
        base = len(self.names)
        digits = min(base, int(_BITS / math.log2(max(base, 2))))
        return sum(
            person * base ** (digits - 1 - turn)
            for turn, person in enumerate(people, before)
            if turn < digits
        )


def label_table(options: Options, order: Sequence[str] = ()) -> LabelTable:
    """Number everything.

    Args:
        options: What may be chosen.
        order: Who must be reached in this order, each by themselves or for their company.
    """
    names = tuple(options.people)
    spots = (*(spot for person in options.people.values() for spot in person.spots()), START)
    by_s = {i: by_s for i, name in enumerate(names) if (by_s := options.people[name].by_s) is not None}
    priorities = tuple(person.priority if person.skip is None else 0 for person in options.people.values())
    return LabelTable(
        names,
        tuple(options.companies),
        spots,
        tuple(_in_order(_arrivals(options, spots), [names.index(name) for name in order])),
        sum(1 << i for i in by_s),
        {
            i: int(1000 * latest) - _quickest_ms(names[i], options)
            for i, latest in by_s.items()
            if options.people[names[i]].skip is None
        },
        tuple(least_costs(options)[name] for name in names),
        sum(1 << i for i, name in enumerate(names) if options.people[name].greeted),
        priorities,
        tuple(sorted(range(len(names)), key=lambda person: -priorities[person])),
        tuple(options.people[name].skip for name in names),
    )


def _in_order(arrivals: Iterator[Arrival], order: Sequence[int]) -> Iterator[Arrival]:
    """The arrivals that an order of people allows, each with whom it has to wait for."""
    for arrival in arrivals:
        named = [person for person in order if arrival.people >> person & 1]
        if named == [arrival.person]:
            earlier = order[: order.index(arrival.person)]
            yield replace(arrival, after=arrival.after | sum(1 << person for person in earlier))
        elif not named:
            yield arrival


def _quickest_ms(name: str, options: Options) -> int:
    """The shortest time in which a person is reached and greeted, alone or with their company."""
    places = {name}.union(
        *(company.members for company in options.companies.values() if name in company.members)
    )
    legs = [seconds for (_, end), seconds in options.durations_s.items() if end in places]
    return round(1000 * (min(legs, default=0.0) + GREETING_S))


def _arrivals(options: Options, spots: Sequence[Spot]) -> Iterator[Arrival]:
    stops = [Stop(name) for name in options.people]
    together = [
        Stop(member, company.name) for company in options.companies.values() for member in company.members
    ]
    numbers = {spot: i for i, spot in enumerate(spots)}
    for stop in (*stops, *together):
        for stay in stays(stop, options):
            visit = visit_as(stay, stop, options)
            on = cost_of(ways_through(stay, options.people[stop.person])[1], options)
            if on is not None:
                yield _arrival(visit, stay, on, options, numbers)


def _arrival(
    visit: PlannedVisit, stay: Stay, on: int, options: Options, numbers: Mapping[Spot, int]
) -> Arrival:
    """One way to make a visit.

    Args:
        visit: With its choices.
        stay: The way that it leads.
        on: What the ways in the middle of it cost.
        options: What may be chosen.
        numbers: Of the spots.
    """
    people = served(visit, options)
    names = list(options.people)
    first = options.people[visit.spot.place].after
    turn = tuple(map(names.index, people))
    legs, times_ms = _ways_to(stay, options, tuple(numbers))
    return Arrival(
        spot=numbers[stay.last_spot],
        person=names.index(visit.spot.place),
        company=-1 if visit.company is None else list(options.companies).index(visit.company),
        bringing=stay.bringing,
        people=sum(1 << person for person in turn),
        turn=turn,
        legs=legs,
        times_ms=times_ms,
        cost=on + greeting_cost(visit, options) + farewell_cost(visit, options),
        tie=tie_break(stay, Stop(visit.spot.place, visit.company), options),
        after_ms=_after_ms(stay, options),
        priority=sum(options.people[name].priority for name in people),
        by_ms=_earliest_ms(people, options),
        after=0 if first is None or first not in options.people else 1 << names.index(first),
    )


def _ways_to(stay: Stay, options: Options, spots: Sequence[Spot]) -> tuple[Whole, Whole]:
    """From every spot to the person of a visit: costs, and times with the greeting."""
    import numpy as np

    legs = np.full(len(spots), NO_ROUTE, dtype=np.int64)
    times_ms = np.zeros_like(legs)
    there, _ = ways_through(stay, options.people[stay.spot.place])
    for i, start in enumerate(spots):
        cost = cost_of((start, *there), options) if start.place != stay.spot.place or start == START else None
        if cost is None:
            continue
        legs[i] = cost
        if options.has_deadlines:
            times_ms[i] = round(1000 * seconds_to_greeting(start, stay, options))
    return legs, times_ms


def _after_ms(stay: Stay, options: Options) -> int:
    return round(1000 * seconds_after_greeting(stay, options)) if options.has_deadlines else 0


def _earliest_ms(names: Sequence[str], options: Options) -> int:
    deadlines = [options.people[name].by_s for name in names]
    return min((int(1000 * by_s) for by_s in deadlines if by_s is not None), default=NEVER_MS)
