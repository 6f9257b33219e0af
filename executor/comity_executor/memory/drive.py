"""Whose command the base carries out."""

from __future__ import annotations

from dataclasses import dataclass

from py_trees.behaviour import Behaviour

from comity_executor.memory.shared import BaseHolder, SharedMemory
from comity_executor.robots.robot import Robot


@dataclass(frozen=True, slots=True)
class Drive:
    """The base, held by at most one leaf at a time.

    A leaf that ends does not stop the base: another one may command it in the same tick, and a stop before
    that command could reach a base with latency after it. Where none does, the execution stops the base at
    the end of the tick.
    """

    robot: Robot
    memory: SharedMemory

    def take(self, leaf: Behaviour) -> None:
        """A leaf is about to command the base."""
        self.memory.base = BaseHolder(leaf.name, leaf.id)
