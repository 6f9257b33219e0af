"""Dock_to_user: approach, with the parameters that the person's culture sets (Bruno et al. 2017)."""

from __future__ import annotations

from py_trees.common import Status

from comity_executor.leaves.docking_band import DockingBand, enter_band
from comity_executor.leaves.motion import MotionAction
from comity_executor.memory.visit_context import POSE, VisitContext
from comity_executor.nodes.identity import NodeId
from comity_executor.robots.goals import MotionGoal
from comity_executor.robots.robot import Reading


class DockToUser(MotionAction):
    """Move precisely onto the chosen pose, at the person's preferred speed, and come to rest there.

    Its values are behaviour parameters: distance, bearing and speed may be updated while it runs.
    """

    def __init__(self, meeting: VisitContext) -> None:
        super().__init__(NodeId.of("Dock_to_user", meeting.person), meeting, reads=POSE)
        self._band: DockingBand
        """The band around the last commanded pose."""
        self._rested_s: float | None = None

    def begin(self) -> None:
        """Approach the pose that Navigate_to_user chose: the target pose or its replacement."""
        super().begin()
        self._dock()

    def step(self) -> Status:
        """SUCCESS at rest on the pose, judged by the reading rather than by the robot's report.

        FAILURE if stuck, or at rest elsewhere; the reason is the quantity outside the band.
        """
        if self.is_outdated():
            self._dock()
        if self.is_stuck():
            return Status.FAILURE
        reading = self.meeting.senses.read(self.meeting.person)
        if reading is None:
            return Status.RUNNING
        if self._band.contains_place(reading):
            self.say(self._band.account(reading))
            return Status.SUCCESS
        if not self._has_come_to_rest(reading):
            return Status.RUNNING
        self.say(self._band.account(reading))
        return Status.FAILURE

    def _has_come_to_rest(self, reading: Reading) -> bool:
        """Whether the base has stood long enough since it reported docking that it will not move on."""
        if self.motion().state != "succeeded" or reading.speed_m_s >= self._band.speed_m_s:
            self._rested_s = None
            return False
        now_s = self.meeting.senses.now_s()
        if self._rested_s is None:
            self._rested_s = now_s
        return now_s - self._rested_s >= self.meeting.limits.blocked_s

    def _dock(self) -> None:
        self._rested_s = None
        meeting = self.meeting
        self._band = enter_band(meeting.pose, meeting.limits)
        self.go(MotionGoal("dock", meeting.person, meeting.pose, meeting.approach_speed_m_s))
