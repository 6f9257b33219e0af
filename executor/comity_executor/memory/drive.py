"""Whose goal the base carries out."""

from __future__ import annotations

from dataclasses import dataclass

from py_trees.behaviour import Behaviour

from comity_executor.memory.shared import BaseHolder, SharedMemory
from comity_executor.robots.goals import GoalId, MotionGoal
from comity_executor.robots.robot import Robot


@dataclass(frozen=True, slots=True)
class Drive:
    """The base, held by at most one leaf at a time.

    A leaf that ends does not stop the base: another one may command it in the same tick, and a stop before
    that command could reach a base with latency after it. Where none does, the execution stops that goal at
    the end of the tick: by its id, so that a late cancel does not hit the goal of a later tick.
    """

    robot: Robot
    memory: SharedMemory

    def go(self, leaf: Behaviour, goal: MotionGoal) -> GoalId:
        """Have the base carry out a goal of a leaf, in place of the goal before it."""
        try:
            given = self.robot.go(goal)
        except Exception:
            self.memory.base = BaseHolder(leaf.name, leaf.id)  # it may have begun all the same
            raise
        self.memory.base = BaseHolder(leaf.name, leaf.id, given)
        return given

    def stop(self, leaf: Behaviour) -> None:
        """Bring the base to rest for a leaf, whatever it does."""
        self.memory.base = BaseHolder(leaf.name, leaf.id)
        self.robot.stop()
