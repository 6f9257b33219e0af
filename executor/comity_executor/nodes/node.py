"""What a tree looks like, independent of py_trees: its nodes in pre-order, and a drawing of them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Literal

from py_trees.behaviour import Behaviour
from py_trees.behaviours import (
    CheckBlackboardVariableExists,
    CheckBlackboardVariableValue,
    CheckBlackboardVariableValues,
)
from py_trees.composites import Parallel, Selector, Sequence
from py_trees.decorators import Decorator

from comity_executor.nodes.leaf import Condition

Kind = Literal["sequence", "memory_sequence", "fallback", "parallel", "decorator", "condition", "action"]

_SYMBOLS: Mapping[Kind, str] = {
    "sequence": "→",
    "memory_sequence": "→*",
    "fallback": "?",
    "parallel": "⇉",
    "decorator": "◇",
    "condition": "○",
    "action": "□",
}


LOOKS = (
    Condition,
    CheckBlackboardVariableExists,
    CheckBlackboardVariableValue,
    CheckBlackboardVariableValues,
)
"""Leaves that ask again in every tick, and do nothing."""


@dataclass(frozen=True, slots=True)
class Node:
    """One node of a tree."""

    path: int
    """Its place in pre-order, from 0: the root."""
    name: str
    kind: Kind
    parent: int | None
    """The parent's path; None for the root."""


def preorder(root: Behaviour) -> Iterator[Behaviour]:
    """Every node, parents before children and children in their order."""
    yield root
    for child in root.children:
        yield from preorder(child)


def describe(root: Behaviour, first_path: int = 0) -> tuple[Node, ...]:
    """The static description of a tree, whose root has a path of its own among other trees."""
    behaviours = list(preorder(root))
    paths = {behaviour: path for path, behaviour in enumerate(behaviours, start=first_path)}
    return tuple(
        Node(path, node.name, kind_of(node), paths.get(node.parent) if node.parent else None)
        for node, path in paths.items()
    )


def kind_of(node: Behaviour) -> Kind:
    """What a node is; a leaf that only looks is a condition, any other leaf acts."""
    if isinstance(node, Sequence):
        return "memory_sequence" if node.memory else "sequence"
    if isinstance(node, Selector):
        return "fallback"
    if isinstance(node, Parallel):
        return "parallel"
    if isinstance(node, Decorator):
        return "decorator"
    return "condition" if isinstance(node, LOOKS) else "action"


def tree_text(nodes: Iterable[Node], statuses: Mapping[int, str] | None = None) -> str:
    """Draw a tree, one node a line.

    Args:
        nodes: In pre-order.
        statuses: What to write behind a node, by its path.
    """
    lines, depths = [], dict[int, int]()
    for node in nodes:
        depth = depths[node.path] = 0 if node.parent is None else depths[node.parent] + 1
        status = (statuses or {}).get(node.path)
        lines.append(f"{'   ' * depth}{_SYMBOLS[node.kind]} {node.name}" + (f"  {status}" if status else ""))
    return "\n".join(lines)
