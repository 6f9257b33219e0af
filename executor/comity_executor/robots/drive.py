"""Whose command the base carries out."""

from __future__ import annotations

from comity_executor.robots.robot import Robot


class Drive:
    """The base, held by at most one leaf at a time.

    When a branch is preempted, the new leaf starts before the old one is halted in the same tick: the old one
    must then not stop the base, which is its successor's by now.
    """

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        self._holder: object = None

    def take(self, leaf: object) -> None:
        """A leaf is about to command the base."""
        self._holder = leaf

    def release(self, leaf: object) -> None:
        """A leaf ended: the base stops, unless another one has taken it."""
        if self._holder is leaf:
            self._holder = None
            self._robot.stop()
