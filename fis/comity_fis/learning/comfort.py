"""What meetings tell about the interval of a parameter in which one person is comfortable.

Everything is counted from the value that the model gives in the situation at hand: 0 is that value, negative
is nearer. The person's own interval has a middle, what they would like best, and a half width. The prior of
the middle has the rulebook's spread, and heavy tails; a signal is evidence of one end of the interval (see
`showing`); between visits the middle drifts. The posterior is a sum over a grid of middles, half widths and
manners: how often the person shows anything at all, and whether they show the opposite. The mathematics
stands in docs/explanation/learning.md; what standing in a wrong place costs, in `comfort_loss`.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from comity_fis.learning.comfort_loss import losses
from comity_fis.learning.showing import MISREAD, WHEN_HABITUAL, feelings, noticed
from comity_fis.learning.signals import AWAY, SIGNALS, WORDS, Signal

Floats = NDArray[np.float64]

# All in units of the spread, so that they hold for any parameter, and all our own choice. A spread of 0.30 m
# makes the edge 3 cm, the half width about 15 cm, a step nearer 15 cm, the drift 12 cm in 100 days.
MIDDLES: Floats = np.linspace(-4.0, 4.0, 121)
HALF_WIDTHS: Floats = np.array([0.2, 0.35, 0.5, 0.7, 1.0])
EDGE = 0.1
"""How much the ends of one person's interval differ from day to day."""
INVITES: frozenset[Signal] = frozenset({"ask_closer", "lean_in"})
STEP_NEARER = 0.5
"""Most that one invitation brings the robot nearer; without an answer to the question, most that all do."""
STEP_FARTHER = 1.0 / 6.0
"""Least that a step back or a request for more distance moves the robot out: as little as is noticed."""
FARTHEST = 2.0
"""A personal offset is never larger, unless the person stepped back there."""
PLACES: Floats = np.linspace(-FARTHEST, FARTHEST, 241)
"""Where the robot may choose to stand, half a centimetre apart with a spread of 0.30 m."""
DRIFT = 0.04
"""Standard deviation of the change of the middle in one day."""
ANSWER = 1.0 / 3.0
"""Standard deviation of the distance that a person names around the one that they like: two answers of one
person then correlate by 1 / (1 + ANSWER**2) = 0.9 between people. Our own choice too."""
WITHIN = 0.1
"""An invitation from so little beyond a boundary was given at it."""

CHANCES: Floats = np.array([0.0, 0.3, 0.6, 0.9, 0.6, 0.0])
"""How often a person shows a discomfort at all, by manner."""
CONTRARY = np.array([False, False, False, False, True, False])
"""Whether people of this manner show what others show for the opposite discomfort."""
HABITUAL = np.array([False, False, False, False, False, True])
"""Whether what people of this manner show means nothing: they invite, lean in or make room by habit."""
MANNER_WEIGHTS: Floats = np.array([0.19, 0.21, 0.24, 0.18, 0.06, 0.12])
"""Some people never show anything: silence alone never makes anything less likely than 0.19 times its prior.
A few may mean the opposite of what they show, and some mean nothing by it."""
UNUSUAL_SHARE, UNUSUAL_SPREADS = 0.11, 2.0
"""The prior of the middle has heavy tails: so many people are spread so much wider around the model's value,
because the model may be wrong about them."""


@dataclass(frozen=True, slots=True, eq=False)
class ComfortPosterior:
    """A posterior over one person's comfort interval, or over many people's at once.

    `ComfortPosterior.before_meeting` is where everybody starts. Arrays have the shape of the people, `()`
    for one.
    """

    spread: float
    """Standard deviation of people around the model's value, in the parameter's unit."""
    weights: Floats
    """Shape (..., middles, half widths, manners); every person's add up to 1."""
    nearest: Floats
    """How near the robot may come uninvited, shape (...), in the parameter's unit."""
    asked: NDArray[np.bool_]
    """Whether they ever said themselves what they like, shape (...)."""
    believed: NDArray[np.bool_]
    """Whether they last spoke, or showed nothing nearer than the model's value, shape (...)."""
    said: Floats
    """How near invitations may bring the robot, shape (...): to the answer, or one step from the value."""
    held: Floats
    """How near it may come since a step back or a request for distance, shape (...); -inf without any."""

    @classmethod
    def before_meeting(cls, spread: float, shape: tuple[int, ...] = ()) -> ComfortPosterior:
        """Nothing is known but the model's value and its spread.

        Args:
            spread: Standard deviation of people around the value, above 0.
            shape: Of the people, where they are many.
        """
        prior = _prior()
        weights = np.broadcast_to(prior, (*shape, *prior.shape))
        return cls(
            spread,
            weights,
            nearest=np.zeros(shape),
            asked=np.zeros(shape, dtype=np.bool_),
            believed=np.zeros(shape, dtype=np.bool_),
            said=np.full(shape, -STEP_NEARER * spread),
            held=np.full(shape, -np.inf),
        )

    def later(self, days: float) -> ComfortPosterior:
        """The same person so many days later: preferences drift, and what was learnt fades into the prior."""
        if days <= 0.0:
            return self
        flat = self.weights.reshape(*self.weights.shape[:-2], -1)
        return replace(self, weights=(_drift(float(days)) @ flat).reshape(self.weights.shape))

    def after(self, signal: Signal | ArrayLike, offset: ArrayLike) -> ComfortPosterior:
        """The posterior after one observation.

        Args:
            signal: What was noticed, by name, or by its number in `SIGNALS`, shape (...).
            offset: Where the robot stood, from the model's value, shape (...).
        """
        numbers = np.asarray(SIGNALS.index(signal) if isinstance(signal, str) else signal)
        at = np.asarray(offset, dtype=np.float64)
        # Bayes' rule on a grid over middle, half width and manner: the likelihood is neither normal nor has
        # one peak (silence is evidence of both "at ease" and "never shows anything"), so that no conjugate
        # prior and no Kalman filter fits, and three coordinates are few enough to sum over. Manners are
        # part of the hypothesis, because the same signal means the opposite, or nothing, with some people;
        # summing over them keeps one odd signal from outweighing many visits. What the person allowed
        # (`nearest`, `held`) is carried apart from the belief: a bound is a promise, which only the person
        # moves, by an invitation or a word, and no inference.
        near, far = MIDDLES[:, None] - HALF_WIDTHS, MIDDLES[:, None] + HALF_WIDTHS
        felt = feelings(at[..., None, None] / self.spread, near, far, EDGE)
        close, far_off = (feeling[..., None] for feeling in felt)
        shown_as = np.where(CONTRARY, far_off, close), np.where(CONTRARY, close, far_off)
        chosen = numbers[..., None, None, None]
        meant = noticed(chosen, *shown_as, CHANCES)
        weights = self.weights * np.where(HABITUAL, WHEN_HABITUAL[chosen], meant)
        total = weights.sum(axis=(-3, -2, -1), keepdims=True)
        held = self._held_after(numbers, at)
        nearest = np.maximum(self._nearest_after(numbers, at), np.maximum(self.said, held))
        at_ease = _IS_QUIET[numbers] & (at < -WITHIN * self.spread)
        return replace(
            self,
            weights=weights / total,
            nearest=nearest,
            held=held,
            believed=_SPOKEN[numbers] | at_ease,
        )

    def after_answer(self, offset: ArrayLike) -> ComfortPosterior:
        """The posterior after the person said, asked about it, which distance they like best.

        What they name is the middle of their interval, normally distributed around it with `ANSWER`; a share
        of `MISREAD` of all answers was misunderstood and could be any. They have decided how near the robot
        may come: no nearer than they said, whatever they show later, and as near as that without a further
        invitation. A step back from before no longer holds.

        Args:
            offset: What they named, from the model's value, shape (...).
        """
        at = np.asarray(offset, dtype=np.float64)
        off = (at[..., None] / self.spread - MIDDLES) / ANSWER
        meant = np.exp(-(off**2) / 2.0) / (ANSWER * np.sqrt(2.0 * np.pi))
        likelihood = (1.0 - MISREAD) * meant + MISREAD / (MIDDLES[-1] - MIDDLES[0])
        weights = self.weights * likelihood[..., None, None]
        return replace(
            self,
            weights=weights / weights.sum(axis=(-3, -2, -1), keepdims=True),
            nearest=np.broadcast_to(at, self.nearest.shape),
            asked=np.ones_like(self.asked),
            said=np.broadcast_to(at, self.said.shape),
            held=np.full(self.held.shape, -np.inf),
        )

    @property
    def offset(self) -> Floats:
        """Where to stand next, from the model's value.

        It is the one of `PLACES` that is expected to cost least; and never nearer than the person allowed.
        Harm does not count after an answer, nor after words, nor while they are at ease with it nearer.
        """
        of_middles = self.weights.sum(axis=(-2, -1))
        shown, said = ((of_middles @ costs.T).argmin(axis=-1) for costs in _losses())
        best = PLACES[np.where(self.asked | self.believed, said, shown)]
        return np.asarray(np.maximum(best * self.spread, self.nearest))

    @property
    def deviation(self) -> Floats:
        """Standard deviation of the middle."""
        of_middles = self.weights.sum(axis=(-2, -1))
        mean = of_middles @ MIDDLES
        return np.asarray(self.spread * np.sqrt(of_middles @ MIDDLES**2 - mean**2))

    def quantile(self, probability: ArrayLike) -> Floats:
        """Of the middle of the interval, from the model's value, interpolated between points of the grid."""
        wanted = np.asarray(probability, dtype=np.float64)
        mass = self.weights.sum(axis=(-2, -1))
        edges = np.concatenate([np.zeros((*mass.shape[:-1], 1)), np.cumsum(mass, axis=-1)], axis=-1)
        cell = np.minimum((edges[..., 1:] < wanted[..., None]).sum(axis=-1), len(MIDDLES) - 1)
        below = np.take_along_axis(edges, cell[..., None], -1)[..., 0]
        inside = np.take_along_axis(mass, cell[..., None], -1)[..., 0]
        width = MIDDLES[1] - MIDDLES[0]
        return np.asarray(self.spread * (MIDDLES[cell] + width * ((wanted - below) / inside - 0.5)))

    def interval(self, share: float = 0.9, nearest: float = -np.inf) -> tuple[Floats, Floats]:
        """Where the middle lies with so much probability, as much of the rest on either side.

        Args:
            share: In (0, 1).
            nearest: What is possible: given that the middle is no nearer, from the model's value.
        """
        cells = np.clip((nearest / self.spread - MIDDLES) / (MIDDLES[1] - MIDDLES[0]) + 0.5, 0.0, 1.0)
        out = (self.weights.sum(axis=(-2, -1)) * cells).sum(axis=-1)
        low, high = (
            self.quantile(out + (1.0 - out) * end) for end in ((1.0 - share) / 2.0, (1.0 + share) / 2.0)
        )
        return low, high

    def _held_after(self, numbers: NDArray[np.int64], at: Floats) -> Floats:
        """How near the robot may come since a step back or a request for distance, until they say otherwise.

        It counts at once, whatever they said before: at the next visit the robot stands farther out by
        `STEP_FARTHER`, within `FARTHEST`. A request to come closer moves that in by a step; no gesture does.
        """
        farther = np.maximum(at, np.minimum(at + STEP_FARTHER * self.spread, FARTHEST * self.spread))
        away = np.where(_IS_AWAY[numbers], np.maximum(self.held, farther), self.held)
        nearer = np.minimum(away, at - STEP_NEARER * self.spread)
        return np.asarray(np.where(_ASKS_NEARER[numbers], nearer, away))

    def _nearest_after(self, numbers: NDArray[np.int64], at: Floats) -> Floats:
        """Where a person has been met no gap is closed again, and a step back is not overridden.

        An invitation given at the boundary moves it nearer by one step. A robot that only found room farther
        out than it wanted has opened no gap.
        """
        wanted = self.offset
        met = np.maximum(self.nearest, np.minimum(at, wanted))
        away = np.maximum(met, np.where(_IS_AWAY[numbers], at, -np.inf))
        within = at <= self.nearest + WITHIN * self.spread
        nearer = np.minimum(self.nearest, at - STEP_NEARER * self.spread)
        return np.asarray(np.where(_INVITES[numbers], np.where(within, nearer, self.nearest), away))


_IS_AWAY = np.array([signal in AWAY for signal in SIGNALS])
_SPOKEN = np.array([signal in WORDS for signal in SIGNALS])
_ASKS_NEARER = np.array([signal == "ask_closer" for signal in SIGNALS])
_IS_QUIET = np.array([signal == "nothing" for signal in SIGNALS])
_INVITES = np.array([signal in INVITES for signal in SIGNALS])


@lru_cache(maxsize=1)
def _losses() -> tuple[Floats, Floats]:
    """With people who only showed what they like, and with those who said it or are at ease: without harm."""
    return losses(PLACES, MIDDLES), losses(PLACES, MIDDLES, harm=0.0)


@lru_cache(maxsize=1)
def _prior() -> Floats:
    """Independent: the middle, a log-normal half width around 0.5 spreads, and the manners."""
    middle = _middles()
    half = np.exp(-((np.log(HALF_WIDTHS / 0.5) / 0.4) ** 2) / 2.0)
    prior: Floats = (middle[:, None] * half)[..., None] * MANNER_WEIGHTS
    prior /= prior.sum()
    prior.flags.writeable = False
    return prior


def _middles() -> Floats:
    """The prior of the middle, but for a factor: a normal distribution contaminated by a wider one."""
    usual, unusual = (np.exp(-((MIDDLES / wide) ** 2) / 2.0) / wide for wide in (1.0, UNUSUAL_SPREADS))
    return np.asarray((1.0 - UNUSUAL_SHARE) * usual + UNUSUAL_SHARE * unusual)


@lru_cache(maxsize=64)
def _drift(days: float) -> Floats:
    """How middles drift in so many days: the probabilities from every column to every row."""
    rates, modes, roots = _modes()
    moved = (modes * np.exp(rates * days)) @ modes.T * (roots[:, None] / roots)
    return np.asarray(np.maximum(moved, 0.0) / moved.sum(axis=0))


@lru_cache(maxsize=1)
def _modes() -> tuple[Floats, Floats, Floats]:
    """The drift's rates and modes: a random walk from point to point that has the prior in balance.

    Up and down between two neighbours equally many people pass when all are as the prior has them (detailed
    balance; Kelly 1979, chapter 1). Finely resolved this is the process of Uhlenbeck and Ornstein (1930):
    a random walk of `DRIFT` a day, pulled back so slowly that it forgets to the prior in years.

    Returns:
        Rates [1/day], modes of the symmetrised walk in columns, and the prior's square roots.
    """
    roots = np.sqrt(_middles())
    between = np.full(len(MIDDLES) - 1, DRIFT**2 / 2.0 / (MIDDLES[1] - MIDDLES[0]) ** 2)
    leaving = np.zeros_like(roots)
    leaving[:-1] += between * roots[1:] / roots[:-1]
    leaving[1:] += between * roots[:-1] / roots[1:]
    rates, modes = np.linalg.eigh(np.diag(between, 1) + np.diag(between, -1) - np.diag(leaving))
    return np.minimum(rates, 0.0), modes, roots
