"""The bump stop: a contact presses the robot's emergency stop for a moment."""

from __future__ import annotations

from collections.abc import Sequence

from comity_sim2d.base.emergency import EmergencyStop
from comity_sim2d.base.physics import Touch
from comity_sim2d.clock import Clock

HOLD_S = 1.0
"""Time for which the base is held after a contact began [s] (our choice)."""


class BumpStop:
    """Watches the contacts of the robot's body.

    Args:
        touches: All contacts so far, in order; the world appends to it.
        clock: Simulated time.
        emergency_stop: What a contact presses.
    """

    def __init__(self, touches: Sequence[Touch], clock: Clock, emergency_stop: EmergencyStop) -> None:
        self._touches = touches
        self._clock = clock
        self._emergency_stop = emergency_stop
        self.reason: str | None = None
        """What was touched, in words, while the base is held; else None."""

    def feel(self) -> None:
        """Press the stop when a contact has just begun, and release it after `HOLD_S`."""
        before, self.reason = self.reason, self._touched()
        if before == self.reason:
            return
        if before is not None:
            self._emergency_stop.release(before)
        if self.reason is not None:
            self._emergency_stop.press(self.reason, contact=True)

    def _touched(self) -> str | None:
        if not self._touches or self._clock.now_s - self._touches[-1].t >= HOLD_S:
            return None
        return f"bumped into {self._touches[-1].entity}"
