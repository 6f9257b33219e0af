"""The exact recorder: every change of every node of a py_trees tree, and the cause of every halt.

py_trees shows a visitor the nodes that were ticked. A node that its parent stops is never shown, so that a
visitor alone misses halts or keeps saying RUNNING. The recorder therefore keeps what it last saw of every
node, and after each tick looks at those it saw RUNNING: the ones that are INVALID now were halted. What a
parent resets after its end (py_trees clears old results when a composite starts again) is not an event. Only
the order among the halts of one tick is lost; they are listed in pre-order, after the tick's other events.

An attempt of a retry is a new start: once it is over, what was seen below the retry counts no more, and the
next attempt is recorded in full, also where every node comes out as it did in the one before.

The cause of a halt is the first leaf, in the order of the visit, whose result changed in this tick, within
the branch that decided: the sibling of the halted node that ran, failed or succeeded instead. Siblings that
changed and decided nothing are not blamed.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from py_trees.behaviour import Behaviour
from py_trees.common import Status
from py_trees.composites import Parallel, Selector, Sequence
from py_trees.decorators import Decorator

from comity_executor.nodes.act_timeout import ActTimeout
from comity_executor.nodes.cause import Account, Explains, explains
from comity_executor.nodes.emergency import EmergencyGuard
from comity_executor.nodes.node import preorder
from comity_executor.nodes.retry import Retry
from comity_executor.nodes.simulated_timeout import SimulatedTimeout
from comity_executor.nodes.ticking import INVALID, ticked
from comity_executor.tracing.event_log import WORDS, EventLog, Reason
from comity_executor.tracing.trace import Halt, TraceEvent

RETRIES = (Retry, ActTimeout)
"""Decorators that start their child anew after a failure."""


class Recorder:
    """Ticks a tree and records it.

    Args:
        root: The tree; its nodes must not be added, removed or moved afterwards.
    """

    def __init__(self, root: Behaviour) -> None:
        self._t = 0.0
        self._paths = {node: path for path, node in enumerate(preorder(root))}
        self._explaining = dict(_explaining(self._paths))
        self._log = EventLog(self._paths, {node: one.grounds for node, one in self._explaining.items()})
        self._seen: dict[Behaviour, Status] = dict.fromkeys(self._paths, Status.INVALID)
        self._ticked = ticked(root, self._seen, self._note)
        self._attempted = {
            node.decorated: (*preorder(node.decorated),) for node in self._paths if isinstance(node, RETRIES)
        }
        self._over: list[Behaviour] = []
        """The attempts that came to their end in this tick."""
        self._running: set[Behaviour] = set()
        self._changed: set[Behaviour] = set()

    def tick(self, t: float) -> None:
        """Tick the tree once.

        Args:
            t: The world's time, written into the events.
        """
        self._t = t
        self._changed.clear()
        self._ticked.tick()
        if halted := self._take_halted():
            self._reconcile(t, halted)
        if self._over:
            self._forget_attempts()

    def stop(self, t: float, text: str, halt: Halt) -> None:
        """Halt the whole tree.

        Args:
            t: The world's time.
            text: Why, for the trace.
            halt: Of which kind.
        """
        self._ticked.stop(Status.INVALID)
        reason = Reason(halt, telling=Account(text))
        for node in self._take_halted():
            self._log.halt(t, node, reason)

    def reground(self) -> None:
        """The nodes stand on other grounds from now on; what happened before must have been read."""
        self._log.stand_on({node: one.grounds for node, one in self._explaining.items()})

    @property
    def events(self) -> tuple[TraceEvent, ...]:
        """What happened so far."""
        return self._log.events

    def _note(self, node: Behaviour) -> None:
        """A node that was ticked came out otherwise than last time."""
        status = node.status
        if status is Status.INVALID:
            return
        telling = None
        if status is Status.RUNNING:
            self._running.add(node)
        else:
            self._running.discard(node)
            if node in self._attempted:
                self._over.append(node)
            if explaining := self._explaining.get(node):
                telling = explaining.account()
        self._seen[node] = status
        self._changed.add(node)
        self._log.result(self._t, node, status, telling)

    def _reconcile(self, t: float, halted: list[Behaviour]) -> None:
        """Find out why nodes were halted in this tick."""
        by_parent: dict[Behaviour | None, Reason] = {}
        reasons: dict[Behaviour | None, Reason] = {}
        # A halted parent halts its children for its own reason; it comes before them.
        for node in halted:
            parent = node.parent
            reason = reasons.get(parent) or by_parent.get(parent)
            if reason is None:
                reason = by_parent[parent] = self._reason(parent)
            reasons[node] = reason
            self._log.halt(t, node, reason)

    def _forget_attempts(self) -> None:
        """What is tried again starts from nothing."""
        for attempted in self._over:
            for node in self._attempted[attempted]:
                self._seen[node] = Status.INVALID
        self._over.clear()

    def _take_halted(self) -> list[Behaviour]:
        """Those that ran and do no more, in pre-order; from now on seen as INVALID."""
        halted = [node for node in self._running if node.status is INVALID]
        if not halted:
            return halted
        halted.sort(key=self._paths.__getitem__)
        for node in halted:
            self._running.remove(node)
            self._seen[node] = Status.INVALID
        self._over += (node for node in halted if node in self._attempted)
        return halted

    def _reason(self, parent: Behaviour | None) -> Reason:
        """Why the running children of a node were halted that was not halted itself."""
        if parent is None:
            return Reason("emergency")
        decided = parent if isinstance(parent, Decorator) else self._decisive_child(parent)
        if decided is None:
            return Reason(self._halt(parent))
        cause = self._cause_in(decided)
        condition = f"{cause.name} -> {WORDS[self._seen[cause]]}"
        if explaining := self._explaining.get(cause):
            return Reason(self._halt(parent), condition, explaining.account(), explaining.grounds)
        return Reason(self._halt(parent), condition)

    def _halt(self, parent: Behaviour) -> Halt:
        if isinstance(parent, SimulatedTimeout) and parent.timed_out:
            return "timed_out"
        if isinstance(parent, EmergencyGuard):
            return "emergency"
        if isinstance(parent, Selector):
            return "achieved_early" if self._seen[parent] is Status.SUCCESS else "preempted"
        return "preempted" if isinstance(parent, Sequence) else "parent_ended"

    def _decisive_child(self, parent: Behaviour) -> Behaviour | None:
        """The child that gave the parent its result; told from what was seen, as a reset forgets it."""
        others = [child for child in parent.children if self._seen[child] is not Status.INVALID]
        if isinstance(parent, Parallel):
            return next((child for child in others if self._seen[child] is self._seen[parent]), None)
        passed = Status.FAILURE if isinstance(parent, Selector) else Status.SUCCESS
        return next((child for child in others if self._seen[child] is not passed), None)

    def _cause_in(self, branch: Behaviour) -> Behaviour:
        """The first leaf, in the order of the visit, whose change gave the branch its result."""
        if isinstance(branch, SimulatedTimeout) and branch.timed_out:
            return branch
        result = self._seen[branch]
        settled = _is_settled_by_one_child(branch, result)
        for child in branch.children:
            status = self._seen[child]
            if child in self._changed and (status is result if settled else status is not Status.INVALID):
                return self._cause_in(child)
        return branch


def _is_settled_by_one_child(node: Behaviour, result: Status) -> bool:
    """Whether children with another result had no say in it."""
    if isinstance(node, Sequence):
        return result is Status.FAILURE
    if isinstance(node, Selector):
        return result is Status.SUCCESS
    return isinstance(node, Parallel) and result is not Status.RUNNING


def _explaining(nodes: Iterable[Behaviour]) -> Iterator[tuple[Behaviour, Explains]]:
    """The nodes that can account for their results, each as one that can."""
    for node in nodes:
        one: object = node
        if explains(one):
            yield node, one
