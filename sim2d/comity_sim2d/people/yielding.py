"""Yielding: where two people block each other before a door, one of them steps back and lets the other go.

Discs that share a gap equally form arches in which no one moves again (Helbing, Farkas and Vicsek 2000,
Nature 407, 487-490). People give way. A rank that is drawn once decides who does, so that of two people the
same one always goes first and no two step back for each other in turn.
"""

from __future__ import annotations

import numpy as np

from comity_sim2d.people.near import Near
from comity_sim2d.people.social_force import Vectors

BLOCKED_M_S, BLOCKED_S = 0.1, 0.5
"""People who want to walk and have been slower than this for this long are blocked (our choice)."""
TOUCHING_M = 0.1
"""Two who are blocked and nearer to each other than this block each other (our choice)."""
BACK_M_S, BACK_S = 0.5, 1.0
"""How fast and for how long one of them steps back, as far as there is room: a step (our choice)."""


class Yielding:
    """How long each person is blocked, and who steps back.

    Args:
        count: Of bodies.
        seed: Decides who goes first.
        step_s: From one decision to the next.
    """

    def __init__(self, count: int, seed: int, step_s: float) -> None:
        self._rank = np.random.default_rng(seed).permutation(count)
        self._blocked, self._back = np.zeros(count, dtype=int), np.zeros(count, dtype=int)
        """For how many decisions each has been blocked, and is still to step back."""
        self._patience, self._retreat = round(BLOCKED_S / step_s), round(BACK_S / step_s)

    def decide(self, wanted: Vectors, velocity: Vectors, near: Near) -> Vectors:
        """The velocities that people want: backwards for those who yield.

        Args:
            wanted: Of all bodies, shape (n,); 0 of those who do not walk.
            velocity: Current velocities, shape (n,).
            near: The pairs of near bodies.
        """
        walks = wanted != 0.0
        slow = walks & (np.abs(velocity) < BLOCKED_M_S)
        self._blocked = np.where(slow, self._blocked + 1, 0)
        self._back = np.maximum(self._back - 1, 0)
        blocked = self._blocked >= self._patience
        if blocked.any():
            touch = blocked[near.one] & blocked[near.other] & (near.gap_m < TOUCHING_M)
            one, other = near.one[touch], near.other[touch]
            later = np.where(self._rank[one] > self._rank[other], one, other)
            self._back[later], self._blocked[later] = self._retreat, 0
        back = walks & (self._back > 0)
        if not back.any():
            return wanted
        pace = np.maximum(np.abs(wanted), 1e-9)
        return np.asarray(np.where(back, wanted * (-BACK_M_S / pace), wanted))
