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

from comity_executor.nodes.identity import id_of
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
    """For display: the action, and in brackets what it is about."""
    kind: Kind
    parent: int | None
    """The parent's path; None for the root."""
    action: str
    """What it does or asks, without the person: `Dock_to_user`, `docked?`, `Timeout 40 s`."""
    about: tuple[str, ...]
    """What the name has in brackets: an act, a thing, a place, the person."""
    person: str | None
    """The person in whose visit it is; None for nodes of the whole run."""


def preorder(root: Behaviour) -> Iterator[Behaviour]:
    """Every node, parents before children and children in their order."""
    yield root
    for child in root.children:
        yield from preorder(child)


def describe(root: Behaviour, first_path: int = 0) -> tuple[Node, ...]:
    """The static description of a tree, whose root has a path of its own among other trees."""
    behaviours = list(preorder(root))
    paths = {behaviour: path for path, behaviour in enumerate(behaviours, start=first_path)}
    return tuple(_described(node, paths) for node in behaviours)


def _described(node: Behaviour, paths: Mapping[Behaviour, int]) -> Node:
    one = id_of(node)
    parent = paths.get(node.parent) if node.parent else None
    return Node(paths[node], node.name, kind_of(node), parent, one.action, one.about, one.person)


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
