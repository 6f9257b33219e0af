"""Why a node was halted: the kind of halt, and the leaf that caused it.

The cause of a halt is the first leaf, in visiting order, whose result changed in this tick, within the
deciding branch: the sibling of the halted node that ran, failed or succeeded instead. Siblings that changed
without deciding are not causes.
"""

from __future__ import annotations

from collections.abc import Container, Mapping
from dataclasses import dataclass

from py_trees.behaviour import Behaviour
from py_trees.common import Status
from py_trees.composites import Parallel, Selector, Sequence
from py_trees.decorators import Decorator

from comity_executor.leaves.emergency import EmergencyGuard
from comity_executor.nodes.cause import Cause, causes_of
from comity_executor.nodes.simulated_timeout import SimulatedTimeout
from comity_executor.tracing.trace import EventStatus, Halt

WORDS: Mapping[Status, EventStatus] = {
    Status.RUNNING: "running",
    Status.SUCCESS: "success",
    Status.FAILURE: "failure",
    Status.INVALID: "halted",
}
"""A node that is INVALID after it ran was halted."""


@dataclass(frozen=True, slots=True)
class Reason:
    """The reason for a node's state."""

    halt: Halt | None
    """Kind of halt; None if it is the node's own result."""
    because: tuple[Cause, ...] = ()
    """The chain of causes, nearest first."""


def halted_by(
    parent: Behaviour | None, seen: Mapping[Behaviour, Status], changed: Container[Behaviour]
) -> Reason:
    """Why the running children of a node were halted, when the node itself was not.

    Args:
        parent: That node; None above the root.
        seen: The last result of every node of the tree. A reset clears results, so the nodes cannot be asked.
        changed: Nodes whose result changed in this tick.
    """
    if parent is None:
        return Reason("emergency")
    halt = _kind(parent, seen)
    decided = parent if isinstance(parent, Decorator) else _decisive_child(parent, seen)
    if decided is None:
        return Reason(halt)
    cause = _cause_in(decided, seen, changed)
    condition = f"{cause.name} -> {WORDS[seen[cause]]}"
    return Reason(halt, causes_of(cause, condition))


def _kind(parent: Behaviour, seen: Mapping[Behaviour, Status]) -> Halt:
    if isinstance(parent, SimulatedTimeout) and parent.timed_out:
        return "timed_out"
    if isinstance(parent, EmergencyGuard):
        return "emergency"
    if isinstance(parent, Selector):
        return "achieved_early" if seen[parent] is Status.SUCCESS else "preempted"
    return "preempted" if isinstance(parent, Sequence) else "parent_ended"


def _decisive_child(parent: Behaviour, seen: Mapping[Behaviour, Status]) -> Behaviour | None:
    """The child that gave the parent its result."""
    others = [child for child in parent.children if seen[child] is not Status.INVALID]
    if isinstance(parent, Parallel):
        return next((child for child in others if seen[child] is seen[parent]), None)
    passed = Status.FAILURE if isinstance(parent, Selector) else Status.SUCCESS
    return next((child for child in others if seen[child] is not passed), None)


def _cause_in(
    branch: Behaviour, seen: Mapping[Behaviour, Status], changed: Container[Behaviour]
) -> Behaviour:
    """The first leaf, in the order of the visit, whose change gave the branch its result."""
    # A tick visits nodes depth first, so that the first changed leaf of the deciding branch is what moved
    # it: whatever changed after it saw a world in which the result was settled. Going down, only children
    # that could settle their parent count: a failure for a sequence, a success for a selector
    # (Colledanchise and Ogren 2018, "Behavior Trees in Robotics and AI", chapter 1); a changed sibling with
    # another result had no say. Where no child changed, the branch itself is the cause: a timeout, or a
    # leaf.
    if isinstance(branch, SimulatedTimeout) and branch.timed_out:
        return branch
    result = seen[branch]
    settled = _is_settled_by_one_child(branch, result)
    for child in branch.children:
        status = seen[child]
        if child in changed and (status is result if settled else status is not Status.INVALID):
            return _cause_in(child, seen, changed)
    return branch


def _is_settled_by_one_child(node: Behaviour, result: Status) -> bool:
    """Whether children with another result had no say in it."""
    if isinstance(node, Sequence):
        return result is Status.FAILURE
    if isinstance(node, Selector):
        return result is Status.SUCCESS
    return isinstance(node, Parallel) and result is not Status.RUNNING
