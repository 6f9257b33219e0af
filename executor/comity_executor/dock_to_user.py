"""Dock_to_user: approach, with the parameters that the person's culture sets (Bruno et al. 2017)."""

from __future__ import annotations

from py_trees.common import Status

from comity_executor.docking_band import enter_band
from comity_executor.meeting import Meeting
from comity_executor.motion import MotionAction


class DockToUser(MotionAction):
    """Move finely onto the chosen pose, at the person's own speed, and come to rest there.

    Args:
        meeting: Whose branch it belongs to.
        distance_m: The wanted distance between the bodies.
        bearing_deg: The wanted bearing, signed.
        speed_m_s: The approach speed.
    """

    def __init__(self, meeting: Meeting, *, distance_m: float, bearing_deg: float, speed_m_s: float) -> None:
        super().__init__("Dock_to_user", meeting)
        self.distance_m = distance_m
        self.bearing_deg = bearing_deg
        self.speed_m_s = speed_m_s

    def begin(self) -> None:
        """Approach the pose that Navigate_to_user chose: the wanted one, or what stands in for it."""
        super().begin()
        pose = self.meeting.pose
        self._band = enter_band(pose, self.meeting.limits)
        self.meeting.robot.dock(self.meeting.person, pose, speed_m_s=self.speed_m_s)

    def step(self) -> Status:
        """SUCCESS at rest on the pose, by the robot's reading and not by its word; FAILURE when stuck."""
        if self.is_stuck():
            return Status.FAILURE
        reading = self.meeting.senses.read(self.meeting.person)
        if reading is None or not self._band.contains_place(reading):
            return Status.RUNNING
        self.say(self._band.account(reading))
        return Status.SUCCESS
