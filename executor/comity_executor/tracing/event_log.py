"""What a recorder wrote down, in columns; a tick need not make events of it, whoever asks does."""

from __future__ import annotations

from array import array
from collections.abc import Iterator, Mapping
from typing import NamedTuple

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from comity_executor.nodes.cause import Cause, Grounds, Telling, chain, told
from comity_executor.tracing.trace import EventStatus, Halt, TraceEvent

WORDS: Mapping[Status, EventStatus] = {
    Status.RUNNING: "running",
    Status.SUCCESS: "success",
    Status.FAILURE: "failure",
    Status.INVALID: "halted",
}
"""A node that is INVALID after it ran was halted."""


class Reason(NamedTuple):
    """Why a node was halted."""

    halt: Halt
    condition: str | None = None
    """The node that decided, and its result."""
    telling: Telling | None = None
    grounds: Grounds | None = None

    @property
    def because(self) -> tuple[Cause, ...]:
        """The chain of causes."""
        return chain(self.condition, told(self.telling), self.grounds)


class EventLog:
    """Grows by one row per event. Columns, as tens of thousands of small objects would slow every tick.

    Args:
        paths: Where every node stands in the tree.
        grounds: What the nodes stand on that can account for themselves.
    """

    def __init__(self, paths: Mapping[Behaviour, int], grounds: Mapping[Behaviour, Grounds | None]) -> None:
        self._paths = paths
        self._grounds = grounds
        self._t = array("d")
        self._nodes: list[Behaviour] = []
        self._statuses: list[Status] = []
        self._tellings: dict[int, Telling] = {}
        self._reasons: dict[int, Reason] = {}
        self._events: list[TraceEvent] = []

    def result(self, t: float, node: Behaviour, status: Status, telling: Telling | None) -> None:
        """A node came out otherwise than before; what it has to say about it, if anything."""
        if telling is not None:
            self._tellings[len(self._t)] = telling
        self._t.append(t)
        self._nodes.append(node)
        self._statuses.append(status)

    def halt(self, t: float, node: Behaviour, reason: Reason) -> None:
        """A node was halted."""
        self._reasons[len(self._t)] = reason
        self._t.append(t)
        self._nodes.append(node)
        self._statuses.append(Status.INVALID)

    def stand_on(self, grounds: Mapping[Behaviour, Grounds | None]) -> None:
        """The nodes stand on other grounds from now on; what happened before keeps its own."""
        self._events += self._new_events()
        self._grounds = grounds

    @property
    def events(self) -> tuple[TraceEvent, ...]:
        """All rows so far."""
        self._events += self._new_events()
        return tuple(self._events)

    def _new_events(self) -> Iterator[TraceEvent]:
        for row in range(len(self._events), len(self._t)):
            node, reason = self._nodes[row], self._reasons.get(row)
            yield TraceEvent(
                t=self._t[row],
                node=node.name,
                path=self._paths[node],
                status=WORDS[self._statuses[row]],
                halt=reason.halt if reason else None,
                because=reason.because if reason else self._own_causes(row, node),
            )

    def _own_causes(self, row: int, node: Behaviour) -> tuple[Cause, ...]:
        telling = self._tellings.get(row)
        return chain(None, told(telling), self._grounds[node]) if telling else ()
