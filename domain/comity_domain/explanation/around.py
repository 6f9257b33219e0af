"""The alternatives to each visit of a plan, measured: other sides, and other ways to greet a group."""

from __future__ import annotations

import math
from collections.abc import Sequence
from time import monotonic

from comity_domain.choices.options import Options, options
from comity_domain.explanation.together import from_elsewhere, one_by_one
from comity_domain.problem.measuring import measured, unmeasured
from comity_domain.problem.request import VisitRequest
from comity_domain.tours.tour import PlannedVisit, Stay, Stop, path, stays


def options_around(
    request: VisitRequest, visits: Sequence[PlannedVisit], *, ends_s: float = math.inf
) -> Options:
    """The options, with everything measured that changing a single visit would need.

    Args:
        request: The planning request.
        visits: The plan; every alternative to each of its stops is considered.
        ends_s: End of the available time, by the machine's clock [s]; what is left then stays a bound.
    """
    return options(_measured_around(request, visits, ends_s) if request.survey else request)


def _measured_around(request: VisitRequest, visits: Sequence[PlannedVisit], ends_s: float) -> VisitRequest:
    choices = options(request)
    for index, visit in enumerate(visits):
        for stay in stays(Stop(visit.spot.place, visit.company), choices):
            before, after = visits[max(0, index - 1) : index], visits[index + 1 : index + 2]
            tour: tuple[Stay | PlannedVisit, ...] = (*before, stay, *after)
            spots = path(tour, choices)
            missing = unmeasured(request, spots if index < 2 else spots[1:])
            request = measured(request, missing, ends_s=ends_s)
        if visit.company is not None:
            request = _measured_otherwise(request, index, visits, ends_s)
    return request


def _measured_otherwise(
    request: VisitRequest, index: int, visits: Sequence[PlannedVisit], ends_s: float
) -> VisitRequest:
    """The request with all measured that a group met from elsewhere, or one by one, would take."""
    choices = options(request)
    for _, tour in from_elsewhere(index, visits, choices):
        request = measured(request, unmeasured(request, path(tour, choices)), ends_s=ends_s)
    while True:
        choices = options(request)
        each = one_by_one(index, visits, choices)
        missing = unmeasured(request, path(each, choices)) if each else None
        if not missing or monotonic() > ends_s:
            return request
        request = measured(request, missing, ends_s=ends_s)
