"""Keep_distance: hold the pose while the greeting goes on."""

from __future__ import annotations

from contextlib import suppress

from py_trees.common import Status

from comity_executor.leaves.motion import MotionAction
from comity_executor.memory.visit_context import POSE, VisitContext
from comity_executor.nodes.identity import NodeId
from comity_executor.robots.goals import MotionGoal, RelativePose
from comity_fis.learning.signals import WORDS


class KeepDistance(MotionAction):
    """Always RUNNING: the robot's controller follows the person's small moves until the greeting ends.

    While the robot observes the person's reaction, it stays where it docked and only turns: a person who
    steps back has sent a signal. It moves again when the person asks for it.
    """

    def __init__(self, meeting: VisitContext) -> None:
        super().__init__(NodeId.of("Keep_distance", meeting.person), meeting, reads=(*POSE, "noticed"))
        self._granted: RelativePose | None = None
        self._holds = False
        """Whether it holds the pose; otherwise it stands and turns."""

    def begin(self) -> None:
        """Hold the pose, or stand."""
        super().begin()
        self._granted = None
        self._command(holds=self.meeting.limits.attend_s == 0.0)

    def step(self) -> Status:
        """Continue; `docked?` decides whether the pose is lost.

        If the base rejects or loses the goal, it is commanded again after a pause: the robot stands at its
        pose meanwhile, and the greeting need not end.
        """
        seen = self.meeting.memory.noticed
        if self.is_outdated():
            self._command(holds=True)
        if self._granted is None and seen is not None and seen.kind in WORDS:
            self._granted = self.meeting.pose
            self._command(holds=True)
        since_s = self.meeting.senses.now_s() - self.commanded_s
        if since_s >= self.meeting.limits.reach_pause_s and self._is_lost():
            self._command(holds=self._holds)
        return Status.RUNNING

    def _is_lost(self) -> bool:
        try:
            self.motion()
        except Exception:
            return True
        return False

    def _command(self, *, holds: bool) -> None:
        meeting = self.meeting
        self._holds = holds
        with suppress(Exception):  # it is retried
            if holds:
                self.go(MotionGoal("dock", meeting.person, meeting.pose, meeting.approach_speed_m_s))
            else:
                self.go(MotionGoal("face", meeting.person))
