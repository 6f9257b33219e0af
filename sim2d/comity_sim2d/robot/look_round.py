"""Looking round for a person who is not at their believed place: one full turn on the spot.

After an unsuccessful turn, the next one is made only from elsewhere, or after a while, as people move.
"""

from __future__ import annotations

import math

from comity_sim2d.base.base import Base
from comity_sim2d.base.drive import MAX_TURN_RAD_S, MAX_TURN_RAD_S2, SPEED_SHARE
from comity_sim2d.clock import Clock
from comity_sim2d.pose import XY, wrap_angle
from comity_sim2d.scene.robot_body import Sensor

ELSEWHERE_M, AGAIN_S = 1.0, 10.0
"""Distance [m] or time [s] after which the robot looks round again (our choice)."""
VIEW_SHARE = 0.8
"""Maximum turn between two measurements, as a share of the field of view, so that no person is missed."""

Loss = tuple[str, float | None]
"""The lost person, and when they were last seen [s]."""


class LookRound:
    """The person whom the robot looks for by turning, and the unsuccessful turns.

    Args:
        sensor: Its field of view; with all-round view there is no need to turn.
        clock: The ticks.
    """

    def __init__(self, sensor: Sensor, clock: Clock) -> None:
        self._clock = clock
        self._view_rad = math.radians(sensor.field_of_view_deg)
        rate = min(MAX_TURN_RAD_S, VIEW_SHARE * self._view_rad / clock.step_s)
        self._ahead_rad = rate**2 / (2.0 * SPEED_SHARE * MAX_TURN_RAD_S2)
        """Look-ahead of the turn [rad]: the stopping angle from its rate."""
        self._turns_for: Loss | None = None
        self._left_rad = self._heading_rad = 0.0
        self._tick = 0
        self._in_vain: dict[str, tuple[Loss, XY, float]] = {}
        """The last unsuccessful turn for each person, with place and time."""

    def is_due(self, loss: Loss, xy: XY) -> bool:
        """Whether a turn may find them: none was unsuccessful here recently."""
        known, where, when_s = self._in_vain.get(loss[0], (None, xy, 0.0))
        return loss != known or math.dist(where, xy) > ELSEWHERE_M or self._clock.now_s - when_s >= AGAIN_S

    def heading(self, loss: Loss, base: Base) -> float | None:
        """Heading for the coming tick [rad]; None if a turn is over, or not due."""
        if not self.is_due(loss, base.xy):
            return None
        heading, tick = base.pose.heading_rad, self._clock.tick
        if self._turns_for != loss or tick > self._tick + 1:
            self._turns_for, self._left_rad = loss, math.tau
        else:
            self._left_rad -= wrap_angle(heading - self._heading_rad)
        self._heading_rad, self._tick = heading, tick
        if self._left_rad > 0.0 and self._view_rad < math.tau:
            return wrap_angle(heading + self._ahead_rad)
        self._turns_for, self._in_vain[loss[0]] = None, (loss, base.xy, self._clock.now_s)
        return None


def how_lost(loss: Loss) -> str:
    """Since when a person has been lost whom looking round did not find, in words."""
    person, last_s = loss
    if last_s is None:
        return f"{person} is not where they were expected, and was not found by looking round"
    return f"{person} was lost from sight at t={last_s:.2f} s, and not found by looking round"
