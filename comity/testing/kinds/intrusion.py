"""Whether the robot stays out of the distance of people whom it is not visiting."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

import numpy as np

from comity.monitoring.measuring import turns
from comity.monitoring.told import later_distances_m
from comity.parameters.passing import own_distance_m
from comity.testing.expectation import Finding
from comity.testing.metrics import causes
from comity.testing.metrics.amount import Amount
from comity.testing.metrics.moments import of_their_way
from comity_sim2d.metrics import clearances_m, own_distances_m
from comity_sim2d.navigation.route_map import COMFORT_M

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from comity.testing.trials.trial import Trial

PARAMETER = "conversational_distance"
HOLDING_M = 0.01
"""The robot holds its place to within a centimetre: so much nearer is no intrusion."""
GONE_M = 0.1
"""A robot that takes its leave has left when it is so much farther away, and no longer takes it when it has
come so much nearer again."""
STAYS_S, STAYS_M = 2.0, 0.01
"""One that has come no farther away by so much in so long stays there, and does not leave (our choice)."""
_TICK_S = 1e-3


@dataclass(frozen=True, slots=True)
class Intrusion:
    """A person's distance is where they would have the robot stop: the conversational distance.

    Whoever asks for another one on the way has that one from then on. Passers-by, of whom none is known, have
    the same one as for routes and metrics.
    """

    RULE: ClassVar[str] = (
        "NO _INTRUSION [_INTO (_BYSTANDER | NAME) _POSSESSED _DISTANCE] _FOR _LONGER_THAN amount"
    )
    EXAMPLE: ClassVar[str] = "no intrusion into a bystander's distance for longer than 1 s"

    person: str | None
    """None for everybody, passers-by among them, each while the robot is not visiting them."""
    longest_s: float

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """From `no`, a name and an amount."""
        _, *names, longest = parts
        assert isinstance(longest, Amount)
        return cls(names[0] if names else None, longest.size("s"))

    @property
    def people(self) -> Sequence[str]:
        """The one whom it names."""
        return (self.person,) if self.person else ()

    def judge(self, trial: Trial) -> Iterator[Finding]:
        """Everybody to whom the robot came too near for too long."""
        for person in self.people or everybody(trial):
            yield from self._judge(trial, person)

    def _judge(self, trial: Trial, person: str) -> Iterator[Finding]:
        start, length, nearest = longest_intrusion(trial, person)
        if length > self.longest_s + _TICK_S:
            wanted = float(_own_m(trial, person)[trial.episode.frames.time_s >= start][0])
            yield Finding(
                f"{wanted:.3f} m from {person}, or nearer for at most {self.longest_s:g} s",
                f"{nearest:.3f} m, nearer for {length:.2f} s from t={start:.2f} s on",
                (
                    *of_their_way(trial, person, start + length),
                    *causes.at_time(trial, start),
                    *_of_value(trial, person, start),
                ),
            )


def _of_value(trial: Trial, person: str, start_s: float) -> Iterator[str]:
    if person in trial.prepared.values:
        yield from causes.of_parameter(trial, PARAMETER, person, start_s)


def everybody(trial: Trial) -> tuple[str, ...]:
    """The people of the scenario, then the passers-by."""
    return trial.episode.frames.entities[1:]


def _own_m(trial: Trial, person: str) -> NDArray[np.float64]:
    """How far from somebody a robot that is not visiting them should stay in each frame, between surfaces."""
    values = trial.prepared.values.get(person)
    start_m = COMFORT_M if values is None else own_distance_m(values)
    later = later_distances_m(trial.episode.told).get(person, ())
    return own_distances_m(trial.episode.frames.time_s, start_m, later)


def longest_intrusion(trial: Trial, person: str) -> tuple[float, float, float]:
    """The longest time in somebody's distance while the robot was not visiting them.

    Returns:
        When it began [s], how long it lasted from its first frame to its last [s], and how near the robot
        came [m].
    """
    frames = trial.episode.frames
    gap = clearances_m(frames)[:, frames.entities.index(person) - 1]
    inside = (gap < _own_m(trial, person) - HOLDING_M) & ~visiting(trial, person)
    edges = np.flatnonzero(np.diff(np.concatenate(([False], inside, [False])).astype(int)))
    stays = [
        (float(frames.time_s[end - 1] - frames.time_s[start]), int(start), int(end))
        for start, end in zip(edges[::2], edges[1::2], strict=True)
    ]
    if not stays:
        return 0.0, 0.0, float(gap.min(initial=np.inf))
    length, start, end = max(stays)
    return float(frames.time_s[start]), length, float(gap[start:end].min())


def visiting(trial: Trial, person: str) -> NDArray[np.bool_]:
    """In which frames the robot is on its way to somebody, with them, or turns away from them.

    From the end of the visit before, until the robot has left the person's distance after the visit.
    """
    frames, visit = trial.episode.frames, trial.visit(person)
    stood_before = (visit.together_with if visit else None) or person
    times = frames.time_s
    now = np.zeros(len(times), dtype=bool)
    for whom, start, end in turns(trial.episode.events):
        if whom == stood_before:
            now |= (times >= start - _TICK_S) & (times < end)
            now |= _leaving(trial, person, end)
    return now


def _leaving(trial: Trial, person: str, since_s: float) -> NDArray[np.bool_]:
    """The frames from a time on until the robot has left somebody, stays, or comes nearer again."""
    frames = trial.episode.frames
    gap = clearances_m(frames)[:, frames.entities.index(person) - 1]
    after = frames.time_s >= since_s
    farthest = np.maximum.accumulate(np.where(after, gap, -np.inf))
    earlier = farthest[np.searchsorted(frames.time_s, frames.time_s - STAYS_S)]
    stays = (frames.time_s >= since_s + STAYS_S) & (farthest < earlier + STAYS_M)
    over = after & ((gap >= _own_m(trial, person) + GONE_M) | (gap < farthest - GONE_M) | stays)
    until = frames.time_s[int(np.argmax(over))] if over.any() else float("inf")
    return np.asarray(after & (frames.time_s <= until))
