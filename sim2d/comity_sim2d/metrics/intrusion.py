"""Intrusion: the robot is within a person's distance while it neither visits nor leaves that person.

This is the one definition; metrics, expectations and pages use it. A person of whom no distance is known,
such as a passer-by, has the one that routes use: `COMFORT_M`. A person who asks for another distance on the
way is judged by it from then on.

Leaving is no intrusion: after a visit the robot is still within the person's distance and has to get out of
it. It has left once it is `GONE_M` outside, and it no longer leaves when it comes nearer again by as much or
stays where it is.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from comity_fis.proxemics import COMFORT_M
from comity_sim2d.frames import Frames
from comity_sim2d.metrics.motion import Numbers, Span, within
from comity_sim2d.metrics.proximity import weights_s

SLACK_M = 0.01
"""So much nearer than their own distance still counts as keeping it: the precision of docking."""
GONE_M = 0.1
"""Distance outside a person's own at which the robot has left; nearing by as much ends leaving, too [m]
(our choice)."""
STAYS_S, STAYS_M = 2.0, 0.01
"""Time in which a leaving robot that has come no farther away by `STAYS_M` stays there [s] (our choice)."""
TICK_S = 1e-3
"""Times within it are one: a tick is at least as long."""


Since = tuple[tuple[float, float], ...]
"""Since when [s] which distance [m] holds, in order of time."""


def own_distances_m(times: Numbers, own_m: float, later_m: Since) -> Numbers:
    """How far one person likes the robot to stay at each time [m]; shape (n,).

    Args:
        times: In order [s].
        own_m: At the start.
        later_m: What they asked for on the way.
    """
    distances = np.full(len(times), own_m)
    for since_s, distance_m in later_m:
        distances[times >= since_s - TICK_S] = distance_m
    return distances


@dataclass(frozen=True, slots=True)
class IntrusionSpan:
    """The robot within the distance of a person with whom it had no business."""

    person: str
    start_s: float
    length_s: float
    """From the first frame to the last."""


@dataclass(frozen=True, slots=True)
class Intrusion:
    """Frame by frame, for each person."""

    people: tuple[str, ...]
    own: frozenset[str]
    """Whose distance is their own."""
    passing: NDArray[np.bool_]
    """Shape (n, people): the robot neither visits nor leaves this person."""
    intruded: NDArray[np.bool_]
    """Shape (n, people): passing, and nearer than the person likes."""

    @classmethod
    def of(
        cls,
        frames: Frames,
        gaps: Numbers,
        own_m: Mapping[str, float],
        visits: Mapping[str, Sequence[Span]],
        later_m: Mapping[str, Since],
    ) -> Intrusion:
        """Judge every frame.

        Args:
            frames: What happened.
            gaps: Of `clearances_m`.
            own_m: The distance that each person likes, by name; `COMFORT_M` for people who are not in it.
            visits: When the robot was on its way to each person or with them, by name.
            later_m: What they asked for on the way, by name.
        """
        people = frames.entities[1:]
        shape = (len(frames), len(people))
        passing, near = np.ones(shape, dtype=np.bool_), np.zeros(shape, dtype=np.bool_)
        for i, name in enumerate(people):
            own = own_distances_m(frames.time_s, own_m.get(name, COMFORT_M), later_m.get(name, ()))
            near[:, i] = gaps[:, i] < own - SLACK_M
            for visit in visits.get(name, ()):
                passing[:, i] &= ~within(frames.time_s, [visit])
                passing[:, i] &= ~_leaving(frames.time_s, gaps[:, i], own, visit.end_s)
        return cls(people, frozenset((*own_m, *later_m)), passing, passing & near)

    def compliance_by_person(self, frames: Frames) -> dict[str, float]:
        """For each whose own distance is known, the share of the time without a visit that was outside it."""
        return {
            name: _share(~self.intruded[:, i], self.passing[:, i], frames)
            for i, name in enumerate(self.people)
            if name in self.own
        }

    def longest_by_person_s(self, frames: Frames) -> dict[str, float]:
        """For each whose own distance is known, the longest stay within it [s]; 0 where there was none."""
        longest = {name: self.longest(frames, name) for name in self.people if name in self.own}
        return {name: stay.length_s if stay else 0.0 for name, stay in longest.items()}

    def compliance_share(self, frames: Frames) -> float:
        """The share of all time in which nobody's distance was intruded on."""
        nobody = np.logical_not(self.intruded.any(axis=1))
        return _share(nobody, np.ones(len(frames), dtype=np.bool_), frames)

    def stays(self, frames: Frames, person: str) -> Iterator[IntrusionSpan]:
        """All stays within the distance of one person, by time."""
        yield from _stays(person, frames.time_s, self.intruded[:, self.people.index(person)])

    def longest(self, frames: Frames, person: str | None = None) -> IntrusionSpan | None:
        """The longest stay within the distance of a person, or of one; None where there was none."""
        stays = (stay for name in self.people if person in (None, name) for stay in self.stays(frames, name))
        return max(stays, key=lambda stay: stay.length_s, default=None)


def _leaving(times: Numbers, gaps: Numbers, own: Numbers, since_s: float) -> NDArray[np.bool_]:
    """The frames from the end of a visit until the robot has left, stays, or comes nearer again."""
    after = times >= since_s - TICK_S
    farthest = np.maximum.accumulate(np.where(after, gaps, -np.inf))
    earlier = farthest[np.searchsorted(times, times - STAYS_S)]
    stays = (times >= since_s + STAYS_S) & (farthest < earlier + STAYS_M)
    over = after & ((gaps >= own + GONE_M) | (gaps < farthest - GONE_M) | stays)
    until_s = times[int(np.argmax(over))] if over.any() else np.inf
    return np.asarray(after & (times <= until_s))


def _share(held: NDArray[np.bool_], counted: NDArray[np.bool_], frames: Frames) -> float:
    """The share in time of what held; 1 where no time counts."""
    steps = weights_s(frames)
    whole = float(steps[counted].sum())
    return float(steps[counted & held].sum()) / whole if whole > 0.0 else 1.0


def _stays(person: str, times: Numbers, held: NDArray[np.bool_]) -> Iterator[IntrusionSpan]:
    """The runs of frames that held."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], held, [False])).astype(np.int8)))
    for start_s, end_s in zip(times[edges[::2]].tolist(), times[edges[1::2] - 1].tolist(), strict=True):
        yield IntrusionSpan(person, start_s, end_s - start_s)
