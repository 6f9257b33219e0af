"""What each visit of a plan could be like otherwise, measured: from other sides, a group in other ways."""

from __future__ import annotations

import math
from collections.abc import Sequence
from time import monotonic

from comity_domain.choices.options import options
from comity_domain.explanation.together import from_elsewhere, one_by_one
from comity_domain.problem.request import VisitRequest
from comity_domain.problem.survey import measured, unmeasured
from comity_domain.tours.tour import Stay, Stop, Visit, path, stays


def measured_around(
    request: VisitRequest, visits: Sequence[Visit], *, ends_s: float = math.inf
) -> tuple[VisitRequest, bool]:
    """The request with all measured that one visit made otherwise would take; and whether there was time.

    Args:
        request: What was asked.
        visits: The plan; each of its stops is looked at with every other way to make it.
        ends_s: When there is no more time, by the machine's clock; what is left then stays a bound.
    """
    if request.survey is None:
        return request, True
    choices = options(request)
    for index, visit in enumerate(visits):
        for stay in stays(Stop(visit.spot.place, visit.company), choices):
            if monotonic() > ends_s:
                return request, False
            before, after = visits[max(0, index - 1) : index], visits[index + 1 : index + 2]
            tour: tuple[Stay | Visit, ...] = (*before, stay, *after)
            spots = path(tour, choices)
            missing = unmeasured(request, spots if index < 2 else spots[1:])
            request = measured(request, missing, ends_s=ends_s)
        if visit.company is not None:
            request, in_time = _measured_otherwise(request, index, visits, ends_s)
            if not in_time:
                return request, False
    return request, monotonic() <= ends_s


def _measured_otherwise(
    request: VisitRequest, index: int, visits: Sequence[Visit], ends_s: float
) -> tuple[VisitRequest, bool]:
    """The request with all measured that a group met from elsewhere, or one by one, would take."""
    choices = options(request)
    for _, tour in from_elsewhere(index, visits, choices):
        if monotonic() > ends_s:
            return request, False
        request = measured(request, unmeasured(request, path(tour, choices)), ends_s=ends_s)
    while monotonic() <= ends_s:
        choices = options(request)
        each = one_by_one(index, visits, choices)
        missing = unmeasured(request, path(each, choices)) if each else None
        if not missing:
            return request, True
        request = measured(request, missing, ends_s=ends_s)
    return request, False
