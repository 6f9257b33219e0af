"""Whose command the base carries out."""

from __future__ import annotations

from dataclasses import dataclass

from py_trees.behaviour import Behaviour

from comity_executor.memory.shared import BaseHolder, SharedMemory
from comity_executor.robots.robot import Robot


@dataclass(frozen=True, slots=True)
class Drive:
    """The base, held by at most one leaf at a time.

    When a branch is preempted, the new leaf starts before the old one is halted in the same tick: the old one
    must then not stop the base, which is its successor's by now.
    """

    robot: Robot
    memory: SharedMemory

    def take(self, leaf: Behaviour) -> None:
        """A leaf is about to command the base."""
        self.memory.base = BaseHolder(leaf.name, leaf.id)

    def release(self, leaf: Behaviour) -> None:
        """A leaf ended: the base stops, unless another one has taken it."""
        holder = self.memory.base
        if holder is not None and holder.id == leaf.id:
            self.robot.stop()
            self.memory.base = None
