"""People between whom no way leads, although one leads to each from the start: no order visits them all."""

from __future__ import annotations

from comity_domain.problem.request import VisitRequest
from comity_domain.problem.spot import START, Leg


def parts(request: VisitRequest) -> tuple[tuple[str, ...], ...]:
    """Those of a request who can be visited one after the other, part by part; the largest first.

    Ways are measured where only bounds are known, as far as that takes.

    Args:
        request: What was asked; people who cannot be reached from the start have been left out of it.

    Returns:
        One part where ways lead between all. Of two as large, that of the person named first comes first.
    """
    legs: dict[frozenset[str], list[Leg]] = {}
    for start, end in request.travel:
        if start != START:
            legs.setdefault(frozenset((start.place, end.place)), []).append((start, end))
    found: list[list[str]] = []
    names = [visitee.name for visitee in request.visitees]
    kept = [place for place in dict.fromkeys(end.place for _, end in request.travel) if place not in names]
    for name in (*names, *kept):
        beside = [
            part
            for part in found
            if any(_is_way(leg, request) for other in part for leg in legs.get(frozenset((name, other)), ()))
        ]
        joined = [each for part in beside for each in part]
        found = [*(part for part in found if part not in beside), [*joined, name]]
    people = (tuple(name for name in names if name in part) for part in found)
    by_first = sorted(filter(None, people), key=lambda part: names.index(part[0]))
    return tuple(sorted(by_first, key=len, reverse=True))


def _is_way(leg: Leg, request: VisitRequest) -> bool:
    survey = request.survey
    return survey is None or leg not in survey.legs or survey.leg_m(leg) is not None
