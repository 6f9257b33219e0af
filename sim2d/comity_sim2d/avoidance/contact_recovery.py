"""Contact recovery: after a contact with a person the robot first moves straight away from them.

The contact itself tells where they are. Moving along a body, or turning towards the route while stepping
aside, would rub against it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from comity_sim2d.base.base import Base, VelocityCommand
from comity_sim2d.base.drive import KEEP_OFF_M
from comity_sim2d.base.physics import Touch
from comity_sim2d.pose import direction_to, wrap_angle
from comity_sim2d.scene.obstacles import FloorPlan
from comity_sim2d.scene.person import Person

BACK_M_S = 0.2
"""Speed of the recovery [m/s]: slow, as it does not look where it goes (our choice)."""
FACES_RAD = math.radians(3.0)
"""A base that cannot move sideways faces the person to within this angle before it goes back."""
AHEAD_M = 0.05
"""Free space behind the robot that is enough for the next ticks [m]."""


class ContactRecovery:
    """The contacts of one robot and the recovery from them.

    Args:
        touches: All contacts so far, in order; the world appends to it.
        radius_m: Radius of the robot [m].
    """

    def __init__(self, touches: Sequence[Touch], radius_m: float) -> None:
        self._touches = touches
        self._radius_m = radius_m
        self._over = 0
        """Number of contacts already handled."""

    def look(
        self, base: Base, people: Sequence[Person], plan: FloorPlan
    ) -> tuple[str, VelocityCommand] | None:
        """The person to move away from, and the command; None without a contact, or without room.

        Args:
            base: Current motion of the robot's base.
            people: Their believed positions.
            plan: The static obstacles, which the robot must not back into.
        """
        if len(self._touches) == self._over:
            return None
        touched = self._touches[-1].entity
        person = next((person for person in people if person.name == touched), None)
        if person is None or person.gap_m(base.xy, self._radius_m) >= KEEP_OFF_M:
            self._over = len(self._touches)
            return None
        # Contact recovery. The direction is straight away from the person's centre: it is the one along
        # which the gap grows fastest, and the only one without a part along the body, which would rub. It
        # holds from the touch until `KEEP_OFF_M` is reached, before any goal; else the goal would send the
        # robot back into the person at once. A base that cannot move sideways turns to face them first,
        # since its only free direction is its own axis. With no room behind, nothing is commanded here: any
        # other direction would press or rub.
        ahead = direction_to(base.xy, person.xy)
        back = (-math.cos(ahead), -math.sin(ahead))
        there = (base.xy[0] + AHEAD_M * back[0], base.xy[1] + AHEAD_M * back[1])
        if plan.blocker(there, self._radius_m) is not None:
            return None
        if base.turns_to_go and abs(wrap_angle(ahead - base.pose.heading_rad)) > FACES_RAD:
            return touched, VelocityCommand((0.0, 0.0), ahead)
        velocity = (BACK_M_S * back[0], BACK_M_S * back[1])
        return touched, VelocityCommand(velocity, ahead, may_reverse=True)
