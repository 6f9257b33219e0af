"""Retreat: a person who faces the robot and keeps going away from it has declined.

One step back is an answer to its distance, and a person may shift about slowly: both are followed. The
thresholds are our choice.
"""

from __future__ import annotations

import math

from comity_sim2d.clock import Clock
from comity_sim2d.navigation.docking import Docked
from comity_sim2d.navigation.yielding import Walker
from comity_sim2d.pose import XY
from comity_sim2d.scene.facing import CLOSE_SOCIAL_M, FACES_DEG

LASTS_S, BACK_M = 2.0, 0.5
"""A retreat has declined once the person has gone away by more than `BACK_M` [m] in `LASTS_S` [s] without
standing: longer than a step back, and faster than a person who shifts about."""


class Retreat:
    """How long the person that the robot visits has retreated from it.

    Args:
        clock: The ticks.
    """

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self._mark: tuple[float, XY] | None = None
        """When the person was where, at the end of the last whole `LASTS_S`; None where they do not move."""

    def forget(self) -> None:
        """The robot goes to another person."""
        self._mark = None

    def look(self, walker: Walker | None, stands: Docked, robot: XY) -> bool:
        """Whether the person has declined so; called in every tick.

        Args:
            walker: The person, where they move.
            stands: Where the robot stands, seen from them.
            robot: Where it is.
        """
        if walker is None or stands.distance_m > CLOSE_SOCIAL_M or abs(stands.bearing_deg) > FACES_DEG:
            self._mark = None
            return False
        now_s, xy = self._clock.now_s, walker.person.xy
        since_s, was = self._mark or (now_s, xy)
        is_whole = now_s - since_s >= LASTS_S - 1e-9
        self._mark = (now_s, xy) if is_whole else (since_s, was)
        return is_whole and math.dist(robot, xy) - math.dist(robot, was) > BACK_M
