"""Replaces bounds on route lengths in a request by measured lengths where they are needed."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from time import monotonic
from typing import TypeVar

from comity_domain.problem.request import VisitRequest
from comity_domain.problem.spot import Leg, Spot, Way, place_of
from comity_domain.problem.survey import Survey

Place = TypeVar("Place")


@dataclass(frozen=True, slots=True)
class Unmeasured:
    """The legs and ways that are not measured yet."""

    legs: tuple[Leg, ...] = ()
    ways: tuple[Way, ...] = ()

    def __bool__(self) -> bool:
        return bool(self.legs or self.ways)


def unmeasured(request: VisitRequest, spots: Sequence[Spot]) -> Unmeasured:
    """Unmeasured legs and ways of the route through these spots."""
    legs = unmeasured_legs(request, spots)
    return replace(legs, ways=unmeasured_ways(request, spots).ways) if request.has_deadlines else legs


def unmeasured_legs(request: VisitRequest, spots: Sequence[Spot]) -> Unmeasured:
    """Unmeasured legs of the route."""
    if request.survey is None:
        return Unmeasured()
    return Unmeasured(tuple(dict.fromkeys(leg for leg in pairwise(spots) if leg in request.survey.legs)))


def unmeasured_ways(request: VisitRequest, spots: Sequence[Spot]) -> Unmeasured:
    """Unmeasured ways (computed without culture) of the route."""
    if request.survey is None:
        return Unmeasured()
    ways = dict.fromkeys((place_of(start), end.place) for start, end in pairwise(spots))
    return Unmeasured(ways=tuple(way for way in ways if way in request.survey.ways))


def measured(request: VisitRequest, which: Unmeasured, *, ends_s: float = math.inf) -> VisitRequest:
    """The request with these bounds replaced by lengths; entries without a route are removed.

    Args:
        request: The planning request.
        which: What to measure.
        ends_s: Time limit on the machine's clock [s]; what is not measured by then stays a bound.
    """
    survey = request.survey
    if survey is None or not which:
        return request
    legs = {leg: survey.leg_m(leg) for leg in _until(ends_s, which.legs)}
    ways = {way: survey.way(way) for way in _until(ends_s, which.ways)}
    shut = {way for way, found in ways.items() if found is None}
    lengths = {way: found[0] for way, found in ways.items() if found is not None}
    seconds = {way: found[1] for way, found in ways.items() if found is not None}
    travel = {leg: legs.get(leg, length) for leg, length in request.travel.items()}
    return replace(
        request,
        travel={
            (start, end): length
            for (start, end), length in travel.items()
            if length is not None and (place_of(start), end.place) not in shut
        },
        ways_m={way: lengths.get(way, bound) for way, bound in request.ways_m.items() if way not in shut},
        durations_s={
            way: seconds.get(way, bound) for way, bound in request.durations_s.items() if way not in shut
        },
        survey=replace(survey, legs=survey.legs - legs.keys(), ways=survey.ways - ways.keys()),
    )


def _until(ends_s: float, places: Iterable[Place]) -> Iterator[Place]:
    """The items, until the time limit."""
    for place in places:
        if monotonic() > ends_s:
            return
        yield place


def fully_measured(request: VisitRequest) -> VisitRequest:
    """The request without bounds: for questions about all existing routes."""
    if request.survey is None:
        return request
    return replace(measured(request, _all_of(request.survey, request.travel)), survey=None)


def _all_of(survey: Survey, travel: Iterable[Leg]) -> Unmeasured:
    return Unmeasured(tuple(leg for leg in travel if leg in survey.legs), tuple(survey.ways))
