"""What each visit of a plan could be like otherwise, measured: from other sides, a group in other ways."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache

from comity_domain.choices.options import Options, options
from comity_domain.explanation.together import from_elsewhere, one_by_one
from comity_domain.problem.measuring import measured, unmeasured
from comity_domain.problem.request import VisitRequest
from comity_domain.tours.tour import PlannedVisit, Stay, Stop, path, stays


def options_around(request: VisitRequest, visits: Sequence[PlannedVisit]) -> Callable[[], Options]:
    """What may be chosen, with all measured that one visit made otherwise would take; once it is asked for.

    Reasons are told of few of the plans that are made, and to measure what else there was takes as long as to
    find the plan.

    Args:
        request: What was asked.
        visits: The plan; each of its stops is looked at with every other way to make it.
    """
    return cache(lambda: options(_measured_around(request, visits)))


def _measured_around(request: VisitRequest, visits: Sequence[PlannedVisit]) -> VisitRequest:
    if request.survey is None:
        return request
    choices = options(request)
    for index, visit in enumerate(visits):
        for stay in stays(Stop(visit.spot.place, visit.company), choices):
            before, after = visits[max(0, index - 1) : index], visits[index + 1 : index + 2]
            tour: tuple[Stay | PlannedVisit, ...] = (*before, stay, *after)
            spots = path(tour, choices)
            request = measured(request, unmeasured(request, spots if index < 2 else spots[1:]))
        if visit.company is not None:
            request = _measured_otherwise(request, index, visits)
    return request


def _measured_otherwise(request: VisitRequest, index: int, visits: Sequence[PlannedVisit]) -> VisitRequest:
    """The request with all measured that a group met from elsewhere, or one by one, would take."""
    choices = options(request)
    for _, tour in from_elsewhere(index, visits, choices):
        request = measured(request, unmeasured(request, path(tour, choices)))
    while True:
        choices = options(request)
        each = one_by_one(index, visits, choices)
        missing = unmeasured(request, path(each, choices)) if each else None
        if not missing:
            return request
        request = measured(request, missing)
