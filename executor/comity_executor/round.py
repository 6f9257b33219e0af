"""One plan under way: its tree, and the record of it. An execution has a round for every plan."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from py_trees.common import Status

from comity_domain.plans.plan import Plan
from comity_executor.nodes.cause import Cause
from comity_executor.nodes.node import Node, describe, preorder
from comity_executor.tracing.recorder import Recorder
from comity_executor.tracing.trace import EventStatus, Halt, TraceEvent
from comity_executor.trees.tree import Tree
from comity_fis.inference.value import Inference


class Round:
    """A plan with its tree.

    Args:
        plan: What is carried out.
        tree: Its tree.
        unserved: Who is left and not in the plan, and why.
        first_path: Where the tree's root stands among the nodes of all trees of the execution.
    """

    def __init__(self, plan: Plan, tree: Tree, unserved: Mapping[str, str], *, first_path: int = 0) -> None:
        self.plans = [plan]
        """The plan, and what was left of it each time that it was bound to new numbers."""
        self.tree = tree
        self.unserved = unserved
        self._first_path = first_path
        self._recorder = Recorder(tree.root)
        self._notes: list[tuple[int, TraceEvent]] = []
        self._events: list[TraceEvent] = []
        self._taken = 0
        self.nodes = tuple(self._placed(node) for node in describe(tree.root))

    @property
    def plan(self) -> Plan:
        """What is left of it."""
        return self.plans[-1]

    def tick(self, t: float) -> Status:
        """Tick the tree once; the status of its root."""
        self._recorder.tick(t)
        return self.tree.root.status

    def stop(self, t: float, text: str, halt: Halt) -> None:
        """Halt the tree."""
        self._recorder.stop(t, text, halt)

    def note(self, t: float, status: EventStatus, because: tuple[Cause, ...]) -> None:
        """Put on record what became of the plan itself; it stands at `plan_holds?`."""
        holds = self.tree.holds
        path = self._first_path + next(i for i, node in enumerate(preorder(self.tree.root)) if node is holds)
        event = TraceEvent(t, holds.name, path, status, None, because)
        self._notes.append((len(self._recorder.events), event))

    def rebind(self, plan: Plan, values: Mapping[str, Inference]) -> None:
        """Give the same choices new numbers."""
        self.plans.append(plan)
        _ = self.events  # what happened is told with the numbers that it happened with
        self.tree.rebind(plan, values)
        self._recorder.reground()

    @property
    def events(self) -> tuple[TraceEvent, ...]:
        """What happened so far."""
        recorded = self._recorder.events
        while self._notes and self._notes[0][0] <= len(recorded):
            place, note = self._notes.pop(0)
            self._take(recorded[self._taken : place])
            self._events.append(note)
        self._take(recorded[self._taken :])
        return tuple(self._events)

    def _take(self, events: tuple[TraceEvent, ...]) -> None:
        self._taken += len(events)
        first = self._first_path
        self._events += (replace(e, path=e.path + first) for e in events) if first else events

    def _placed(self, node: Node) -> Node:
        if not self._first_path:
            return node
        parent = None if node.parent is None else node.parent + self._first_path
        return Node(node.path + self._first_path, node.name, node.kind, parent)
