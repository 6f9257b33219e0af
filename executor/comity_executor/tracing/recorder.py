"""The recorder: a visitor of the behaviour tree that records every node's results and their causes.

`py_trees.trees.BehaviourTree` shows its visitors the nodes that were ticked. A node that its parent stops in
the same tick is never shown, and an action that ends and begins again looks as if nothing had happened. So
the recorder also listens: every node reports from its `initialise` and `terminate`, so that each begin of an
action has one start in the trace, and each halt one end. What a parent resets after its end (py_trees clears
old results when a composite starts again) is no event. The halts of a tick are listed after its other events,
in pre-order; but before the start of what begins again in the same tick.

An attempt of a retry is a new start: once it is over, what was seen below the retry counts no more, and the
next attempt is recorded in full, also where every node comes out as it did in the one before.
"""

from __future__ import annotations

from collections.abc import Callable

from py_trees.behaviour import Behaviour
from py_trees.common import Status
from py_trees.decorators import Retry
from py_trees.visitors import VisitorBase

from comity_executor.nodes.act_timeout import ActTimeout
from comity_executor.nodes.cause import Account, Cause, causes_of, chain
from comity_executor.nodes.node import Node, describe, kind_of, preorder
from comity_executor.tracing.halts import WORDS, Reason, halted_by
from comity_executor.tracing.trace import EventStatus, Halt, TraceEvent


class Recorder(VisitorBase):
    """Records one tree after the other; `BehaviourTree.add_visitor` has it watch them tick.

    Args:
        clock: The world's time [s], as it holds for a whole tick.
    """

    def __init__(self, clock: Callable[[], float]) -> None:
        super().__init__(full=False)
        self.nodes: tuple[Node, ...] = ()
        """The trees so far, one after the other, each in pre-order."""
        self.events: list[TraceEvent] = []
        """The events so far."""
        self._clock = clock
        self._t = 0.0
        self._paths: dict[Behaviour, int] = {}
        self._seen: dict[Behaviour, Status] = {}
        self._changed: set[Behaviour] = set()
        """Nodes whose result changed in this tick."""
        self._begun: set[Behaviour] = set()
        """Actions that have begun and have no result yet."""
        self._halted: list[Behaviour] = []
        """Nodes that were halted since the last tick, in that order."""
        self._attempts: dict[Behaviour, tuple[Behaviour, ...]] = {}
        """What is tried again, with all below it."""
        self._over: list[Behaviour] = []
        """The attempts that came to their end in this tick."""

    def watch(self, root: Behaviour) -> None:
        """Record a tree from now on, instead of the one before; its nodes are numbered on.

        Args:
            root: The tree; its nodes must not be added, removed or moved afterwards.
        """
        described, tree = describe(root, first_path=len(self.nodes)), tuple(preorder(root))
        self.nodes += described
        self._paths = {node: one.path for node, one in zip(tree, described, strict=True)}
        self._seen = dict.fromkeys(tree, Status.INVALID)
        self._attempts = {
            node.decorated: tuple(preorder(node.decorated))
            for node in tree
            if isinstance(node, Retry | ActTimeout)
        }
        for node in tree:
            if kind_of(node) != "condition":  # which begins and ends in every tick
                self._listen_to(node)

    def initialise(self) -> None:
        """A tick begins."""
        self._t = self._clock()
        self._changed.clear()

    def run(self, behaviour: Behaviour) -> None:
        """A node was ticked."""
        if self._seen.get(behaviour) is not behaviour.status or behaviour in self._begun:
            self._see(behaviour, behaviour.status)

    def finalise(self) -> None:
        """The tick is over: find out who was halted in it, and why."""
        reasons: dict[Behaviour | None, Reason] = {}
        # A halted parent halts its children for its own reason; it comes before them.
        for node in self._take_halted():
            if node.parent not in reasons:
                reasons[node.parent] = halted_by(node.parent, self._seen, self._changed)
            reasons[node] = reasons[node.parent]
            self._halt(node, reasons[node])
        self._forget_attempts()

    def note_halts(self, t: float, text: str, halt: Halt) -> None:
        """Write down all that was halted from outside since the last tick.

        Args:
            t: The world's time [s].
            text: Why.
            halt: Of which kind.
        """
        self._t = t
        reason = Reason(halt, chain(None, Account(text), None))
        for node in self._take_halted():
            self._halt(node, reason)
        self._forget_attempts()

    def note(self, node: Behaviour, status: EventStatus, because: tuple[Cause, ...]) -> None:
        """Write down what the execution has to say at a node, such as that the plan is another one now."""
        self.events.append(TraceEvent(self._clock(), self.nodes[self._paths[node]], status, None, because))

    def _listen_to(self, node: Behaviour) -> None:
        """Have a node report when it begins and ends, in whichever way it is ticked or stopped."""
        initialise, terminate = node.initialise, node.terminate
        acts = kind_of(node) == "action"

        def begin() -> None:
            if node in self._halted:  # in this very tick
                self._halted.remove(node)
                self._halt(node, halted_by(node.parent, self._seen, self._changed))
                self._forget_attempts()
            if acts:
                self._begun.add(node)
            initialise()

        def end(new_status: Status) -> None:
            was_running = node.status is Status.RUNNING  # py_trees assigns the new status afterwards
            try:
                terminate(new_status)
            finally:
                if new_status is not Status.INVALID:
                    self._see(node, new_status)
                elif was_running:  # else it is only reset
                    self._see(node, Status.RUNNING)
                    self._halted.append(node)

        vars(node).update(initialise=begin, terminate=end)

    def _see(self, node: Behaviour, status: Status) -> None:
        """Record a result, if it changed or is the first since an action began."""
        changed = self._seen[node] is not status
        if status is Status.INVALID or not (changed or node in self._begun):
            return
        self._begun.discard(node)
        if changed:
            self._seen[node] = status
            self._changed.add(node)
        if status is not Status.RUNNING and node in self._attempts:
            self._over.append(node)
        self._write(node, WORDS[status], Reason(None, () if status is Status.RUNNING else causes_of(node)))

    def _halt(self, node: Behaviour, reason: Reason) -> None:
        self._seen[node] = Status.INVALID
        if node in self._attempts:
            self._over.append(node)
        self._write(node, "halted", reason)

    def _forget_attempts(self) -> None:
        """What is tried again starts from nothing."""
        for attempt in self._over:
            for node in self._attempts[attempt]:
                self._seen[node] = Status.INVALID
        self._over.clear()

    def _take_halted(self) -> list[Behaviour]:
        """Those that ran and do no more, in pre-order; from now on seen as INVALID."""
        halted = sorted(self._halted, key=self._paths.__getitem__)
        self._halted.clear()
        for node in halted:
            self._seen[node] = Status.INVALID
        return halted

    def _write(self, node: Behaviour, status: EventStatus, reason: Reason) -> None:
        at = self.nodes[self._paths[node]]
        self.events.append(TraceEvent(self._t, at, status, reason.halt, reason.because))
