"""Monitors whether a base that was told to stop comes to rest in time, by its own report."""

from __future__ import annotations

from comity_executor.robots.robot import Robot
from comity_executor.robots.status import has_stopped

LEAST_BRAKING_S = 2.0
"""Minimum time for coming to rest [s]; otherwise twice the braking time that the base states (our choice)."""


class Rest:
    """Monitors one base.

    Args:
        robot: It states its latency and deceleration.
        top_speed_m_s: Maximum speed it is ever commanded [m/s].
    """

    def __init__(self, robot: Robot, top_speed_m_s: float) -> None:
        self._robot = robot
        can = robot.capabilities
        braking_s = can.latency_s + top_speed_m_s / can.braking_m_s2
        self.patience_s = max(LEAST_BRAKING_S, 2.0 * braking_s)
        """Maximum time for coming to rest [s]."""
        self._told_s: float | None = None
        """Time since when it should rest [s]."""
        self._moves_since_s = 0.0
        """Time since when it has not reported rest [s]."""
        self.is_confirmed = False
        """Whether at the last check it had to rest and reported rest."""
        self.is_overdue = False
        """Whether it has not come to rest in time."""

    def look(self, t: float, *, has_to_rest: bool) -> None:
        """Check the base at time `t` [s]."""
        if not has_to_rest:
            self._told_s, self.is_confirmed, self.is_overdue = None, False, False
            return
        if self._told_s is None:
            self._told_s = self._moves_since_s = t
        self.is_confirmed = has_stopped(self._robot, self._told_s)
        if self.is_confirmed:
            self._moves_since_s = t
        self.is_overdue = t - self._moves_since_s >= self.patience_s - 1e-9
