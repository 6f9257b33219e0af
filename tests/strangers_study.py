"""Learning with people whom the learner was not made for, beside other ways to choose a distance.

`python tests/strangers_study.py` prints the table of docs/explanation/learning.md. How these people feel,
what they show and how they change is written here and shares no code with what the robot believes about
them: their ease fades linearly, their likes are not the middle of their interval, and some signals mean
nothing. All of it is invented, and there is no physics: the robot stands exactly where it wants to.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

from comity_fis.learning.comfort import ComfortPosterior
from comity_fis.learning.signals import SIGNALS

if TYPE_CHECKING:
    from comity_fis.learning.signals import Signal

Floats = NDArray[np.float64]
Signals = NDArray[np.int64]

SPREAD_M = 0.30
MODEL_M = 0.85
"""Distance between the bodies that the model gives."""
HELD_OUT = 9001
"""The seed of the table. What the robot believes was set with people of other seeds."""
VISITS, DAYS = 10, 30
SHOWN_VISITS = (1, 2, 4, 10)
"""The visits of the table."""
ANSWER_M = 0.10
"""Standard deviation of an answer around what the person likes."""
WORSE_M = 0.05
"""Standing worse than at the model's value by less is not called worse."""
FADING_M = 0.20
"""So far outside their interval a person is as uncomfortable as they can be."""
SELDOM_READ = 0.04
"""Share of moments in which the robot takes one signal for any other."""
HABIT = 0.5
"""Share of the visits at which a person with a habit follows it, whatever they feel."""


@dataclass(frozen=True, slots=True)
class Population:
    """What sets the people of one population apart; distances from the model's value [m]."""

    habits: Mapping[tuple[Signal, ...], float]
    """The share of people who show one of these signals at half of the visits, whatever they feel."""
    heavy_tails: bool = False
    drift_m: float = 0.0
    """Standard deviation of the change from visit to visit."""


INVITE: tuple[Signal, ...] = ("ask_closer", "lean_in")
TO_HEAR: tuple[Signal, ...] = ("lean_in",)
MAKE_ROOM: tuple[Signal, ...] = ("step_back",)
POPULATIONS: Mapping[str, Population] = {
    "show what they feel": Population({}),
    "some invite": Population({INVITE: 0.3}),
    "some lean in to hear": Population({TO_HEAR: 0.3}),
    "some make room": Population({MAKE_ROOM: 0.3}),
    "drift": Population({}, drift_m=0.05),
    "heavy tails": Population({}, heavy_tails=True),
    "all of it": Population({INVITE: 0.15, TO_HEAR: 0.15, MAKE_ROOM: 0.15}, heavy_tails=True, drift_m=0.05),
}


class People:
    """Many people: what they like, what they show, how they change. Arrays have one entry for each."""

    def __init__(self, population: Population, count: int, rng: np.random.Generator) -> None:
        self._rng, self._drift_m = rng, population.drift_m
        self._to_near_m = rng.gamma(4.0, 0.04, count)
        drawn = rng.standard_t(3.0, count) * 0.882 if population.heavy_tails else rng.standard_normal(count)
        self.best_m: Floats = np.maximum(SPREAD_M * drawn, self._to_near_m - MODEL_M)
        """Most liked distance; the nearest that they like is no overlap of bodies."""
        self._to_far_m = rng.gamma(4.0, 0.05, count)
        self._open = np.where(rng.random(count) < 0.2, 0.0, rng.beta(2.0, 1.5, count))
        """How often a person shows a great discomfort; a fifth never do."""
        self._of_close = rng.dirichlet((2.0, 1.0, 1.0), count)
        self._of_far = rng.dirichlet((1.5, 1.0), count)
        """Which signals a person uses."""
        self._habit = rng.choice(
            len(population.habits) + 1,
            count,
            p=[*population.habits.values(), 1.0 - sum(population.habits.values())],
        )
        self._habits = tuple(population.habits)

    @property
    def nearest_m(self) -> Floats:
        """Nearest distance at which they are at ease."""
        return self.best_m - self._to_near_m

    def change(self) -> None:
        """Until the next visit."""
        moved = self.best_m + self._drift_m * self._rng.standard_normal(len(self.best_m))
        self.best_m = np.maximum(moved, self._to_near_m - MODEL_M)

    def show(self, at_m: Floats) -> Signals:
        """What the robot notices at a distance, by number in `SIGNALS`."""
        rng, count = self._rng, len(at_m)
        close = np.clip((self.nearest_m - at_m) / FADING_M, 0.0, 1.0)
        far = np.clip((at_m - self.best_m - self._to_far_m) / FADING_M, 0.0, 1.0)
        says_close, says_far = _of("step_back", "ask_farther", "turn_away"), _of("lean_in", "ask_closer")
        shown = np.full(count, SIGNALS.index("nothing"))
        speaks = rng.random(count)
        shown = np.where(speaks < self._open * close, says_close[_chosen(self._of_close, rng)], shown)
        shown = np.where(speaks < self._open * far, says_far[_chosen(self._of_far, rng)], shown)
        for number, habit in enumerate(self._habits):
            follows = (self._habit == number) & (rng.random(count) < HABIT)
            shown = np.where(follows, rng.choice(_of(*habit), count), shown)
        misread = rng.random(count) < SELDOM_READ
        return np.where(misread, rng.integers(0, len(SIGNALS), count), shown)

    def answer(self) -> Floats:
        """What they say when they are asked for the distance that they like."""
        return self.best_m + ANSWER_M * self._rng.standard_normal(len(self.best_m))


class Way(Protocol):
    """A way to choose a distance; the model's value is 0."""

    def places(self, people: People) -> Floats:
        """Where to stand at this visit."""

    def notice(self, signals: Signals, at_m: Floats) -> None:
        """What was shown there."""


class Ours:
    """What Comity does."""

    def __init__(self, count: int) -> None:
        self.known = ComfortPosterior.before_meeting(SPREAD_M, (count,))

    def places(self, people: People) -> Floats:
        """As the posterior has it."""
        return self.known.offset

    def notice(self, signals: Signals, at_m: Floats) -> None:
        """Learn, and wait for the next visit."""
        self.known = self.known.after(signals, at_m).later(DAYS)

    def covered(self, people: People) -> Floats:
        """Whether the most liked distance lies in the 90 % interval."""
        low, high = self.known.interval()
        return np.asarray((low <= people.best_m) & (people.best_m <= high), dtype=np.float64)


class Staircase:
    """12 cm back for a step back or a request, 8 cm nearer for an invitation, else stay."""

    def __init__(self, count: int) -> None:
        self._at_m = np.zeros(count)

    def places(self, people: People) -> Floats:
        """Where the last step led."""
        return self._at_m

    def notice(self, signals: Signals, at_m: Floats) -> None:
        """One step."""
        back = np.isin(signals, _of("step_back", "ask_farther"))
        nearer = np.isin(signals, _of("lean_in", "ask_closer"))
        self._at_m = at_m + 0.12 * back - 0.08 * nearer


class AskedOnce:
    """One question before the first visit, and its answer for ever."""

    def __init__(self, count: int) -> None:
        self._said_m: Floats | None = None

    def places(self, people: People) -> Floats:
        """What was said."""
        if self._said_m is None:
            self._said_m = people.answer()
        return self._said_m

    def notice(self, signals: Signals, at_m: Floats) -> None:
        """Nothing."""


class Prior(AskedOnce):
    """The model's value for ever."""

    def places(self, people: People) -> Floats:
        """0."""
        return np.zeros_like(people.best_m)


class Oracle(AskedOnce):
    """What the person likes most on that day."""

    def places(self, people: People) -> Floats:
        """Just there."""
        return people.best_m


WAYS: Mapping[str, Callable[[int], Way]] = {
    "ours": Ours,
    "asked once": AskedOnce,
    "staircase": Staircase,
    "prior": Prior,
    "oracle": Oracle,
}


@dataclass(frozen=True, slots=True)
class Result:
    """What came of one way with one population, by visit."""

    error_m: Floats
    covered: Floats
    """Share whose most liked distance lay in the 90 % interval; NaN where the way has none."""
    worse: Floats
    """Share who stood worse than at the model's value, by more than `WORSE_M`."""
    closer: Floats
    """Share to whom the robot came closer than they like."""


def study(population: str, way: str, *, count: int = 4000, seed: int = HELD_OUT) -> Result:
    """Visit everybody of a population again and again; the same seed draws the same people."""
    people = People(POPULATIONS[population], count, np.random.default_rng(seed))
    robot, rows = WAYS[way](count), []
    for _ in range(VISITS):
        at_m = robot.places(people)
        error_m = np.abs(at_m - people.best_m)
        covered = robot.covered(people) if isinstance(robot, Ours) else np.full(count, np.nan)
        worse = error_m > np.abs(people.best_m) + WORSE_M
        rows.append([error_m.mean(), covered.mean(), worse.mean(), (at_m < people.nearest_m).mean()])
        robot.notice(people.show(at_m), at_m)
        people.change()
    return Result(*np.array(rows).T)


def table() -> Iterator[str]:
    """The table of the documentation, but for the oracle, all of whose numbers are 0."""
    yield f"| population | way | {' | '.join(('error [cm]', 'in the interval', 'worse', 'too close'))} |"
    yield "|---" * 6 + "|"
    for population in POPULATIONS:
        for way in [way for way in WAYS if way != "oracle"]:
            got = study(population, way)
            cells = (
                " / ".join(f"{100 * values[visit - 1]:.{digits}f}" for visit in SHOWN_VISITS)
                if np.isfinite(values).all()
                else ""
                for values, digits in ((got.error_m, 0), (got.covered, 0), (got.worse, 1), (got.closer, 1))
            )
            yield f"| {population} | {way} | {' | '.join(cells)} |"


def _of(*signals: Signal) -> Signals:
    return np.array([SIGNALS.index(signal) for signal in signals])


def _chosen(shares: Floats, rng: np.random.Generator) -> Signals:
    """A column for each row, as often as its share says."""
    return (np.cumsum(shares, axis=1)[:, :-1] < rng.random((len(shares), 1))).sum(axis=1)


if __name__ == "__main__":
    print(*table(), sep="\n")
