"""Deadlines of greetings: lateness, and deadlines that can no longer be kept."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from comity_domain import Deadlines
from comity_executor import Cause

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from comity_domain import Visitee, VisitRequest
    from comity_executor import Visit

IN_TIME_S = 1e-6
"""Tolerance of times, which are sums of the world's steps [s]."""


def deadline_s(visitees: Iterable[Visitee], person: str) -> float | None:
    """Time at which a person's greeting is to be over [s of the world]; None without a deadline."""
    return next((each.by_s for each in visitees if each.name == person), None)


def late_s(visitees: Iterable[Visitee], visit: Visit) -> float | None:
    """Lateness of a greeting [s]: 0 in time, None without a deadline or a greeting."""
    by_s = deadline_s(visitees, visit.person)
    if by_s is None or visit.greeted_s is None:
        return None
    late = visit.greeted_s - by_s
    return late if late > IN_TIME_S else 0.0


def without_missed(request: VisitRequest, *, ends_s: float) -> VisitRequest:
    """The same without the deadlines that no order keeps any more: on the way, late is better than never.

    Where they exclude each other, who is worth more keeps theirs, then whose is sooner.

    Args:
        request: What is left to do, and has no plan.
        ends_s: When a deadline that is not known to be kept by then is dropped, by the machine's clock.
    """
    deadlines = Deadlines(request, ends_s=ends_s)
    worth = {each.name: each.priority_m for each in request.visitees}
    kept: dict[str, float] = {}
    for name, by_s in sorted(deadlines.by_s.items(), key=lambda item: (-worth[item[0]], item[1])):
        if deadlines.kept({**kept, name: by_s}):
            kept[name] = by_s
    missed = deadlines.by_s.keys() - kept.keys()
    visitees = (replace(each, by_s=None) if each.name in missed else each for each in request.visitees)
    return replace(request, visitees=tuple(visitees))


def told_late(asked_for: Iterable[Visitee], planned: Iterable[Visitee]) -> Iterator[Cause]:
    """Of everybody who is now planned without their deadline: that they are greeted late.

    Args:
        asked_for: Everybody as the scenario has them.
        planned: Who is left, as they were planned now.
    """
    left = {each.name for each in planned if each.by_s is None and not each.greeted}
    for each in asked_for:
        if each.by_s is not None and each.name in left:
            told = f"that {each.name} is greeted by {each.by_s:g} s cannot be promised any more"
            yield Cause("condition", f"{told}: late is better than never", None)
