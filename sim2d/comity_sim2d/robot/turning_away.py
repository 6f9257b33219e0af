"""Turning away: a person who keeps their back to the robot while it comes round to their front has declined.

The robot follows a person who turns, to stand where it suits them. Without an end it would circle somebody
who turns on each time.
"""

from __future__ import annotations

import math

from comity_fis.proxemics import CLOSE_SOCIAL_M, FACES_DEG
from comity_sim2d.navigation.docking import Docked
from comity_sim2d.pose import wrap_angle

TURNS_RAD = math.pi
"""A person declines by turning this far from the robot without facing it in between [rad] (our choice: half a
turn; less may be a look at somebody else)."""


class TurningAway:
    """Detects whether the person whom the robot visits turns away from it."""

    def __init__(self) -> None:
        self._heading_rad: float | None = None
        """Their heading in the last tick [rad]."""
        self._away_rad = 0.0
        """How far they have turned from the robot since they last faced it [rad]."""

    def forget(self) -> None:
        """Reset: the robot visits another person, or this one walks."""
        self._heading_rad, self._away_rad = None, 0.0

    def look(self, heading_rad: float, stands: Docked) -> bool:
        """Whether the person has turned away; call it in every tick.

        Args:
            heading_rad: Their heading [rad].
            stands: Pose of the robot relative to them.
        """
        turned_rad = 0.0 if self._heading_rad is None else wrap_angle(heading_rad - self._heading_rad)
        self._heading_rad = heading_rad
        if stands.distance_m > CLOSE_SOCIAL_M or abs(stands.bearing_deg) <= FACES_DEG:
            self._away_rad = 0.0
            return False
        self._away_rad = max(0.0, self._away_rad - math.copysign(turned_rad, turned_rad * stands.bearing_deg))
        return self._away_rad > TURNS_RAD
