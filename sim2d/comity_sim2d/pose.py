"""Pose of a body: x to the right, y up, angles counter-clockwise."""

from __future__ import annotations

import math
from math import atan2, pi, remainder, tau
from typing import NamedTuple

from comity_sim2d.scene_error import SceneError, shown

XY = tuple[float, float]
"""A point or a vector in the plane [m]."""


class Pose(NamedTuple):
    """A position and a heading."""

    x_m: float
    y_m: float
    heading_rad: float
    """Heading, counter-clockwise from the x axis [rad]."""

    @property
    def xy(self) -> XY:
        """Position [m]."""
        return (self.x_m, self.y_m)

    def ahead(self, distance_m: float, bearing_rad: float = 0.0) -> XY:
        """The point at a distance, in a direction counted from the heading (positive to the left)."""
        direction = self.heading_rad + bearing_rad
        return (self.x_m + distance_m * math.cos(direction), self.y_m + distance_m * math.sin(direction))


class Twist(NamedTuple):
    """A velocity in the plane, in the world frame, and a turning rate."""

    x_m_s: float = 0.0
    y_m_s: float = 0.0
    turn_rad_s: float = 0.0

    @property
    def xy(self) -> XY:
        """Velocity [m/s]."""
        return (self.x_m_s, self.y_m_s)

    @property
    def speed_m_s(self) -> float:
        """Speed [m/s]."""
        return math.hypot(self.x_m_s, self.y_m_s)


def wrap_angle(angle_rad: float) -> float:
    """The same angle in (-pi, pi]."""
    try:
        wrapped = remainder(angle_rad, tau)
    except (TypeError, ValueError, ArithmeticError) as error:  # asked at every tick: told where it fails
        raise SceneError(
            entity="angle",
            field="angle_rad",
            expected="angle_rad as a finite number",
            got=shown(angle_rad),
            remedy="Give it in radians.",
        ) from error
    return pi if wrapped == -pi else wrapped


def direction_to(start: XY, end: XY) -> float:
    """The direction from one point to another [rad], in (-pi, pi]."""
    angle = atan2(end[1] - start[1], end[0] - start[0])
    return pi if angle == -pi else angle
