"""Keep_distance: hold the pose while the greeting goes on."""

from __future__ import annotations

from py_trees.common import Status

from comity_executor.meeting import Meeting
from comity_executor.motion import MotionAction


class KeepDistance(MotionAction):
    """Always RUNNING: the robot's controller follows the person's small moves until the greeting ends."""

    def __init__(self, meeting: Meeting) -> None:
        super().__init__("Keep_distance", meeting)

    def begin(self) -> None:
        """Hold."""
        super().begin()
        meeting = self.meeting
        meeting.robot.dock(meeting.person, meeting.pose, speed_m_s=meeting.approach_speed_m_s)

    def step(self) -> Status:
        """Go on; whether the pose is lost is for `docked?` to say."""
        return Status.RUNNING
