"""The tick of py_trees in plain calls: the same visits, results, resets and hooks, in less time.

py_trees ticks by nested generators, which pass every node up through all its ancestors, and words messages
for a debug log that nobody reads: a third of the time of a visit. Every node of a tree gets a counterpart
here that does what the node's own `tick` and `stop` do, in the same order (py_trees 2.4: behaviour.py,
composites.py, decorators.py). Nodes with a `tick` or `stop` of their own keep it. The tests hold random trees
to py_trees' own tick.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Generic, Protocol, TypeVar

from py_trees.behaviour import Behaviour
from py_trees.common import ParallelPolicy, Status
from py_trees.composites import Composite, Parallel, Selector, Sequence
from py_trees.decorators import Decorator

from comity_executor.nodes.act_timeout import ActTimeout

RUNNING, SUCCESS, FAILURE, INVALID = Status.RUNNING, Status.SUCCESS, Status.FAILURE, Status.INVALID
"""By names of their own, as Python 3.11 takes its time to look a member of an enumeration up."""
Seen = Mapping[Behaviour, Status]
"""What was last seen of every node."""
Note = Callable[[Behaviour], None]
"""Told of every node that was ticked and is otherwise than it was seen, children before parents."""
Kind = TypeVar("Kind", bound=Behaviour)
Group = TypeVar("Group", bound=Composite)


class Ticked(Protocol):
    """Ticks one node, and all below it."""

    @property
    def node(self) -> Behaviour:
        """The node."""
        ...

    def tick(self) -> Status:
        """Tick it; its result."""
        ...

    def stop(self, status: Status) -> None:
        """End its round with a result, INVALID where it is halted or reset."""
        ...


def ticked(node: Behaviour, seen: Seen, note: Note) -> Ticked:
    """What ticks a tree; its nodes must not be added, removed or moved afterwards."""
    selected = isinstance(node, Parallel) and isinstance(node.policy, ParallelPolicy.SuccessOnSelected)
    for kind, counterpart in () if selected else KINDS:
        if type(node).tick is kind.tick and type(node).stop is kind.stop:
            return counterpart(node, seen, note)
    return _Own(node, seen, note)


class _Counterpart(Generic[Kind]):
    """What stands beside one node."""

    def __init__(self, node: Kind, seen: Seen, note: Note) -> None:
        self.node, self._seen, self._note = node, seen, note
        self._begins = type(node).initialise is not Behaviour.initialise
        self._ends = type(node).terminate is not Behaviour.terminate
        """Whether it does anything when it begins, and when it ends: most nodes do not."""


class _Leaf(_Counterpart[Behaviour]):
    def tick(self) -> Status:
        node = self.node
        if self._begins and node.status is not RUNNING:
            node.initialise()
        status = node.update()
        if self._ends and status is not RUNNING:
            node.terminate(status)
        node.status = status
        if self._seen.get(node) is not status:
            self._note(node)
        return status

    def stop(self, status: Status) -> None:
        if self._ends:
            self.node.terminate(status)
        self.node.status = status


class _Composite(_Counterpart[Group]):
    """What composites share: `stop` of py_trees' `Composite`."""

    def __init__(self, node: Group, seen: Seen, note: Note) -> None:
        super().__init__(node, seen, note)
        self._children = [ticked(child, seen, note) for child in node.children]

    def stop(self, status: Status) -> None:
        node = self.node
        if status is INVALID:
            node.current_child = None
            _reset(self._children)
        if self._ends:
            node.terminate(status)
        node.status = status

    def _begin(self) -> None:
        node = self.node
        node.current_child = node.children[0] if node.children else None
        if self._begins:
            node.initialise()

    def _end(self, status: Status) -> Status:
        """Take a result over, and show it."""
        node = self.node
        if status is RUNNING:
            node.status = status
        else:
            self.stop(status)
        if self._seen.get(node) is not status:
            self._note(node)
        return status


class _Sequence(_Composite[Sequence]):
    def tick(self) -> Status:
        node, children, first = self.node, self._children, 0
        if node.status is not RUNNING:
            _reset(children)
            self._begin()
        elif node.memory and node.current_child is not None:
            first = node.children.index(node.current_child)
        previous = node.current_child
        for i in range(first, len(children)):
            child = children[i]
            node.current_child = child.node
            if (status := child.tick()) is not SUCCESS:
                if not node.memory and previous is not child.node:
                    _reset(children[i + 1 :])
                return self._end(status)
        return self._end(SUCCESS)


class _Selector(_Composite[Selector]):
    def tick(self) -> Status:
        node, children, first = self.node, self._children, 0
        if node.status is not RUNNING:
            self._begin()
        previous = node.current_child
        if node.memory and previous is not None:
            first = node.children.index(previous)
            _reset(children[:first])
        for i in range(first, len(children)):
            child = children[i]
            status = child.tick()
            if status is RUNNING or status is SUCCESS:
                node.current_child = child.node
                if previous is not child.node:
                    _reset(children[i + 1 :])
                return self._end(status)
        if children:
            node.current_child = children[-1].node
        return self._end(FAILURE)


class _Parallel(_Composite[Parallel]):
    def tick(self) -> Status:
        node, children = self.node, self._children
        if node.status is not RUNNING:
            _reset(children)
            node.current_child = None
            node.initialise()
        synchronise = node.policy.synchronise
        for child in children:
            if not (synchronise and child.node.status is SUCCESS):
                child.tick()
        return self._end(self._result())

    def stop(self, status: Status) -> None:
        for child in self._children:
            if child.node.status is RUNNING:
                child.stop(INVALID)
        super().stop(status)

    def _result(self) -> Status:
        """By the policy; `current_child` is the one that decided."""
        node = self.node
        nodes = node.children
        statuses = [child.status for child in nodes]
        node.current_child = nodes[-1] if nodes else None
        if FAILURE in statuses:
            node.current_child = nodes[statuses.index(FAILURE)]
            return FAILURE
        if isinstance(node.policy, ParallelPolicy.SuccessOnAll):
            return SUCCESS if statuses.count(SUCCESS) == len(statuses) else RUNNING
        succeeded = [child for child in nodes if child.status is SUCCESS]
        if succeeded or not nodes:
            node.current_child = succeeded[-1] if succeeded else None
            return SUCCESS
        return RUNNING


class _Decorator(_Counterpart[Decorator]):
    def __init__(self, node: Decorator, seen: Seen, note: Note) -> None:
        super().__init__(node, seen, note)
        self._child = ticked(node.decorated, seen, note)

    def tick(self) -> Status:
        node = self.node
        if node.status is not RUNNING:
            node.initialise()
        self._child.tick()
        status = node.update()
        if status is not RUNNING:
            self.stop(status)
        node.status = status
        if self._seen.get(node) is not status:
            self._note(node)
        return status

    def stop(self, status: Status) -> None:
        node, child = self.node, self._child
        node.terminate(status)
        if status is INVALID:
            child.stop(INVALID)
        if child.node.status is RUNNING:
            child.stop(INVALID)
        node.status = status


class _ActTimeout(_Decorator):
    def __init__(self, node: ActTimeout, seen: Seen, note: Note) -> None:
        super().__init__(node, seen, note)
        self._pauses = node.pauses

    def tick(self) -> Status:
        if not self._pauses():
            return super().tick()
        if self._seen.get(self.node) is not RUNNING:
            self._note(self.node)
        return RUNNING


class _Own(_Counterpart[Behaviour]):
    """A node that ticks or stops in its own way."""

    def tick(self) -> Status:
        for node in self.node.tick():
            if self._seen.get(node) is not node.status:
                self._note(node)
        return self.node.status

    def stop(self, status: Status) -> None:
        self.node.stop(status)


def _reset(children: Iterable[Ticked]) -> None:
    for child in children:
        if child.node.status is not INVALID:
            child.stop(INVALID)


KINDS: tuple[tuple[type[Behaviour], Callable[..., Ticked]], ...] = (
    (Behaviour, _Leaf),
    (Sequence, _Sequence),
    (Selector, _Selector),
    (Parallel, _Parallel),
    (Decorator, _Decorator),
    (ActTimeout, _ActTimeout),
)
"""What a node's class must tick and stop like, and what takes its place."""
