"""Whether the robot stays out of the distance of people whom it is not visiting."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

import numpy as np

from comity.monitoring.told import later_distances_m
from comity.parameters.passing import own_distance_m
from comity.testing.expectation import Finding
from comity.testing.metrics import causes
from comity.testing.metrics.amount import Amount
from comity.testing.metrics.moments import intrusion, of_their_way
from comity_sim2d.metrics import clearances_m, own_distances_m
from comity_sim2d.navigation.route_map import COMFORT_M

if TYPE_CHECKING:
    from comity.testing.trials.trial import Trial
    from comity_sim2d.metrics.intrusion import Stay

PARAMETER = "conversational_distance"
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
        judged = intrusion(trial)
        for person in self.people or judged.people:
            stay = judged.longest(trial.episode.frames, person)
            if stay is not None and stay.length_s > self.longest_s + _TICK_S:
                yield self._found(trial, stay)

    def _found(self, trial: Trial, stay: Stay) -> Finding:
        """How near, for how long, and why."""
        frames = trial.episode.frames
        during = (frames.time_s >= stay.start_s) & (frames.time_s <= stay.start_s + stay.length_s)
        gaps = clearances_m(frames)[during, frames.entities.index(stay.person) - 1]
        return Finding(
            f"{_own_m(trial, stay):.3f} m from {stay.person}, or nearer for at most {self.longest_s:g} s",
            f"{gaps.min():.3f} m, nearer for {stay.length_s:.2f} s from t={stay.start_s:.2f} s on",
            (
                *of_their_way(trial, stay.person, stay.start_s + stay.length_s),
                *causes.at_time(trial, stay.start_s),
                *_of_value(trial, stay.person, stay.start_s),
            ),
        )


def _own_m(trial: Trial, stay: Stay) -> float:
    """The distance that the person likes as the stay begins [m]."""
    values = trial.prepared.values.get(stay.person)
    start_m = COMFORT_M if values is None else own_distance_m(values)
    later = later_distances_m(trial.episode.told).get(stay.person, ())
    return float(own_distances_m(np.array([stay.start_s]), start_m, later)[0])


def _of_value(trial: Trial, person: str, start_s: float) -> Iterator[str]:
    if person in trial.prepared.values:
        yield from causes.of_parameter(trial, PARAMETER, person, start_s)
