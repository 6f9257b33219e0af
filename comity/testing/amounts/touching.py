"""What the robot bumped into, and when: a touch presses its stop, and so the trace has it."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from typing import TYPE_CHECKING

from comity.testing.amounts import causes

if TYPE_CHECKING:
    from comity_executor import History, TraceEvent

_BUMPED = "bumped into "
"""How the trace tells of a touch."""
PEOPLE, THINGS = "person_contacts", ("wall_contacts", "furniture_contacts")
CONTACTS = (PEOPLE, *THINGS, "touches")
"""The metrics of an episode that count touches."""
MOST = 5
"""So many are told (our choice)."""


def bumps(
    people: Collection[str], events: Iterable[TraceEvent], metrics: Collection[str]
) -> Iterator[tuple[float, str]]:
    """When the robot bumped into something [s], and into what: into what these metrics count."""
    wanted = {True: PEOPLE in metrics, False: not {*THINGS}.isdisjoint(metrics)}
    for event in events:
        for cause in event.because:
            what = cause.text.removeprefix(_BUMPED)
            if what != cause.text and wanted[what in people]:
                yield event.t, what


def of_contacts(history: History, people: Collection[str], metric: str) -> Iterator[str]:
    """What was touched, and why the robot went there; nothing where the trace has no touch."""
    found = [*bumps(people, history.events, CONTACTS if metric == "touches" else (metric,))]
    for t, what in found[:MOST]:
        yield f"touched   {what} at t={t:.2f} s"
    if found:
        yield from before_bump(history, found[0][0])


def before_bump(history: History, t: float) -> Iterator[str]:
    """Why the robot did what it did a tick before a touch: from then on it stands still because of that."""
    return causes.at_time(history, max(0.0, t - causes.TICK_S))
