"""A timeout in the world's time; py_trees' own counts the time of the machine."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress

from py_trees.behaviour import Behaviour
from py_trees.common import Status
from py_trees.decorators import Decorator

from comity_executor.nodes.cause import Account, Provenance
from comity_executor.nodes.identity import NodeId, as_id


class SimulatedTimeout(Decorator):
    """Its child's result, or FAILURE if the child still runs when the time is over; the child is then halted.

    Args:
        name: The decorator's identity, or its name alone.
        child: What must end in time.
        duration_s: How long it may run, in the clock's seconds.
        clock: The world's time.
        provenance: The plan step that the child carries out.
        limit: What a scenario's limits call that time, for a reader who wants to change it.
        under_way: How far the child is, in words; asked when the time is over.
    """

    def __init__(
        self,
        name: NodeId | str,
        child: Behaviour,
        *,
        duration_s: float,
        clock: Callable[[], float],
        provenance: Provenance | None = None,
        limit: str | None = None,
        under_way: Callable[[], str] | None = None,
    ) -> None:
        self.node_id = as_id(name)
        super().__init__(self.node_id.name, child)
        self.provenance = provenance
        self.timed_out = False
        self.duration_s = duration_s
        self._clock = clock
        self._limit = limit
        self._under_way = under_way
        self._end_s = 0.0
        self._left = ""

    def initialise(self) -> None:
        """Start the clock."""
        self.timed_out = False
        self._end_s = self._clock() + self.duration_s

    def update(self) -> Status:
        """The child's result counts, even in the last moment."""
        if self.decorated.status == Status.RUNNING and self._clock() >= self._end_s:
            self.timed_out = True
            self._left = ""
            with suppress(Exception):  # a robot that cannot tell how it goes
                self._left = self._under_way() if self._under_way else ""
            return Status.FAILURE
        return self.decorated.status

    def account(self) -> Account | None:
        """That the time is over, if it is."""
        if not self.timed_out:
            return None
        limit = f" (`{self._limit}` of the scenario's limits allows more)" if self._limit else ""
        left = f"; at that moment: {self._left}" if self._left else ""
        text = f"{self.decorated.name} did not end within {self.duration_s:g} s{limit}{left}"
        return Account(text, self.duration_s)
