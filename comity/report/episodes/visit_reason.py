"""Why a visit failed: the last reason, and what kept the robot from the people in its way until then."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.simulation.passages import KEEPS
from comity_executor.memory.visit import PROPER_OUTCOMES
from comity_executor.trees.passing import ASK

if TYPE_CHECKING:
    from collections.abc import Iterator

    from comity.episode import Episode
    from comity_executor import TraceEvent, Visit


def reason_of(visit: Visit, episode: Episode) -> str | None:
    """The reason of a visit that was not served; None of one that was.

    A time limit is followed by the people who were asked in vain before it, and any reason by why the robot
    came no nearer to those who let it pass.
    """
    if not visit.failure or visit.outcome in PROPER_OUTCOMES:
        return visit.failure
    events = [event for event in episode.events if event.person == visit.person]
    asked = set(_asked(events, episode))
    kept = {
        one.about: one.text
        for one in episode.disturbances
        if one.kind == "passage" and one.about in asked and one.text.startswith(KEEPS)
    }
    return "; ".join([visit.failure, *_in_vain(events, visit.failure), *kept.values()])


def _in_vain(events: list[TraceEvent], failure: str) -> Iterator[str]:
    """Who was asked in vain before the time limit that a visit failed by, the last time."""
    limits = (event for event in events if event.action.startswith("Timeout"))
    if not any(cause.text == failure for event in limits for cause in event.because):
        return
    failed = (event for event in events if event.action == "Await_way" and event.status == "failure")
    last = next((event.because[0].text for event in reversed([*failed]) if event.because), None)
    if last is not None:
        yield f"before that, {last}"


def _asked(events: list[TraceEvent], episode: Episode) -> Iterator[str]:
    """Who was asked to let the robot pass on the way to a person."""
    begun_s: float | None = None
    for event in (event for event in events if event.action == "Ask_to_pass"):
        if event.status == "running":
            begun_s = event.t
        elif begun_s is not None:
            yield from (
                act.person for act in episode.acts if act.act == ASK and begun_s <= act.t_start <= event.t
            )
