"""The lease of a motion goal: how long the simulated base follows it without renewal."""

from __future__ import annotations

import math

from comity_sim2d.clock import Clock

LEASE_S = 0.3
"""Duration of the lease [s]: the maximum of the executor's protocol."""


class Lease:
    """The lease of the newest goal.

    Args:
        clock: The base's own clock.
    """

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self._ends_s = math.inf

    def begin(self) -> None:
        """Start the lease of a goal that holds only while it is renewed."""
        self._ends_s = self._clock.now_s + LEASE_S

    def renew(self) -> None:
        """Renew the lease, unless it is over: a goal is never revived."""
        if not self.is_over:
            self._ends_s = self._clock.now_s + LEASE_S

    def waive(self) -> None:
        """Waive the lease: a manual goal holds until the next one."""
        self._ends_s = math.inf

    @property
    def is_over(self) -> bool:
        """Whether the goal has not been renewed in time."""
        return self._clock.now_s >= self._ends_s - 1e-9
