"""Retreat: a person who faces the robot and keeps going away from it while it comes has declined.

One step back is an answer to its distance, and a person who shifts about is slower than the robot: both are
followed. The thresholds are our choice.
"""

from __future__ import annotations

import math

from comity_sim2d.base.base import Base
from comity_sim2d.clock import Clock
from comity_sim2d.navigation.docking import Docked
from comity_sim2d.navigation.yielding import Walker
from comity_sim2d.scene.facing import CLOSE_SOCIAL_M, FACES_DEG

LASTS_S = 2.0
"""Time after which a retreat has declined [s]: longer than a step back."""
SHARE = 0.5
"""A person retreats if they go away at more than this share of the speed at which the robot comes."""
DOCKED_M, WALKS_M_S = 0.1, 0.3
"""Up to `DOCKED_M` [m] beyond the distance of the visit the robot has come, and follows a person who shifts
about; there they retreat only if they go away faster than `WALKS_M_S` [m/s]."""


class Retreat:
    """How long the person that the robot visits has retreated from it.

    Args:
        clock: The ticks.
    """

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self._until_s = -math.inf
        """When they last did not retreat."""

    def forget(self) -> None:
        """The robot goes to another person."""
        self._until_s = self._clock.now_s

    def look(self, walker: Walker | None, stands: Docked, distance_m: float, base: Base) -> bool:
        """Whether the person has declined so; called in every tick.

        Args:
            walker: The person, where they move.
            stands: Where the robot stands, seen from them.
            distance_m: At which it is to stop before them, between the surfaces.
            base: Where it is, and how it drives.
        """
        in_view = stands.distance_m <= CLOSE_SOCIAL_M and abs(stands.bearing_deg) <= FACES_DEG
        least_m_s = WALKS_M_S if stands.distance_m <= distance_m + DOCKED_M else 0.0
        if walker is None or not in_view or not _goes_away(walker, base, least_m_s):
            self._until_s = self._clock.now_s
        return self._clock.now_s - self._until_s >= LASTS_S - 1e-9


def _goes_away(walker: Walker, base: Base, least_m_s: float) -> bool:
    x_m, y_m = walker.person.x_m - base.xy[0], walker.person.y_m - base.xy[1]
    away_m_s, comes_m_s = (
        (vx * x_m + vy * y_m) / math.hypot(x_m, y_m) for vx, vy in (walker.velocity, base.velocity)
    )
    return away_m_s > max(SHARE * comes_m_s, least_m_s)
