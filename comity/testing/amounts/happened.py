"""Events that the scenario caused up to a time: changes, faults, its time limit, and walks of people."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from comity.monitoring.measuring import is_of
from comity.specification.change import Change
from comity.specification.fault import (
    LeafRaises,
    PersonInTheWay,
    PersonWalksOff,
    PlannerFails,
    SpeechFails,
    in_words,
)
from comity_executor.trees.tree import VISITED

if TYPE_CHECKING:
    from comity.episode import Episode
    from comity.scenario import Scenario
    from comity.specification.fault import Fault
    from comity_executor import TraceEvent

_OF_WORDS = (SpeechFails, LeafRaises)
"""Faults that do not affect the robot's path."""
_SHOWN = (SpeechFails, LeafRaises, PlannerFails)
"""Faults without effect unless a node fails because of them, such as failed speech while nobody speaks."""


def happened(
    episode: Episode, person: str | None = None, *, until_s: float = math.inf, moving: bool = False
) -> Iterator[str]:
    """What happened to the robot or to people, in order of time, and the limit that ended the run.

    Statements of people are shown with the values that they change.

    Args:
        episode: What happened.
        person: Only events during this person's visit that concern the robot or them; None for the whole run.
        until_s: Later events are left out [s].
        moving: Whether to list only events that move a person or keep the robot from moving.
    """
    scenario = episode.prepared.file.scenario
    since_s, end_s = _visit_span(episode.events, person)
    entries: list[Change | Fault] = [*scenario.changes, *scenario.faults]
    for entry in sorted(entries, key=lambda entry: entry.at_s):
        lasts_s = getattr(entry, "for_s", None) or getattr(entry, "emergency_stop_s", None) or 0.0
        during = entry.at_s < min(until_s, end_s) and entry.at_s + lasts_s >= since_s
        theirs = person is None or getattr(entry, "person", None) in (None, person)
        what = _told(entry)
        counts = _shows(episode.events, entry, until_s) and not (moving and isinstance(entry, _OF_WORDS))
        if what and during and theirs and counts:
            yield f"happened  {what}"
    if episode.outcome == "stopped" and until_s >= episode.history.end_s and person is None:
        yield f"happened  the run was stopped: its limit `time_s` is {scenario.limits.time_s:g} s"


def walking(scenario: Scenario, person: str | None, until_s: float = math.inf) -> tuple[str, ...]:
    """What makes a person walk up to a time, in words; None for anybody."""
    who = (person,) if person else tuple(scenario.people)
    keys = [
        f"{one} has `{key}`"
        for one in who
        for key in ("walks", "reacts", "comfort")
        if getattr(scenario.people[one], key) is not None
    ]
    keys += [
        f"{change.person} has `moves_to_m` at t={change.at_s:g} s"
        for change in scenario.changes
        if change.person in who and change.moves_to_m is not None and change.at_s < until_s
    ]
    keys += [
        f"{fault.person} has the fault `{fault.fault}` at t={fault.at_s:g} s"
        for fault in scenario.faults
        if isinstance(fault, PersonWalksOff | PersonInTheWay) and fault.person in who and fault.at_s < until_s
    ]
    keys += ["there are `passers_by`"] if scenario.passers_by and not person else []
    return tuple(keys)


def _visit_span(events: Iterable[TraceEvent], person: str | None) -> tuple[float, float]:
    """Start and end of a person's visit, from the departure of the robot [s]; the whole run if None."""
    if person is None:
        return 0.0, math.inf
    times = [event.t for event in events if is_of(event, VISITED, person)]
    return (times[0], times[-1]) if times else (0.0, math.inf)


def _shows(events: Iterable[TraceEvent], entry: Change | Fault, until_s: float) -> bool:
    """Whether an entry had a known effect up to a time: the trace names the fault behind a failure."""
    if not isinstance(entry, _SHOWN):
        return True
    because = (cause for event in events if event.t <= until_s for cause in event.because)
    return any(cause.kind == "fault" and cause.text == in_words(entry) for cause in because)


def _told(entry: Change | Fault) -> str | None:
    if not isinstance(entry, Change):
        return in_words(entry)
    if entry.emergency_stop_s is not None:
        return f"the emergency stop was pressed at t={entry.at_s:g} s for {entry.emergency_stop_s:g} s"
    if entry.moves_to_m is not None:
        x_m, y_m = entry.moves_to_m
        return f"{entry.person} went to ({x_m:g}, {y_m:g}) at t={entry.at_s:g} s"
    return None
