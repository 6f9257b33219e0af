"""Collisions with the robot and their times: a contact triggers its stop, so the trace records it."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from typing import TYPE_CHECKING

from comity.testing.amounts import causes

if TYPE_CHECKING:
    from comity_executor import History, TraceEvent

_BUMPED = "bumped into "
"""Beginning of a contact's text in the trace."""
PEOPLE, THINGS = "person_contacts", ("wall_contacts", "furniture_contacts")
CONTACTS = (PEOPLE, *THINGS, "touches")
"""Metrics that count contacts."""
MOST = 5
"""Maximum number of contacts listed (our choice)."""


def bumps(
    people: Collection[str], events: Iterable[TraceEvent], metrics: Collection[str]
) -> Iterator[tuple[float, str]]:
    """Time [s] and object of each contact that the given metrics count."""
    wanted = {True: PEOPLE in metrics, False: not {*THINGS}.isdisjoint(metrics)}
    for event in events:
        for cause in event.because:
            what = cause.text.removeprefix(_BUMPED)
            if what != cause.text and wanted[what in people]:
                yield event.t, what


def of_contacts(history: History, people: Collection[str], metric: str) -> Iterator[str]:
    """Contacts, and why the robot went there; nothing if the trace has none."""
    found = [*bumps(people, history.events, CONTACTS if metric == "touches" else (metric,))]
    for t, what in found[:MOST]:
        yield f"touched   {what} at t={t:.2f} s"
    if found:
        yield from before_bump(history, found[0][0])


def before_bump(history: History, t: float) -> Iterator[str]:
    """Causes of the robot's action one tick before a contact; afterwards it stands because of the contact."""
    return causes.at_time(history, max(0.0, t - causes.TICK_S))
