"""Connected components of a request: people with no route between them, though each is reachable alone."""

from __future__ import annotations

from comity_domain.problem.request import VisitRequest
from comity_domain.problem.spot import START, Leg


def parts(request: VisitRequest) -> tuple[tuple[str, ...], ...]:
    """The people of each connected component; the largest first.

    Routes are measured where only bounds are known, as far as needed.

    Args:
        request: The planning request, without people who are unreachable from the start.

    Returns:
        One component if routes connect all. Of two of equal size, the one with the first-named person comes
        first.
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
