"""The lease of a motion goal: how long the simulated base follows it without renewal."""

from __future__ import annotations

import math

from comity_sim2d.clock import Clock

LEASE_S = 0.3
"""As long as the executor's protocol allows at most."""


class Lease:
    """Of the newest goal.

    Args:
        clock: The base's own clock.
    """

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self._ends_s = math.inf

    def begin(self) -> None:
        """A goal was given that holds only while it is renewed."""
        self._ends_s = self._clock.now_s + LEASE_S

    def renew(self) -> None:
        """The goal holds for longer, unless its time is over: it is never revived."""
        if not self.is_over:
            self._ends_s = self._clock.now_s + LEASE_S

    def waive(self) -> None:
        """A goal was given by hand: it holds until the next one."""
        self._ends_s = math.inf

    @property
    def is_over(self) -> bool:
        """Whether the goal has not been renewed in time."""
        return self._clock.now_s >= self._ends_s - 1e-9
