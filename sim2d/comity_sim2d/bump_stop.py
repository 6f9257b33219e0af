"""The bump stop: the motors are cut when the robot touches something, for a moment."""

from __future__ import annotations

from collections.abc import Sequence

from comity_sim2d.clock import Clock
from comity_sim2d.physics import Touch

HOLD_S = 1.0
"""So long the base stays where it is after a contact began (our choice)."""


class BumpStop:
    """Watches the contacts of the robot's body.

    Args:
        touches: All contacts so far, in order; they grow with the world.
        clock: The ticks.
    """

    def __init__(self, touches: Sequence[Touch], clock: Clock) -> None:
        self._touches = touches
        self._clock = clock

    @property
    def reason(self) -> str | None:
        """What was touched, in words, while the base is held; else None."""
        if not self._touches or self._clock.now_s - self._touches[-1].t >= HOLD_S:
            return None
        return f"bumped into {self._touches[-1].entity}"
