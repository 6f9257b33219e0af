"""Leaves that are to raise an exception, so that one sees what the tree makes of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product

from py_trees.trees import BehaviourTree

from comity_domain.plans.plan import Plan
from comity_executor.nodes.fault import FaultError
from comity_executor.nodes.identity import NodeId
from comity_executor.nodes.leaf import Action, Condition
from comity_executor.nodes.limits import Limits
from comity_executor.nodes.node import Node, preorder
from comity_executor.robots.scripted import ScriptedRobot
from comity_executor.trees.tree import build_tree
from comity_fis.inference.value import Inference


@dataclass(slots=True)
class _Due:
    leaf: str
    error: FaultError
    times: int


class LeafFaults:
    """Which leaves raise what, and how often still; a leaf raises when it is ticked next."""

    def __init__(self) -> None:
        self._due: list[_Due] = []
        self._armed: list[tuple[_Due, Condition | Action]] = []
        """In this tick."""

    def add(self, leaf: str, error: FaultError, times: int) -> None:
        """Have a leaf raise.

        Args:
            leaf: Its name, `say(johanna)`, or its action, `say`, for all people.
            error: What.
            times: In so many of its ticks.
        """
        self._due.append(_Due(leaf, error, times))

    def arm(self, tree: BehaviourTree) -> None:
        """Have them raise in the tick that follows; a handler before the tick."""
        if not self._due:
            return
        leaves = [node for node in preorder(tree.root) if isinstance(node, Condition | Action)]
        pairs = product(self._due, leaves)
        self._armed = [(due, leaf) for due, leaf in pairs if is_called(leaf.node_id, due.leaf)]
        for due, leaf in self._armed:
            leaf.fault = due.error

    def disarm(self, tree: BehaviourTree) -> None:
        """Count those that have raised; a handler after the tick."""
        for due, leaf in self._armed:
            due.times -= leaf.fault is None
            leaf.fault = None
        self._armed = []
        self._due = [due for due in self._due if due.times > 0]


def leaves_of(plan: Plan, values: Mapping[str, Inference], limits: Limits) -> tuple[NodeId, ...]:
    """The identities of all leaves of a plan's tree.

    Args:
        plan: What is carried out.
        values: Everyone's parameters, by name.
        limits: How patient and how exact.
    """
    tree = build_tree(plan, ScriptedRobot({}), values, limits)
    tree.memory.close()
    found = (node.node_id for node in preorder(tree.root) if isinstance(node, Condition | Action))
    return tuple(dict.fromkeys(found))


def is_called(node: NodeId | Node, leaf: str) -> bool:
    """Whether a word names a node: by its whole name, or by its action for all people."""
    return leaf in (node.name, node.action)
