"""Feasibility of deadlines: whether all can be kept, and in which order.

Costs and sides play no part: travel times do not depend on sides. So among all labels with the same people
greeted and the same place only the earliest counts, and the search is exact for more people than that for the
cheapest plan. People without a deadline come after all others, as an extra visit never makes a later one
earlier, unless the path via them is shorter than the direct one; then everyone takes part.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from time import monotonic

from comity_domain.choices.companies import CompanyOptions
from comity_domain.choices.options import Options, PersonOptions, options
from comity_domain.labelling.alike import ANY_GREETING, ANY_SIDE
from comity_domain.labelling.labels import first_label
from comity_domain.labelling.search import searched
from comity_domain.labelling.table import NO_ROUTE, Arrival, LabelTable, label_table
from comity_domain.problem.measuring import measured, unmeasured_ways
from comity_domain.problem.request import VisitRequest
from comity_domain.problem.spot import Spot, place_of
from comity_domain.tours.lateness import late
from comity_domain.tours.tour import Stop, best_tour, path

LABELS_KEPT = (1_000, 50_000)
"""Labels kept for each number of people greeted, at first and if that is not enough: the second is exact with
14 deadlines however late they are, and with more if they are soon."""
LATEST_S = 1e6
"""Upper bound of all times [s]."""


@dataclass(frozen=True, slots=True)
class Punctual:
    """The answer whether all deadlines can be kept."""

    stops: tuple[Stop, ...] | None
    """An order of the people with a deadline that keeps all deadlines; None: none was found."""
    sure: bool = True
    """If none was found: whether it is certain that there is none."""


def punctual(choices: Options, *, ends_s: float = math.inf) -> Punctual:
    """An order of visits that keeps every deadline.

    Args:
        choices: The options; with lower bounds as durations, the order's times are lower bounds, too.
        ends_s: Time limit by the machine's clock, after which the answer is unknown [s].
    """
    if not choices.has_deadlines:
        return Punctual(())
    timed = _timed(choices, _who_matters(choices))
    table = _by_time(label_table(timed))
    first, bearer = first_label(table, (), timed), timed.bearer_of
    for most_labels in LABELS_KEPT:
        try:
            found, exact = searched(table, first, bearer, most_labels=most_labels, ends_s=ends_s)
        except TimeoutError:
            break
        if found is not None:
            return Punctual(found.stops)
        if exact:
            return Punctual(None)
    return Punctual(None, sure=False)


class Deadlines:
    """Tests sets of deadlines for feasibility, measuring paths only as far as needed.

    Args:
        request: The planning request. Optional people are left out.
        ends_s: Time limit by the machine's clock, after which answers are unknown [s].
    """

    def __init__(self, request: VisitRequest, *, ends_s: float = math.inf) -> None:
        self._request = request.without([each.name for each in request.visitees if each.skip_m is not None])
        self._choices = options(self._request)
        self._ends_s = ends_s

    @property
    def by_s(self) -> Mapping[str, float]:
        """Those that were asked for, by person."""
        return {name: one.by_s for name, one in self._choices.people.items() if one.by_s is not None}

    @property
    def in_time(self) -> bool:
        """Whether there is time left."""
        return monotonic() < self._ends_s

    def may_be_kept(self, by_s: Mapping[str, float], *, ends_s: float = math.inf) -> bool:
        """False where it is certain from what is measured so far that no order keeps these deadlines.

        Args:
            by_s: By person; nobody else has one.
            ends_s: When the answer is that they may be, by the machine's clock.
        """
        found = punctual(_with_deadlines(self._choices, by_s), ends_s=ends_s)
        return found.stops is not None or not found.sure

    def kept(self, by_s: Mapping[str, float]) -> bool | None:
        """Whether some order keeps these deadlines; None where that is not known.

        Args:
            by_s: As above.
        """
        while self.in_time:
            found = punctual(_with_deadlines(self._choices, by_s), ends_s=self._ends_s)
            if found.stops is None:
                return False if found.sure else None
            news = self._measure_along(found.stops)
            if is_punctual(found.stops, _with_deadlines(self._choices, by_s)):
                return True
            if not news:  # a route is missing between two sides of this order
                return None
        return None

    def enough_s(self, name: str, by_s: Mapping[str, float]) -> int | None:
        """The least deadline of a person, in whole seconds, with which all deadlines can be kept.

        Args:
            name: A person.
            by_s: All deadlines, theirs included, with which it cannot be done.

        Returns:
            None where the time did not do, or where no deadline of theirs is late enough.
        """
        too_soon, later_s = math.floor(by_s[name]), 8
        while not (kept := self.kept({**by_s, name: too_soon + later_s})):
            if kept is None or later_s > LATEST_S:
                return None
            too_soon, later_s = too_soon + later_s, 2 * later_s
        enough = too_soon + later_s
        while enough - too_soon > 1:
            middle = (enough + too_soon) // 2
            if self.kept({**by_s, name: middle}):
                enough = middle
            else:
                too_soon = middle
        return enough if self.in_time else None

    def _measure_along(self, stops: Sequence[Stop]) -> bool:
        """Put durations in the place of bounds, for the ways through these stops; whether there were any."""
        try:
            spots = path(best_tour(stops, self._choices), self._choices)
        except ValueError:
            return False
        missing = unmeasured_ways(self._request, spots)
        if missing:
            self._request = measured(self._request, missing, ends_s=self._ends_s)
            self._choices = options(self._request)
        return bool(missing)


def is_punctual(stops: Sequence[Stop], choices: Options) -> bool:
    """Whether a route leads through these stops and everybody there is greeted in time."""
    try:
        return late(best_tour(stops, choices), choices) is None
    except ValueError:
        return False


def _with_deadlines(choices: Options, by_s: Mapping[str, float]) -> Options:
    people = {name: replace(person, by_s=by_s.get(name)) for name, person in choices.people.items()}
    return replace(choices, people=people)


def _who_matters(choices: Options) -> frozenset[str]:
    """Those with a deadline, who is greeted with them, and for whom the robot holds something."""
    hurried = {name for name, person in choices.people.items() if person.by_s is not None}
    if choices.bearer_of is not None:
        hurried.add(choices.bearer_of)
    for company in choices.companies.values():
        if hurried & set(company.members):
            hurried |= set(company.members)
    everybody = frozenset(choices.people)
    return everybody if _has_shortcut(choices, everybody - hurried) else frozenset(hurried)


def _has_shortcut(choices: Options, others: Collection[str]) -> bool:
    """Whether the robot is anywhere earlier by visiting one of these people on the way."""
    import numpy as np

    durations, people = choices.durations_s, choices.people
    if not durations:
        return False
    starts, ends = (list(dict.fromkeys(places)) for places in zip(*durations, strict=True))
    elsewhere = np.array([[start != end for end in ends] for start in starts])
    found = np.array([[durations.get((start, end), math.inf) for end in ends] for start in starts])
    seconds = np.where(elsewhere, found, math.inf)
    for name in others:
        if name not in starts or name not in ends:
            continue
        there, on = seconds[:, ends.index(name)], seconds[starts.index(name)]
        by_way_of = there[:, None] + people[name].greeting_s + people[name].agenda_s + on
        if (elsewhere & (by_way_of < seconds)).any():
            return True
    return False


def _timed(choices: Options, names: Collection[str]) -> Options:
    """What may be chosen for these people, but for what has no part in time: prices and sides."""
    absent = choices.people.keys() - set(names)
    companies = {
        company.name: CompanyOptions(
            company.name,
            company.members,
            {_anywhere(spot, choices): 0 for spot in company.spots},
            {ANY_GREETING.way: 0} if company.spots else {},
        )
        for company in choices.companies.values()
        if set(company.members) <= set(names)
    }
    people = {name: _in_a_hurry(choices.people[name]) for name in choices.people if name in names}
    legs = {
        (_anywhere(start, choices), _anywhere(end, choices)): 0
        for start, end in choices.legs
        if not absent & {place_of(start), end.place}
    }
    return replace(choices, people=people, companies=companies, legs=legs, side_dislikes={})


def _anywhere(spot: Spot, choices: Options) -> Spot:
    """Before a person, whatever the side; a location stays as it is."""
    return spot if place_of(spot) not in choices.people else Spot(spot.place, ANY_SIDE.name)


def _in_a_hurry(person: PersonOptions) -> PersonOptions:
    return replace(
        person,
        sides={ANY_SIDE.name: ANY_SIDE},
        greetings={ANY_GREETING: 0} if person.greetings else {},
        bringing={ANY_GREETING: 0} if person.bringing else person.bringing,
        priority=0,
        skip=None,
    )


def _by_time(table: LabelTable) -> LabelTable:
    """The same with time as the only price."""
    return replace(table, arrivals=tuple(_timed_arrivals(table)), least=(0,) * len(table.names))


def _timed_arrivals(table: LabelTable) -> Iterator[Arrival]:
    import numpy as np

    for arrival in table.arrivals:
        legs = np.where(arrival.legs == NO_ROUTE, NO_ROUTE, arrival.times_ms)
        yield replace(arrival, legs=legs, cost=arrival.after_ms)
