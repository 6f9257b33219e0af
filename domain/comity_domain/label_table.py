"""The options of a request as numbers in arrays, for the label search."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity_domain.bound import least_costs
from comity_domain.options import Options
from comity_domain.request import GREETING_S, START, Spot, place_of

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Whole = NDArray[np.int64]

NO_ROUTE = -1
NEVER_MS = 2**50
"""Later than any time: no deadline."""


@dataclass(frozen=True, slots=True)
class Arrival:
    """One way to stop: at a spot, to greet its person alone or their company at once."""

    spot: int
    person: int
    company: int
    """Its number; -1: the person alone."""
    people: int
    """Bits of those who are greeted."""
    cost: int
    """Of the greeting, in cm, without what it costs that others were greeted before."""
    priority: int
    """That, for each person who was."""
    by_ms: int
    """The earliest of their deadlines."""


@dataclass(frozen=True, slots=True)
class LabelTable:
    """All of a request; people, companies and spots go by their numbers."""

    names: tuple[str, ...]
    companies: tuple[str, ...]
    spots: tuple[Spot, ...]
    """The last one is START."""
    legs: Whole
    """From spot to spot, in cm; `NO_ROUTE` where there is none."""
    times_ms: Whole
    """The same in time, with the greeting there; 0 where nobody has a deadline."""
    arrivals: tuple[Arrival, ...]
    with_deadline: int
    """Bits of people."""
    latest_departures_ms: Mapping[int, int]
    """By person with a deadline: whoever sets out later is late, from wherever."""
    least: tuple[int, ...]
    """By person, a share of what serving, or leaving out, all those who are left costs at least."""
    skips: tuple[int | None, ...]
    """By person, what leaving them out costs; None where they must be served."""


def label_table(options: Options) -> LabelTable:
    """Number everything."""
    import numpy as np

    names = tuple(options.people)
    spots = (*(spot for person in options.people.values() for spot in person.spots()), START)
    numbers = {spot: i for i, spot in enumerate(spots)}
    legs = np.full((len(spots), len(spots)), NO_ROUTE, dtype=np.int64)
    times_ms = np.zeros_like(legs)
    for (start, end), cost in options.legs.items():
        legs[numbers[start], numbers[end]] = cost
        if options.has_deadlines:
            seconds = options.durations_s[place_of(start), end.place] + GREETING_S
            times_ms[numbers[start], numbers[end]] = round(1000 * seconds)
    by_s = {i: by_s for i, name in enumerate(names) if (by_s := options.people[name].by_s) is not None}
    return LabelTable(
        names,
        tuple(options.companies),
        spots,
        legs,
        times_ms,
        tuple(_arrivals(options, names, numbers)),
        sum(1 << i for i in by_s),
        {
            i: int(1000 * latest) - _quickest_ms(names[i], options)
            for i, latest in by_s.items()
            if options.people[names[i]].skip is None
        },
        tuple(least_costs(options)[name] for name in names),
        tuple(options.people[name].skip for name in names),
    )


def _quickest_ms(name: str, options: Options) -> int:
    """The shortest time in which somebody is reached and greeted, alone or with their company."""
    places = {name}.union(
        *(company.members for company in options.companies.values() if name in company.members)
    )
    legs = [seconds for (_, end), seconds in options.durations_s.items() if end in places]
    return round(1000 * (min(legs, default=0.0) + GREETING_S))


def _arrivals(options: Options, names: tuple[str, ...], numbers: dict[Spot, int]) -> Iterator[Arrival]:
    bits = {name: 1 << i for i, name in enumerate(names)}
    for i, person in enumerate(options.people.values()):
        cost = person.greetings[person.best_greeting]
        for spot in person.spots():
            by_ms = _earliest_ms([person.name], options)
            yield Arrival(numbers[spot], i, -1, bits[person.name], cost, person.priority, by_ms)
    for number, company in enumerate(options.companies.values()):
        for spot in company.spots:
            if spot in numbers:
                yield Arrival(
                    numbers[spot],
                    names.index(spot.place),
                    number,
                    sum(bits[member] for member in company.members),
                    company.cost(spot, company.best_greeting),
                    sum(options.people[member].priority for member in company.members),
                    _earliest_ms(company.members, options),
                )


def _earliest_ms(names: Sequence[str], options: Options) -> int:
    deadlines = [options.people[name].by_s for name in names]
    return min((int(1000 * by_s) for by_s in deadlines if by_s is not None), default=NEVER_MS)
