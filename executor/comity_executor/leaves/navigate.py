"""Navigate_to_user: choose where to stand near the person, and go there until close."""

from __future__ import annotations

from py_trees.common import Status

from comity_executor.leaves.motion import MotionAction
from comity_executor.memory.visit_context import VisitContext
from comity_executor.nodes.cause import Account
from comity_executor.nodes.fault import WAY
from comity_executor.nodes.identity import NodeId
from comity_executor.robots.goals import MotionGoal


class NavigateToUser(MotionAction):
    """The first part of Reach_user: each attempt chooses the pose again; the robot finds the route.

    If it is stuck, the pose is chosen once more: a spot in front of a walking person may not stay free.
    """

    def __init__(self, meeting: VisitContext, *, verb: str = "Navigate_to_user") -> None:
        super().__init__(
            NodeId.of(verb, meeting.person),
            meeting,
            reads=("reach", "values", "shown", "asked", "in_vain"),
            writes=("pose",),
        )

    def begin(self) -> None:
        """Choose the pose and set out; fail without a pose."""
        super().begin()
        self.meeting.choose_pose()
        self._go()

    def step(self) -> Status:
        """SUCCESS close to the pose; FAILURE without a pose or when stuck."""
        if self.is_outdated():
            self._go()
        if self.meeting.memory.pose is None:
            text = f"no free and reachable place to stand near {self.meeting.person}"
            self.say(Account(text, fault=self.trouble(WAY)))
            return Status.FAILURE
        if self.is_stuck() and (self.meeting.memory.declined or not self._goes_elsewhere()):
            return Status.FAILURE
        if self.motion().state != "succeeded":
            return Status.RUNNING
        shown = self.meeting.shown
        wanted = f", who had it stand at {shown.distance_m:.2f} m" if shown else ""
        self.say(Account(f"close to {self.meeting.person}{wanted}", parameter="conversational_distance"))
        return Status.SUCCESS

    def _goes_elsewhere(self) -> bool:
        """Set out to another pose, if one is available."""
        before = self.meeting.memory.pose
        self.meeting.choose_pose()
        if self.meeting.memory.pose is None or self.meeting.memory.pose == before:
            return False
        super().begin()
        self._go()
        return True

    def _go(self) -> None:
        meeting = self.meeting
        if meeting.memory.pose is not None:
            self.go(
                MotionGoal(
                    "navigate",
                    meeting.person,
                    meeting.memory.pose,
                    speed_m_s=meeting.limits.cruise_speed_m_s,
                    near_m_s=meeting.approach_speed_m_s,
                    detour_m=meeting.detour_m,
                )
            )
