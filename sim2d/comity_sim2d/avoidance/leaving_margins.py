"""Leaving margins: a robot that is too near to people who stand first goes straight out.

It may have started there, somebody may have come to stand beside it, or it gave way to others. Its route
begins with the same straight line, but two wheels would cut the corner at its end, and at full speed.
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
"""For a position of the robot: the nearest one outside all margins; None without one nearby."""


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
        """The person whom it is nearest to, and the command; None outside all margins, or without a way out.

        Args:
            base: Current motion of the robot's base.
            people: The people who stand, the visited person as well: no docking pose is inside the margin.
            way_out: Finds the place to go to.
        """
        depth_m = {person: person.margin_m - self._gap_m(base, person) for person in people}
        deepest = max(depth_m, key=depth_m.__getitem__, default=None)
        if deepest is None or depth_m[deepest] <= (0.0 if self._leaves else self._begins_m):
            self._leaves = False
            return None
        to = way_out(base.xy)
        self._leaves = to is not None and to != base.xy
        return (deepest.name, _towards(to, base)) if to is not None and self._leaves else None

    def _gap_m(self, base: Base, person: Person) -> float:
        return math.dist(base.xy, person.xy) - person.radius_m - self._radius_m


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
