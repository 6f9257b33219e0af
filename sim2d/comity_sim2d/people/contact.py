"""Contact avoidance: velocities are limited so that no body enters another.

The gap between each pair of bodies is shared: a moving body may use half of it, or all of it if the other
does not move. A body that keeps all its shares overlaps no other during the step.
"""

from __future__ import annotations

import numpy as np

from comity_sim2d.people.neighbours import Indices
from comity_sim2d.people.social_force import Numbers, Vectors

ROUNDING_M_S = 1e-7
"""An excess speed below this is a rounding error and no reason to stop [m/s]."""


def within_shares(velocity: Vectors, who: Indices, towards: Vectors, share_m_s: Numbers) -> Vectors:
    """The velocities, first turned along obstacles, then shortened as far as needed.

    Args:
        velocity: Velocities of all bodies [m/s], shape (n,).
        who: Index of the body of each share, shape (k,).
        towards: Unit vectors towards the obstacles, shape (k,).
        share_m_s: Maximum approach speed [m/s], at least 0; shape (k,).
    """
    excess = _along(velocity[who], towards) - share_m_s
    tight = excess > 0.0
    if not tight.any():
        return velocity
    turned = _turned(velocity, who[tight], towards[tight], excess[tight])
    return _shortened(turned, who, towards, share_m_s)


def _turned(velocity: Vectors, who: Indices, towards: Vectors, excess: Numbers) -> Vectors:
    """The velocities without the excess towards each obstacle; for several obstacles the mean counts."""
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
