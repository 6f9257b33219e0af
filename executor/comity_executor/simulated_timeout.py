"""A timeout in the world's time; py_trees' own counts the time of the machine."""

from __future__ import annotations

from collections.abc import Callable

from py_trees.behaviour import Behaviour
from py_trees.common import Status
from py_trees.decorators import Decorator

from comity_executor.cause import Account, Grounds


class SimulatedTimeout(Decorator):
    """Its child's result, or FAILURE if the child still runs when the time is over; the child is then halted.

    Args:
        name: The decorator's name.
        child: What must end in time.
        duration_s: How long it may run, in the clock's seconds.
        clock: The world's time.
        grounds: The plan step that the child carries out.
    """

    def __init__(
        self,
        name: str,
        child: Behaviour,
        *,
        duration_s: float,
        clock: Callable[[], float],
        grounds: Grounds | None = None,
    ) -> None:
        super().__init__(name, child)
        self.grounds = grounds
        self.timed_out = False
        self.duration_s = duration_s
        self._clock = clock
        self._end_s = 0.0

    def initialise(self) -> None:
        """Start the clock."""
        self.timed_out = False
        self._end_s = self._clock() + self.duration_s

    def update(self) -> Status:
        """The child's result counts, even in the last moment."""
        if self.decorated.status == Status.RUNNING and self._clock() >= self._end_s:
            self.timed_out = True
            return Status.FAILURE
        return self.decorated.status

    def account(self) -> Account | None:
        """That the time is over, if it is."""
        if not self.timed_out:
            return None
        return Account(f"{self.decorated.name} did not end within {self.duration_s:g} s", self.duration_s)
