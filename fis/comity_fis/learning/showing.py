"""How people show that another stands too close or too far, and how often that is misread.

The one model of signals in the project: the people of the 2D world and of the studies draw what they show
from `shown`, and the posterior of `comfort` weighs what was noticed by `noticed`. No study was found that
counts such signals towards robots: all the shares and rates here are our own choice.
"""

from __future__ import annotations

from collections.abc import Collection

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import ndtr

from comity_fis.learning.signals import SIGNALS, Signal

Floats = NDArray[np.float64]

WHEN_TOO_CLOSE: Floats = np.array([0.50, 0.25, 0.25, 0.00, 0.00, 0.00])
WHEN_TOO_FAR: Floats = np.array([0.00, 0.00, 0.10, 0.45, 0.45, 0.00])
"""Which signal it is, of those who show one; in the order of `SIGNALS`."""

MISREAD = 0.03
"""The share of moments in which what was noticed has nothing to do with what was felt."""
WHEN_MISREAD: Floats = np.array([0.15, 0.05, 0.30, 0.15, 0.05, 0.30])
"""People turn for many reasons, and shift their weight; words are seldom misheard."""
WHEN_HABITUAL: Floats = np.array([0.16, 0.03, 0.10, 0.18, 0.03, 0.50])
"""Of people whose signals mean nothing: some lean in to hear, some make room."""


def feelings(distance: ArrayLike, near: ArrayLike, far: ArrayLike, edge: float) -> tuple[Floats, Floats]:
    """The chances that a distance feels too close, and that it feels too far.

    The ends of a comfort interval are soft: a person is not equally sensitive every day.

    Args:
        distance: Where a person stands.
        near: The end of the interval below which it is too close.
        far: The end beyond which it is too far.
        edge: Standard deviation of both ends from day to day.
    """
    distance = np.asarray(distance, dtype=np.float64)
    return ndtr((np.asarray(near) - distance) / edge), ndtr((distance - np.asarray(far)) / edge)


def shown(
    distance: ArrayLike,
    near: ArrayLike,
    far: ArrayLike,
    *,
    chance: ArrayLike = 1.0,
    edge: float,
    repertoire: Collection[Signal] = SIGNALS,
) -> Floats:
    """The probability of every signal.

    Args:
        distance: Where a person stands, shape (...).
        near: The near end of the comfort interval, shape (...).
        far: Its far end, shape (...).
        chance: Of showing a discomfort at all, in [0, 1], shape (...).
        edge: Standard deviation of both ends from day to day.
        repertoire: The signals that this person uses; one who has none for a discomfort hides it.

    Returns:
        Shape (..., 6), in the order of `SIGNALS`; the last axis adds up to 1.
    """
    used = np.array([signal in repertoire for signal in SIGNALS])
    close, far_off = (
        np.asarray(chance)[..., None] * felt[..., None] * _among(used, shares)
        for felt, shares in zip(
            feelings(distance, near, far, edge), (WHEN_TOO_CLOSE, WHEN_TOO_FAR), strict=True
        )
    )
    signals: Floats = close + far_off
    signals[..., -1] = 1.0 - signals[..., :-1].sum(axis=-1)
    return signals


def misread(probabilities: Floats, rate: float = MISREAD) -> Floats:
    """The probability of every signal that is noticed, from those that are shown, shape (..., 6)."""
    return (1.0 - rate) * probabilities + rate * WHEN_MISREAD


def drawn(probabilities: Floats, uniform: ArrayLike) -> NDArray[np.int64]:
    """Signals by their number in `SIGNALS`, one for each number in [0, 1), shape (...)."""
    behind = np.cumsum(probabilities, axis=-1)[..., :-1] <= np.asarray(uniform)[..., None]
    return np.asarray(behind.sum(axis=-1))


def noticed(signal: ArrayLike, too_close: Floats, too_far: Floats, chance: Floats) -> Floats:
    """How likely it was to notice just this: the same probabilities, of one signal each, factored.

    Args:
        signal: Numbers in `SIGNALS`, of a shape that broadcasts with the others.
        too_close: The chance that it felt too close.
        too_far: The chance that it felt too far.
        chance: Of showing a discomfort at all.
    """
    chosen = np.asarray(signal)
    felt = chance * (_CLOSE[chosen] * too_close + _FAR[chosen] * too_far)
    return np.asarray((1.0 - MISREAD) * (_QUIET[chosen] + felt) + MISREAD * WHEN_MISREAD[chosen])


def _among(used: NDArray[np.bool_], shares: Floats) -> Floats:
    """The shares of the signals that are used, adding up to 1 again; all 0 where none is."""
    kept = np.where(used, shares, 0.0)
    total = kept.sum()
    return kept / total if total > 0.0 else kept


_QUIET: Floats = np.array([0.0, 0.0, 0.0, 0.0, 0.0, 1.0])
_CLOSE: Floats = WHEN_TOO_CLOSE - _QUIET
_FAR: Floats = WHEN_TOO_FAR - _QUIET
"""Nothing is shown unless a discomfort is."""
