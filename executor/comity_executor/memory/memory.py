"""What an execution remembers over all its plans: a namespace of the blackboard, and the boards in it."""

from __future__ import annotations

from collections.abc import Callable

from comity_executor.memory.board import Namespace
from comity_executor.memory.shared import SharedMemory
from comity_executor.memory.visit import VisitMemory


class Memory:
    """The memory of one execution.

    Args:
        clock: The world's time [s].
    """

    def __init__(self, clock: Callable[[], float]) -> None:
        self.space = Namespace(clock)
        self.shared = SharedMemory(self.space)
        self.visits: dict[str, VisitMemory] = {}
        """By person, in the order in which people were first planned for."""

    def visit(self, person: str) -> VisitMemory:
        """What is remembered of the visit of a person; nothing yet when they are first planned for."""
        if person not in self.visits:
            self.visits[person] = VisitMemory(self.space, person)
        return self.visits[person]

    def close(self) -> None:
        """Take all of it off py_trees' blackboard; what was remembered can still be read here."""
        self.space.close()
