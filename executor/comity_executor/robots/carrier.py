"""What a behaviour tree needs of a robot that brings things; a robot without hands does without."""

from __future__ import annotations

from math import inf
from typing import Protocol, runtime_checkable

from comity_executor.speech.manner import NORMAL, Manner

PICK_UP, HAND_OVER = "pick_up", "hand_over"
"""The names of these acts, as `act_done` and `stop_act` of `Robot` know them."""


@runtime_checkable
class Carrier(Protocol):
    """The part of a robot that fetches things; commands return at once, as those of `Robot` do."""

    def go_to(self, place: str, *, speed_m_s: float, detour_m: float = inf) -> None:
        """Go where something is kept, and turn to it; `motion` then says `arrived`.

        Args:
            place: Where it is kept.
            speed_m_s: How fast at most.
            detour_m: As for `Robot.navigate`.
        """
        ...

    def pick_up(self, thing: str, place: str) -> None:
        """Begin to take something up; the act is `pick_up`, towards the place."""
        ...

    def hand_over(self, thing: str, person: str, *, manner: Manner = NORMAL) -> None:
        """Begin to hand over what the robot holds; the act is `hand_over`, towards the person."""
        ...

    def carried(self) -> str | None:
        """What the robot has in its hands; None: nothing."""
        ...
