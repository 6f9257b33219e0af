"""Composites of py_trees with the identity of their node."""

from __future__ import annotations

from collections.abc import Sequence as Seq

from py_trees.behaviour import Behaviour
from py_trees.common import ParallelPolicy
from py_trees.composites import Parallel, Selector, Sequence
from py_trees.decorators import SuccessIsRunning

from comity_executor.nodes.identity import NodeId


def sequence(node_id: NodeId, children: Seq[Behaviour], *, memory: bool = False) -> Behaviour:
    """A sequence; with memory, children that succeeded are not ticked again."""
    return _identified(Sequence(node_id.name, memory=memory, children=[*children]), node_id)


def fallback(node_id: NodeId, children: Seq[Behaviour]) -> Behaviour:
    """A fallback that asks its children from the first in every tick."""
    return _identified(Selector(node_id.name, memory=False, children=[*children]), node_id)


def parallel_until_one(node_id: NodeId, children: Seq[Behaviour]) -> Behaviour:
    """A parallel that ends with the first child that succeeds; the others never do by themselves."""
    return _identified(Parallel(node_id.name, ParallelPolicy.SuccessOnOne(), [*children]), node_id)


def parallel_until_all(node_id: NodeId, children: Seq[Behaviour]) -> Behaviour:
    """A parallel that ends when all its children have succeeded."""
    policy = ParallelPolicy.SuccessOnAll(synchronise=False)
    return _identified(Parallel(node_id.name, policy, [*children]), node_id)


def never_succeeding(node_id: NodeId, child: Behaviour) -> Behaviour:
    """A decorator that is RUNNING instead of SUCCESS."""
    return _identified(SuccessIsRunning(node_id.name, child), node_id)


def _identified(node: Behaviour, node_id: NodeId) -> Behaviour:
    vars(node)["node_id"] = node_id
    return node
