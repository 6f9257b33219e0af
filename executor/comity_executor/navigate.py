"""Navigate_to_user: choose where to stand near the person, and go there until close."""

from __future__ import annotations

from py_trees.common import Status

from comity_executor.cause import Account
from comity_executor.meeting import Meeting
from comity_executor.motion import MotionAction
from comity_fis.curve import Choice, Curve


class NavigateToUser(MotionAction):
    """The first part of Reach_user: the pose is chosen anew in every attempt, the robot finds the route."""

    def __init__(self, meeting: Meeting) -> None:
        super().__init__("Navigate_to_user", meeting)

    def begin(self) -> None:
        """Choose the pose and set out; without a pose there is nowhere to go."""
        super().begin()
        meeting = self.meeting
        meeting.memory.pose = meeting.robot.choose_pose(
            meeting.person,
            distance_m=meeting.wanted.distance_m,
            bearing_deg=meeting.wanted.bearing_deg,
            distance_desirability=self._desirability("conversational_distance"),
            direction_desirability=self._desirability("approach_direction"),
        )
        if meeting.memory.pose is not None:
            speed = meeting.limits.cruise_speed_m_s
            meeting.robot.navigate(
                meeting.person, meeting.memory.pose, speed_m_s=speed, detour_m=meeting.detour_m
            )

    def step(self) -> Status:
        """SUCCESS close to the pose; FAILURE without a pose or when stuck."""
        if self.meeting.memory.pose is None:
            self.say(Account(f"no free and reachable place to stand near {self.meeting.person}"))
            return Status.FAILURE
        if self.is_stuck():
            return Status.FAILURE
        if self.meeting.robot.motion().state != "arrived":
            return Status.RUNNING
        self.say(Account(f"close to {self.meeting.person}", parameter="conversational_distance"))
        return Status.SUCCESS

    def _desirability(self, parameter: str) -> Curve:
        curve = self.meeting.values[parameter].desirability
        if isinstance(curve, Choice):
            raise TypeError(f"{parameter} is nominal: it has no desirability over a range")
        return curve
