"""Learning the comfort interval of one person for a parameter, from meetings.

All quantities are offsets from the model's value in the current situation: 0 is that value, negative is
nearer. The person's interval has a middle, which they like best, and a half width. The prior of the middle
has the rulebook's spread, and heavy tails; a signal is evidence about one end of the interval (see
`showing`); between visits the middle drifts. The posterior is a grid over middles, half widths and manners:
how often the person shows anything at all, and whether they show the opposite. The mathematics is in
docs/explanation/learning.md; the loss function in `comfort_loss`.
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

# All in units of the spread, so that they apply to any parameter, and all our own choice. With a spread of
# 0.30 m the edge is 3 cm, the half width about 15 cm, a step nearer 15 cm, the drift 12 cm in 100 days.
MIDDLES: Floats = np.linspace(-4.0, 4.0, 121)
HALF_WIDTHS: Floats = np.array([0.2, 0.35, 0.5, 0.7, 1.0])
EDGE = 0.1
"""Day-to-day variation of the ends of one person's interval [spreads]."""
INVITES: frozenset[Signal] = frozenset({"ask_closer", "lean_in"})
STEP_NEARER = 0.5
"""Maximum step nearer after one invitation [spreads]; without an answer to the question, the maximum of all
together."""
STEP_FARTHER = 1.0 / 6.0
"""Minimum step outwards after a step back or a request for more distance [spreads]: just noticeable."""
FARTHEST = 2.0
"""Maximum absolute personal offset [spreads], unless the person stepped back there."""
PLACES: Floats = np.linspace(-FARTHEST, FARTHEST, 241)
"""Candidate offsets of the robot [spreads]: half a centimetre apart with a spread of 0.30 m."""
DRIFT = 0.04
"""Standard deviation of the middle's drift in one day [spreads]."""
ANSWER = 1.0 / 3.0
"""Standard deviation of a stated distance around the preferred one [spreads]: two answers of one person then
correlate by 1 / (1 + ANSWER**2) = 0.9 between people (our choice)."""
WITHIN = 0.1
"""Tolerance for an invitation to count as given at a boundary [spreads]."""

CHANCES: Floats = np.array([0.0, 0.3, 0.6, 0.9, 0.6, 0.0])
"""Probability of showing a discomfort at all, by manner."""
CONTRARY = np.array([False, False, False, False, True, False])
"""Whether people of this manner show the signals of the opposite discomfort."""
HABITUAL = np.array([False, False, False, False, False, True])
"""Whether signals of people of this manner are meaningless: they invite, lean in or make room by habit."""
MANNER_WEIGHTS: Floats = np.array([0.19, 0.21, 0.24, 0.18, 0.06, 0.12])
"""Prior probabilities of the manners. Some people never show anything, so silence alone reduces no hypothesis
below 0.19 times its prior. A few mean the opposite of what they show, and some mean nothing by it."""
UNUSUAL_SHARE, UNUSUAL_SPREADS = 0.11, 2.0
"""Heavy tails of the prior of the middle: this share of people has a spread this many times wider, because
the model may be wrong about them."""


@dataclass(frozen=True, slots=True, eq=False)
class ComfortPosterior:
    """A posterior of one person's comfort interval, or of many people's at once.

    `ComfortPosterior.before_meeting` is the prior. Arrays have the shape of the people, `()` for one.
    """

    spread: float
    """Standard deviation of people around the model's value, in the parameter's unit."""
    weights: Floats
    """Probabilities, shape (..., middles, half widths, manners); they sum to 1 for each person."""
    nearest: Floats
    """How near the robot may come uninvited, shape (...), in the parameter's unit."""
    asked: NDArray[np.bool_]
    """Whether they ever stated a preference, shape (...)."""
    believed: NDArray[np.bool_]
    """Whether they last spoke, or showed no discomfort nearer than the model's value, shape (...)."""
    said: Floats
    """Smallest offset by invitations, shape (...): the stated one, or one step from the value."""
    held: Floats
    """Smallest offset since a step back or a request for distance, shape (...); -inf without any."""

    @classmethod
    def before_meeting(cls, spread: float, shape: tuple[int, ...] = ()) -> ComfortPosterior:
        """The prior: the model's value and its spread.

        Args:
            spread: Standard deviation of people around the value, above 0.
            shape: Shape of the people.
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
        """The posterior after some days: preferences drift, and what was learnt fades into the prior."""
        if days <= 0.0:
            return self
        flat = self.weights.reshape(*self.weights.shape[:-2], -1)
        return replace(self, weights=(_drift(float(days)) @ flat).reshape(self.weights.shape))

    def after(self, signal: Signal | ArrayLike, offset: ArrayLike) -> ComfortPosterior:
        """The posterior after one observation.

        Args:
            signal: The noticed signal, by name or index in `SIGNALS`, shape (...).
            offset: Offset of the robot from the model's value, shape (...).
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
        """The posterior after the person stated which distance they like best.

        The stated value is normally distributed around the middle of their interval with `ANSWER`; a share of
        `MISREAD` of all answers was misunderstood and could be any. The answer also limits how near the robot
        may come: exactly as near as stated, without a further invitation, whatever they show later. An
        earlier step back no longer holds.

        Args:
            offset: The stated offset from the model's value, shape (...).
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
        """The next offset of the robot from the model's value.

        It is the one of `PLACES` with the smallest expected loss, and never nearer than the person allowed.
        Harm is not counted after an answer or spoken request, nor while they are at ease with it nearer.
        """
        of_middles = self.weights.sum(axis=(-2, -1))
        shown, said = ((of_middles @ costs.T).argmin(axis=-1) for costs in _losses())
        best = PLACES[np.where(self.asked | self.believed, said, shown)]
        return np.asarray(np.maximum(best * self.spread, self.nearest))

    @property
    def deviation(self) -> Floats:
        """Posterior standard deviation of the middle."""
        of_middles = self.weights.sum(axis=(-2, -1))
        mean = of_middles @ MIDDLES
        return np.asarray(self.spread * np.sqrt(of_middles @ MIDDLES**2 - mean**2))

    def quantile(self, probability: ArrayLike) -> Floats:
        """Quantile of the middle of the interval, from the model's value, interpolated on the grid."""
        wanted = np.asarray(probability, dtype=np.float64)
        mass = self.weights.sum(axis=(-2, -1))
        edges = np.concatenate([np.zeros((*mass.shape[:-1], 1)), np.cumsum(mass, axis=-1)], axis=-1)
        cell = np.minimum((edges[..., 1:] < wanted[..., None]).sum(axis=-1), len(MIDDLES) - 1)
        below = np.take_along_axis(edges, cell[..., None], -1)[..., 0]
        inside = np.take_along_axis(mass, cell[..., None], -1)[..., 0]
        width = MIDDLES[1] - MIDDLES[0]
        return np.asarray(self.spread * (MIDDLES[cell] + width * ((wanted - below) / inside - 0.5)))

    def interval(self, share: float = 0.9, nearest: float = -np.inf) -> tuple[Floats, Floats]:
        """Central credible interval of the middle.

        Args:
            share: Probability, in (0, 1).
            nearest: Condition on the middle being no nearer than this, from the model's value.
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
