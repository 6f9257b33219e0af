"""Yielding: if two people block each other at a door, one steps back and lets the other go first.

Discs that share a gap equally form arches in which no one moves again (Helbing, Farkas and Vicsek 2000,
Nature 407, 487-490); real people give way. A fixed random rank decides who does, so that of two people the
same one always goes first and they do not step back in turn.
"""

from __future__ import annotations

import numpy as np

from comity_sim2d.people.near import Near
from comity_sim2d.people.social_force import Vectors

BLOCKED_M_S, BLOCKED_S = 0.1, 0.5
"""People who want to walk but have been slower than this [m/s] for this long [s] are blocked (our choice)."""
TOUCHING_M = 0.1
"""Two blocked people nearer to each other than this block each other [m] (our choice)."""
BACK_M_S, BACK_S = 0.5, 1.0
"""Speed [m/s] and duration [s] of stepping back, as far as there is room: one step (our choice)."""


class Yielding:
    """How long each person has been blocked, and who steps back.

    Args:
        count: Number of bodies.
        seed: Seed of who goes first.
        step_s: Period of decisions [s].
    """

    def __init__(self, count: int, seed: int, step_s: float) -> None:
        self._rank = np.random.default_rng(seed).permutation(count)
        self._blocked, self._back = np.zeros(count, dtype=int), np.zeros(count, dtype=int)
        """Number of decisions for which each has been blocked, and for which each still steps back."""
        self._patience, self._retreat = round(BLOCKED_S / step_s), round(BACK_S / step_s)

    def decide(self, wanted: Vectors, velocity: Vectors, near: Near) -> Vectors:
        """The target velocities, backwards for those who yield [m/s].

        Args:
            wanted: Target velocities of all bodies [m/s], shape (n,); 0 for those who do not walk.
            velocity: Current velocities [m/s], shape (n,).
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
