"""The visits of a plan as a subtree of a custom tree."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from py_trees.behaviour import Behaviour
from py_trees.common import Status
from py_trees.trees import BehaviourTree
from py_trees.visitors import VisitorBase

from comity_executor.execution import Execution


class VisitSubtree(Behaviour):
    """An execution that is ticked by another tree: RUNNING while visits go on, then SUCCESS or FAILURE.

    Every begin is an execution of its own, made for how things are then; what was said and shown before a
    halt is not repeated. Halted from above, the robot stops,
    and the trace of that execution says by which node. Its tree hangs below this node as long as it is the
    last one, for visitors and `py_trees.display`; the caller that ticks the tree owns the world's time.

    Args:
        name: The name of the node.
        make: Makes an execution; called whenever the node begins.
    """

    def __init__(self, name: str, make: Callable[[], Execution]) -> None:
        super().__init__(name)
        self._make = make
        self._shown = _Shown()
        self.execution: Execution | None = None
        """The last one; None before the first begin."""

    def initialise(self) -> None:
        """Begin the visits, or go on where they were halted."""
        before, self.execution = self.execution, self._make()
        if before is not None and before.status in ("stopped", "stop_unconfirmed"):
            self.execution.go_on_from(before)
        self.execution.tree.add_visitor(self._shown)
        self._show(self.execution.tree)

    def tick(self) -> Iterator[Behaviour]:
        """Tick the execution once, and show the nodes that it has ticked."""
        self._shown.nodes.clear()
        for node in super().tick():
            yield from self._shown.nodes
            yield node

    def update(self) -> Status:
        """Tick the execution once."""
        execution = self.execution
        assert execution is not None  # initialise comes first
        status = execution.tick()
        self._show(execution.tree)  # another tree where it was replanned
        if status == "running":
            return Status.RUNNING
        return Status.SUCCESS if status == "success" else Status.FAILURE

    def terminate(self, new_status: Status) -> None:
        """Stop the visits where they are halted; what has ended stays as it is."""
        if self.execution is not None and new_status is Status.INVALID:
            above = self.parent.name if self.parent else "its tree"
            self.execution.stop(f"{above} stopped {self.name}", halt="parent_ended")

    def _show(self, tree: BehaviourTree) -> None:
        self.children = [tree.root]


class _Shown(VisitorBase):
    """The nodes that were ticked since the list was cleared."""

    def __init__(self) -> None:
        super().__init__(full=False)
        self.nodes: list[Behaviour] = []

    def run(self, behaviour: Behaviour) -> None:
        """A node was ticked."""
        self.nodes.append(behaviour)
