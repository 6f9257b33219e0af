"""A robot under a lease: its base is stopped if its goal is not renewed in time."""

from __future__ import annotations

import threading
import time
from contextlib import suppress
from math import inf

from comity_executor.robots.goals import ActGoal, GoalId, Motion, MotionGoal, MotionStatus
from comity_executor.robots.robot import Robot
from comity_executor.robots.status import has_stopped

EVERY_S = 0.02
"""Period of the watchdog, which also repeats unconfirmed stops [s]."""
STOPS_FOR_S = 60.0
"""Time for which an unconfirmed stop is repeated once Comity is gone [s] (our choice)."""


class Guard:
    """Guards the robot: calls come from one thread, `watch` runs in another.

    A lock keeps the watchdog's stop from hitting a goal that is given meanwhile. It is not held during any
    other call of the robot, as that might not return.

    Args:
        robot: The robot.
        lease_s: Time for which a goal holds without renewal [s].
    """

    def __init__(self, robot: Robot, lease_s: float) -> None:
        self._robot = robot
        self._lease_s = lease_s
        self._lock = threading.Lock()
        self._ends_s = inf
        self._goal: GoalId | None = None
        self._act: GoalId | None = None
        """The newest act."""
        self._expired: GoalId | None = None
        """The goal that was stopped because nothing was heard."""
        self._has_to_stop = False
        self._told_s = inf
        """Time of the last stop command, by the robot's clock [s]."""

    def go(self, goal: MotionGoal) -> GoalId:
        """Begin a lease, and then the goal."""
        with self._lock:
            self._ends_s, self._goal, self._has_to_stop = time.monotonic() + self._lease_s, None, False
        given = self._robot.go(goal)
        with self._lock:
            self._goal = given
            if self._ends_s == inf:  # the call took longer than the lease
                self._expired, self._has_to_stop = given, True
        return given

    def renew(self, goal: GoalId) -> None:
        """Prolong the newest goal's lease, unless it is over."""
        with self._lock:
            now_s = time.monotonic()
            if goal == self._goal and now_s < self._ends_s < inf:
                self._ends_s = now_s + self._lease_s

    def motion(self) -> Motion:
        """What the robot says; `aborted` of a goal that was not renewed."""
        motion = self._robot.motion()
        if self._expired is None or motion.goal != self._expired:
            return motion
        text = f"it was not renewed for {self._lease_s:g} s"
        rests = bool(motion.is_at_rest)
        return MotionStatus(motion.goal, "aborted", text, stamp_s=motion.stamp_s, is_at_rest=rests)

    def perform(self, act: ActGoal) -> GoalId:
        """Begin an act."""
        self._act = self._robot.perform(act)
        return self._act

    def look(self) -> None:
        """Stop the base where its time is over, until it rests."""
        with self._lock:
            if time.monotonic() >= self._ends_s:
                self._ends_s, self._expired, self._has_to_stop, self._told_s = inf, self._goal, True, inf
            if self._has_to_stop:
                self._stop()
        if self._has_to_stop and self._rests():
            self._has_to_stop = False

    def watch(self) -> None:
        """Look all the while."""
        while True:
            self.look()
            time.sleep(EVERY_S)

    def stop_for_good(self) -> None:
        """The client is gone: end the act, and stop the base until it confirms rest."""
        ends_s = time.monotonic() + STOPS_FOR_S
        while time.monotonic() < ends_s:
            self._stop()
            if self._rests():
                return
            time.sleep(EVERY_S)

    def _rests(self) -> bool:
        with suppress(Exception):
            self._told_s = min(self._told_s, self._robot.now_s())
            return has_stopped(self._robot, self._told_s)
        return False

    def _stop(self) -> None:
        """Once; what raises is told again."""
        with suppress(Exception):
            self._robot.stop()
        if self._act is not None:
            with suppress(Exception):
                self._robot.stop(self._act)
                self._act = None
