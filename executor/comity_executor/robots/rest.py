"""Whether a base that was told to stop comes to rest, by its own word and in time."""

from __future__ import annotations

from comity_executor.robots.robot import Robot
from comity_executor.robots.status import has_stopped

LEAST_BRAKING_S = 2.0
"""A base has twice the braking time that it states, but at least this (our choice)."""


class Rest:
    """Watches one base.

    Args:
        robot: It states how late it acts and how hard it brakes.
        top_speed_m_s: The most that it is ever told to go.
    """

    def __init__(self, robot: Robot, top_speed_m_s: float) -> None:
        self._robot = robot
        can = robot.capabilities
        braking_s = can.latency_s + top_speed_m_s / can.braking_m_s2
        self.patience_s = max(LEAST_BRAKING_S, 2.0 * braking_s)
        """So long it may take to come to rest."""
        self._told_s: float | None = None
        """Since when it has to rest."""
        self._moves_since_s = 0.0
        """Since when it does not say that it does."""
        self.is_confirmed = False
        """Whether it had to rest when it was looked at last, and said that it did."""
        self.is_overdue = False
        """Whether it has not come to rest in time."""

    def look(self, t: float, *, has_to_rest: bool) -> None:
        """Ask the base, where it has to rest at a time [s]."""
        if not has_to_rest:
            self._told_s, self.is_confirmed, self.is_overdue = None, False, False
            return
        if self._told_s is None:
            self._told_s = self._moves_since_s = t
        self.is_confirmed = has_stopped(self._robot, self._told_s)
        if self.is_confirmed:
            self._moves_since_s = t
        self.is_overdue = t - self._moves_since_s >= self.patience_s - 1e-9
