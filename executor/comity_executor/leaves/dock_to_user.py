"""Dock_to_user: approach, with the parameters that the person's culture sets (Bruno et al. 2017)."""

from __future__ import annotations

from py_trees.common import Status

from comity_executor.leaves.docking_band import enter_band
from comity_executor.leaves.motion import MotionAction
from comity_executor.memory.meeting import POSE, Meeting
from comity_executor.robots.goals import MotionGoal


class DockToUser(MotionAction):
    """Move finely onto the chosen pose, at the person's own speed, and come to rest there.

    Its numbers are behaviour parameters: distance, bearing and speed may be bound anew while it runs.
    """

    def __init__(self, meeting: Meeting) -> None:
        super().__init__("Dock_to_user", meeting, reads=POSE)

    def begin(self) -> None:
        """Approach the pose that Navigate_to_user chose: the wanted one, or what stands in for it."""
        super().begin()
        self._dock()

    def step(self) -> Status:
        """SUCCESS at rest on the pose, by the robot's reading and not by its word; FAILURE when stuck."""
        if self.is_outdated():
            self._dock()
        if self.is_stuck():
            return Status.FAILURE
        reading = self.meeting.senses.read(self.meeting.person)
        if reading is None or not self._band.contains_place(reading):
            return Status.RUNNING
        self.say(self._band.account(reading))
        return Status.SUCCESS

    def _dock(self) -> None:
        meeting = self.meeting
        self._band = enter_band(meeting.pose, meeting.limits)
        self.go(MotionGoal("dock", meeting.person, meeting.pose, meeting.approach_speed_m_s))
