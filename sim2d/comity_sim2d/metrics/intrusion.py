"""Intrusion: the robot is within a person's distance while it neither visits nor leaves that person.

This is the only definition; metrics, expectations and pages use it. A person whose distance is unknown, such
as a passer-by, has the default one of routes, `COMFORT_M`. If a person asks for another distance during the
episode, it applies from then on.

Leaving is no intrusion: after a visit the robot is still within the person's distance and has to get out of
it. It has left once it is `GONE_M` outside. It no longer counts as leaving when it comes nearer again by
`GONE_M` or stays where it is.
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
"""Tolerance [m]: the precision of docking. A distance shorter by this still counts as kept."""
GONE_M = 0.1
"""Distance outside a person's own distance at which the robot has left; coming nearer by as much ends
leaving, too [m] (our choice)."""
STAYS_S, STAYS_M = 2.0, 0.01
"""A leaving robot that gains less than `STAYS_M` [m] in `STAYS_S` [s] counts as staying (our choice)."""
TICK_S = 1e-3
"""Times closer together than this are equal [s]: a tick is at least as long."""


Since = tuple[tuple[float, float], ...]
"""Pairs of a time [s] and the distance [m] that applies from then on, in order of time."""


def own_distances_m(times: Numbers, own_m: float, later_m: Since) -> Numbers:
    """The own distance of one person at each time [m]; shape (n,).

    Args:
        times: Ascending times [s].
        own_m: Own distance at the start [m].
        later_m: Distances they asked for later.
    """
    distances = np.full(len(times), own_m)
    for since_s, distance_m in later_m:
        distances[times >= since_s - TICK_S] = distance_m
    return distances


@dataclass(frozen=True, slots=True)
class IntrusionSpan:
    """A stay of the robot within the distance of a person it neither visited nor left."""

    person: str
    start_s: float
    length_s: float
    """Duration from the first frame to the last [s]."""


@dataclass(frozen=True, slots=True)
class Intrusion:
    """Intrusion by frame and person."""

    people: tuple[str, ...]
    own: frozenset[str]
    """People whose own distance is known."""
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
            frames: Frames of the episode.
            gaps: Result of `clearances_m`.
            own_m: Each person's own distance [m], by name; `COMFORT_M` for all others.
            visits: Spans in which the robot was on its way to each person or with them, by name.
            later_m: Distances they asked for later, by name.
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
        """By person with a known own distance: share of the time without a visit spent outside it."""
        return {
            name: _share(~self.intruded[:, i], self.passing[:, i], frames)
            for i, name in enumerate(self.people)
            if name in self.own
        }

    def longest_by_person_s(self, frames: Frames) -> dict[str, float]:
        """By person with a known own distance: longest intrusion [s]; 0 if there was none."""
        longest = {name: self.longest(frames, name) for name in self.people if name in self.own}
        return {name: stay.length_s if stay else 0.0 for name, stay in longest.items()}

    def compliance_share(self, frames: Frames) -> float:
        """Share of all time without any intrusion."""
        nobody = np.logical_not(self.intruded.any(axis=1))
        return _share(nobody, np.ones(len(frames), dtype=np.bool_), frames)

    def stays(self, frames: Frames, person: str) -> Iterator[IntrusionSpan]:
        """All intrusions on one person, by time."""
        yield from _stays(person, frames.time_s, self.intruded[:, self.people.index(person)])

    def longest(self, frames: Frames, person: str | None = None) -> IntrusionSpan | None:
        """The longest intrusion on one person, or on anyone; None if there was none."""
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
    """Share of the counted time in which `held` is true; 1 if no time counts."""
    steps = weights_s(frames)
    whole = float(steps[counted].sum())
    return float(steps[counted & held].sum()) / whole if whole > 0.0 else 1.0


def _stays(person: str, times: Numbers, held: NDArray[np.bool_]) -> Iterator[IntrusionSpan]:
    """The runs of frames in which `held` is true."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], held, [False])).astype(np.int8)))
    for start_s, end_s in zip(times[edges[::2]].tolist(), times[edges[1::2] - 1].tolist(), strict=True):
        yield IntrusionSpan(person, start_s, end_s - start_s)
