"""Keep_distance: hold the pose while the greeting goes on."""

from __future__ import annotations

from py_trees.common import Status

from comity_executor.leaves.motion import MotionAction
from comity_executor.memory.meeting import POSE, Meeting
from comity_executor.robots.robot import DockingPose
from comity_fis.learning.signals import WORDS


class KeepDistance(MotionAction):
    """Always RUNNING: the robot's controller follows the person's small moves until the greeting ends.

    While the robot attends to how the person takes it, it stands where it docked and only turns: a person who
    steps back has said something. It moves again when the person asks it to.
    """

    def __init__(self, meeting: Meeting) -> None:
        super().__init__("Keep_distance", meeting, reads=(*POSE, "noticed"))
        self._granted: DockingPose | None = None

    def begin(self) -> None:
        """Hold, or stand."""
        super().begin()
        self._granted = None
        if self.meeting.limits.attend_s > 0.0:
            self.meeting.robot.face(self.meeting.person)
        else:
            self._hold()

    def step(self) -> Status:
        """Go on; whether the pose is lost is for `docked?` to say."""
        seen = self.meeting.memory.noticed
        if self.is_outdated():
            self._hold()
        if self._granted is None and seen is not None and seen.kind in WORDS:
            self._granted = self.meeting.pose
            self._hold()
        return Status.RUNNING

    def _hold(self) -> None:
        meeting = self.meeting
        meeting.robot.dock(meeting.person, meeting.pose, speed_m_s=meeting.approach_speed_m_s)
