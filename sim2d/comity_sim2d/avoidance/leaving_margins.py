"""Leaving margins: a robot moves straight out of the margins of standing people before it follows its route.

It is inside a margin when it starts there, or when a person joins it. The route begins with the same straight
line, but a differential drive would cut the corner at its end at full speed.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from comity_sim2d.base.base import Base, VelocityCommand
from comity_sim2d.base.drive import REDUCED_M_S
from comity_sim2d.pose import XY, direction_to, wrap_angle
from comity_sim2d.scene.person import Person
from comity_sim2d.scene.robot_body import RobotBody

BEGINS_M = 0.02
"""The robot leaves a margin once it is inside by more than this [m] plus half a standard deviation of its
sensor: routes cut their bends by less, and tracked noise moves people who stand by less (our choice)."""
ALIGNED_RAD = math.radians(3.0)
"""A base that cannot move sideways turns its axis to within this angle before it goes [rad]."""

WayOut = Callable[[XY], XY | None]
"""Finds the nearest position outside all margins; None if there is none nearby."""


class LeavingMargins:
    """Leads one robot out of the margins of people.

    Args:
        body: The robot's body.
    """

    def __init__(self, body: RobotBody) -> None:
        self._radius_m = body.radius_m
        self._begins_m = BEGINS_M + body.sensor.sigma_m / 2.0
        self._leaves = False

    def look(
        self, base: Base, people: Sequence[Person], way_out: WayOut
    ) -> tuple[str, VelocityCommand] | None:
        """The person to move away from, and the command; None if it is in no margin, or has no way out.

        Args:
            base: Current motion of the robot's base.
            people: All people who stand, including the visited one: no docking pose is inside a margin.
            way_out: Finds the place to go to.
        """
        tolerance_m = 0.0 if self._leaves else self._begins_m
        self._leaves = False
        xy, radius_m = base.xy, self._radius_m
        inside = ((each.margin_m - each.gap_m(xy, radius_m), each.name) for each in people)
        depth_m, name = max(inside, default=(0.0, ""))
        to = way_out(xy) if depth_m > tolerance_m else None
        if to is None or to == xy:
            return None
        self._leaves = True
        return name, _towards(to, base)


def _towards(to: XY, base: Base) -> VelocityCommand:
    """The command to go to a place; a base that cannot move sideways first turns its nearer end there."""
    way, heading = direction_to(base.xy, to), base.pose.heading_rad
    velocity = (REDUCED_M_S * math.cos(way), REDUCED_M_S * math.sin(way))
    turn = wrap_angle(way - heading)
    if abs(turn) > math.pi / 2:
        turn = wrap_angle(turn + math.pi)
    if base.turns_to_go and abs(turn) > ALIGNED_RAD:
        return VelocityCommand((0.0, 0.0), heading + turn)
    return VelocityCommand(velocity, heading, may_reverse=True)
