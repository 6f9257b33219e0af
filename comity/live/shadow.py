"""A robot that is looked at and never commanded: what Comity would do is told, and others drive it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from comity_executor import ActGoal, ActStatus, GoalId, MapGoal, MotionStatus

if TYPE_CHECKING:
    from comity_executor import Capabilities, Localisation, MapRobot, PersonTrack, Words

OPTIONAL = ("sleep", "gesture_reach_m", "floor_is_free")
"""What only some robots have, and is no command. What it carries is not asked: acts only count as done."""


class Shadow:
    """A `MapRobot` whose motion goals never end by themselves, and whose acts are done at once.

    That a person was reached is judged from where the robot is, as always: its driver may come there.

    Args:
        base: The robot. Of it only the clock, localisation, tracker, ears and stop are asked.
    """

    def __init__(self, base: MapRobot) -> None:
        self._base = base
        self._goals = 0
        self._acts = 0
        self._goes = False
        """Whether there is a goal that was not stopped."""
        for name in OPTIONAL:
            if hasattr(base, name):
                setattr(self, name, getattr(base, name))

    @property
    def capabilities(self) -> Capabilities:
        """The base's own."""
        return self._base.capabilities

    def now_s(self) -> float:
        """The base's clock."""
        return self._base.now_s()

    def localisation(self) -> Localisation | None:
        """As the base says."""
        return self._base.localisation()

    def tracks(self) -> Sequence[PersonTrack] | None:
        """As the base says."""
        return self._base.tracks()

    def heard(self, person: str) -> Sequence[Words]:
        """As the base says."""
        heard = getattr(self._base, "heard", None)
        return heard(person) if heard else ()

    def emergency(self) -> str | bool:
        """As the base says."""
        return self._base.emergency()

    def go(self, goal: MapGoal) -> GoalId:
        """Note that there is a goal."""
        self._goals, self._goes = self._goals + 1, True
        return self._goals

    def renew(self, goal: GoalId) -> None:
        """Nothing."""

    def motion(self) -> MotionStatus:
        """Under way, for as long as it takes; at rest where nothing is asked of it."""
        return MotionStatus(
            self._goals or None,
            "running" if self._goes else "stopped",
            "in its shadow: the robot is driven by others",
            stamp_s=self.now_s(),
            is_at_rest=not self._goes,
        )

    def perform(self, act: ActGoal) -> GoalId:
        """Nothing; what it is called."""
        self._acts += 1
        return f"shadow act {self._acts}"

    def performance(self, act: GoalId) -> ActStatus:
        """Done."""
        return ActStatus(act, "succeeded", "in its shadow: not performed")

    def stop(self, goal: GoalId | None = None) -> None:
        """Note that there is no goal any more."""
        if goal is None or goal == self._goals:
            self._goes = False
