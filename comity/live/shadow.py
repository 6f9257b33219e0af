"""Shadow mode: a robot that is observed and never commanded; its driver sees what Comity would do."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from comity_executor import ActGoal, ActStatus, GoalId, MapGoal, MotionStatus

if TYPE_CHECKING:
    from comity_executor import Capabilities, Localisation, MapRobot, PersonTrack, Words

OPTIONAL = ("sleep", "gesture_reach_m", "floor_is_free")
"""Optional attributes that are not commands. `carried` is left out, as acts only count as done."""


class Shadow:
    """A `MapRobot` whose motion goals never end by themselves, and whose acts end at once.

    Whether a person was reached is judged by the robot's pose, as always: its driver may drive there.

    Args:
        base: The robot. Only its clock, localisation, tracker, speech recognition and stop are used.
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
        """Capabilities of the base."""
        return self._base.capabilities

    def now_s(self) -> float:
        """Clock of the base."""
        return self._base.now_s()

    def localisation(self) -> Localisation | None:
        """From the base."""
        return self._base.localisation()

    def tracks(self) -> Sequence[PersonTrack] | None:
        """From the base."""
        return self._base.tracks()

    def heard(self, person: str) -> Sequence[Words]:
        """From the base."""
        heard = getattr(self._base, "heard", None)
        return heard(person) if heard else ()

    def emergency(self) -> str | bool:
        """From the base."""
        return self._base.emergency()

    def go(self, goal: MapGoal) -> GoalId:
        """Record that there is a goal."""
        self._goals, self._goes = self._goals + 1, True
        return self._goals

    def renew(self, goal: GoalId) -> None:
        """Do nothing."""

    def motion(self) -> MotionStatus:
        """Running while there is a goal; otherwise at rest."""
        return MotionStatus(
            self._goals or None,
            "running" if self._goes else "stopped",
            "in its shadow: the robot is driven by others",
            stamp_s=self.now_s(),
            is_at_rest=not self._goes,
        )

    def perform(self, act: ActGoal) -> GoalId:
        """Do nothing; returns an identifier."""
        self._acts += 1
        return f"shadow act {self._acts}"

    def performance(self, act: GoalId) -> ActStatus:
        """Always succeeded."""
        return ActStatus(act, "succeeded", "in its shadow: not performed")

    def stop(self, goal: GoalId | None = None) -> None:
        """Record that there is no goal."""
        if goal is None or goal == self._goals:
            self._goes = False
