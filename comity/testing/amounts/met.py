"""Encounters with walking people: the robot slows down before them, gives way, and goes round them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from comity.monitoring.measuring import turns
from comity.testing.amounts.happened import walking
from comity_sim2d.base.drive import NEAR_PEOPLE_M
from comity_sim2d.metrics import clearances_m

if TYPE_CHECKING:
    from comity.episode import Episode
    from comity_executor import TraceEvent
    from comity_sim2d import Frames


def met(episode: Episode, until_s: float = math.inf) -> Iterator[str]:
    """Walking people who came near the robot while it did not serve them; of passers-by only the nearest.

    Args:
        episode: What happened.
        until_s: Later encounters are left out [s].
    """
    scenario, nearest = episode.prepared.file.scenario, _nearest(episode.frames, episode.events, until_s)
    people = scenario.people
    for name in people:
        if name in nearest and (keys := walking(scenario, name, until_s)):
            yield f"walks     {', '.join(keys)}; {_told(name, *nearest[name])}"
    strangers = [name for name in nearest if name not in people]
    if strangers:
        name = min(strangers, key=nearest.__getitem__)
        yield f"walks     there are `passers_by`; {_told(name, *nearest[name])}"


def _told(name: str, gap_m: float, t: float) -> str:
    return f"{name} was {gap_m:.2f} m from the robot at t={t:.2f} s"


def _nearest(
    frames: Frames, events: Sequence[TraceEvent], until_s: float
) -> Mapping[str, tuple[float, float]]:
    """By person, smallest distance to a robot that slowed down before them [m], and its time [s]."""
    gaps = clearances_m(frames)
    gaps[frames.time_s >= until_s] = math.inf
    for whom, start_s, end_s in turns(events):
        if whom in frames.entities:
            about = (frames.time_s >= start_s) & (frames.time_s < end_s)
            gaps[about, frames.entities.index(whom) - 1] = math.inf
    rows = np.argmin(gaps, axis=0)
    found = {
        name: (float(gaps[row, i]), float(frames.time_s[row]))
        for i, (name, row) in enumerate(zip(frames.entities[1:], rows, strict=True))
    }
    return {name: (gap_m, t) for name, (gap_m, t) in found.items() if gap_m < NEAR_PEOPLE_M}
