"""Face_user: turn towards the person."""

from __future__ import annotations

from py_trees.common import Status

from comity_executor.leaves.docking_band import enter_band, lost_band
from comity_executor.leaves.motion import MotionAction
from comity_executor.memory.visit_context import POSE, VisitContext
from comity_executor.nodes.identity import NodeId
from comity_executor.robots.goals import MotionGoal
from comity_executor.robots.robot import Reading


class FaceUser(MotionAction):
    """The last part of Reach_user.

    `docked?` is checked before it in every tick, so it usually ends early, once that is true. It fails if the
    robot, which does not hold its position while turning, has lost the pose, or has finished turning but is
    off the pose for longer than `blocked_s`; Reach_user is then retried.
    """

    def __init__(self, meeting: VisitContext) -> None:
        super().__init__(NodeId.of("Face_user", meeting.person), meeting, reads=POSE)

    def begin(self) -> None:
        """Start turning."""
        super().begin()
        pose, limits = self.meeting.pose, self.meeting.limits
        self._docked, self._lost = enter_band(pose, limits), lost_band(pose, limits)
        self._turned_s: float | None = None
        self.go(MotionGoal("face", self.meeting.person))

    def step(self) -> Status:
        """SUCCESS when docked and facing; FAILURE when stuck or when the pose is lost."""
        if self.is_stuck():
            return Status.FAILURE
        reading = self.meeting.senses.read(self.meeting.person)
        if reading is None:
            return Status.RUNNING
        if self._docked.contains(reading):
            self.say(self._docked.account(reading))
            return Status.SUCCESS
        is_near = self._lost.contains_place(reading)
        if is_near and not self._has_turned(reading):
            return Status.RUNNING
        self.say((self._docked if is_near else self._lost).account(reading))
        return Status.FAILURE

    def _has_turned(self, reading: Reading) -> bool:
        """Whether it faces the person and has stood long enough that turning further would change nothing."""
        if reading.facing_error_deg > self._docked.facing_deg or reading.speed_m_s >= self._docked.speed_m_s:
            self._turned_s = None
            return False
        now_s = self.meeting.senses.now_s()
        if self._turned_s is None:
            self._turned_s = now_s
        return now_s - self._turned_s >= self.meeting.limits.blocked_s
