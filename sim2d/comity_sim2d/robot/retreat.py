"""Retreat: a person who faces the robot and keeps moving away from it has declined.

A single step back is about the distance, and standing people shift slowly: in both cases the robot keeps its
distance and follows. The thresholds are our choice.
"""

from __future__ import annotations

import math
from collections import deque

from comity_fis.proxemics import CLOSE_SOCIAL_M, FACES_DEG
from comity_sim2d.clock import Clock
from comity_sim2d.navigation.docking import Docked
from comity_sim2d.navigation.yielding import Walker
from comity_sim2d.pose import XY

LASTS_S, RETREATS_M_S = 2.0, 0.25
"""A person retreats if they move away from the robot at more than `RETREATS_M_S` on average for `LASTS_S`
without standing still: longer than a step back takes, and faster than people shift about."""


class Retreat:
    """Detects whether the person whom the robot visits retreats from it.

    Args:
        clock: The ticks.
    """

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self._marks: deque[tuple[float, XY, XY]] = deque()
        """Time [s], and positions of the person and the robot, for the last `LASTS_S`."""

    def forget(self) -> None:
        """Reset: the robot visits another person, or this one walks."""
        self._marks.clear()

    def look(self, walker: Walker | None, stands: Docked, robot: XY) -> bool:
        """Whether the person has retreated for the last `LASTS_S`; call it in every tick.

        Args:
            walker: The person, if they move.
            stands: Pose of the robot relative to them.
            robot: Position of the robot [m].
        """
        if walker is None or stands.distance_m > CLOSE_SOCIAL_M or abs(stands.bearing_deg) > FACES_DEG:
            self._marks.clear()
            return False
        now_s, xy = self._clock.now_s, walker.person.xy
        if self._marks and now_s - self._marks[-1][0] > self._clock.step_s + 1e-9:
            self._marks.clear()  # as after a stop, during which it did not look
        self._marks.append((now_s, xy, robot))
        since_s, was, from_robot = self._marks[0]
        if now_s - since_s < LASTS_S - 1e-9:
            return False
        self._marks.popleft()
        return math.dist(from_robot, xy) - math.dist(from_robot, was) > RETREATS_M_S * LASTS_S
