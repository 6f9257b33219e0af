"""Bodies that do not pass through one another: velocities cut so that no body enters another.

Each pair of bodies shares the gap between them: a mover may take up half of it, or all of it where the other
does not move. A body within all its shares overlaps no other at the end of the step, nor on the way.
"""

from __future__ import annotations

import numpy as np

from comity_sim2d.people.neighbours import Indices
from comity_sim2d.people.social_force import Numbers, Vectors

ROUNDING_M_S = 1e-7
"""An excess speed below this is rounding, and no reason to stop."""


def within_shares(velocity: Vectors, who: Indices, towards: Vectors, share_m_s: Numbers) -> Vectors:
    """The velocities, first turned along what is in the way, then shortened as far as needed.

    Args:
        velocity: Of all bodies, shape (n,).
        who: The body of each share, shape (k,).
        towards: Unit vectors to what is in the way, shape (k,).
        share_m_s: How fast they may come nearer to it, at least 0; shape (k,).
    """
    excess = _along(velocity[who], towards) - share_m_s
    tight = excess > 0.0
    if not tight.any():
        return velocity
    turned = _turned(velocity, who[tight], towards[tight], excess[tight])
    return _shortened(turned, who, towards, share_m_s)


def _turned(velocity: Vectors, who: Indices, towards: Vectors, excess: Numbers) -> Vectors:
    """Without what is too much towards each thing; towards two things at once, their mean counts."""
    count = len(velocity)
    push = excess**2 * towards
    total = np.bincount(who, excess, count)
    x, y = np.bincount(who, push.real, count), np.bincount(who, push.imag, count)
    return np.asarray(velocity - (x + 1j * y) / np.maximum(total, 1e-12))


def _shortened(velocity: Vectors, who: Indices, towards: Vectors, share_m_s: Numbers) -> Vectors:
    speed = _along(velocity[who], towards)
    share = np.where(speed > share_m_s + ROUNDING_M_S, share_m_s / np.maximum(speed, 1e-12), 1.0)
    least = np.ones(len(velocity))
    np.minimum.at(least, who, share)
    return np.asarray(velocity * least)


def _along(velocity: Vectors, direction: Vectors) -> Numbers:
    return np.asarray(velocity.real * direction.real + velocity.imag * direction.imag)
