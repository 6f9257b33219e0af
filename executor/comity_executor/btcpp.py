"""A behaviour tree as BehaviorTree.CPP v4 XML, which Groot2 shows and a C++ robot can execute.

Every class of leaf becomes a node model, and what its plan step says becomes its ports. Control nodes have
counterparts there: a sequence or fallback without memory is the reactive one (which allows one running
child, as ours have), a parallel counts successes and failures, `Retry` and `Timeout` are decorators.

Format: https://www.behaviortree.dev/docs/learn-the-basics/xml_format, version 4.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from xml.etree import ElementTree

from py_trees.behaviour import Behaviour
from py_trees.common import ParallelPolicy
from py_trees.composites import Parallel, Selector, Sequence
from py_trees.decorators import SuccessIsRunning

from comity_executor.leaf import Action, Condition
from comity_executor.node import preorder
from comity_executor.retry import Retry
from comity_executor.simulated_timeout import SimulatedTimeout

TREE = "Visits"
"""The identifier of the one tree in the file."""
Element = ElementTree.Element


def btcpp_xml(root: Behaviour) -> str:
    """The tree, with a model of every leaf.

    Args:
        root: A tree of this package's nodes and py_trees' composites.

    Raises:
        ValueError: for a node that has no counterpart.
    """
    document = Element("root", BTCPP_format="4", main_tree_to_execute=TREE)
    tree = ElementTree.SubElement(document, "BehaviorTree", ID=TREE)
    tree.append(_element(root))
    document.append(_models(root))
    ElementTree.indent(document)
    return ElementTree.tostring(document, encoding="unicode", xml_declaration=True) + "\n"


def _element(node: Behaviour) -> Element:
    tag, attributes = _tag(node)
    element = Element(tag, {"name": node.name} | dict(attributes) | {"name": node.name})
    element.extend([_element(child) for child in node.children])
    return element


def _tag(node: Behaviour) -> tuple[str, Mapping[str, str]]:
    """The element of a node, and its ports."""
    match node:
        case Sequence() | Selector():
            kind = "Sequence" if isinstance(node, Sequence) else "Fallback"
            return (kind if node.memory else f"Reactive{kind}"), {}
        case Parallel():
            return "Parallel", {"success_count": _successes(node), "failure_count": "1"}
        case Retry():
            return "RetryUntilSuccessful", {"num_attempts": str(node.attempts)}
        case SimulatedTimeout():
            return "Timeout", {"msec": str(round(1000 * node.duration_s))}
        case SuccessIsRunning():
            return "KeepRunningUntilFailure", {}
        case Condition() | Action():
            return type(node).__name__, dict(_ports(node))
    raise ValueError(f"{node.name} ({type(node).__name__}) has no counterpart in BehaviorTree.CPP")


def _successes(node: Parallel) -> str:
    """How many children must succeed; -1: all of them."""
    return "1" if isinstance(node.policy, ParallelPolicy.SuccessOnOne) else "-1"


def _ports(leaf: Condition | Action) -> Iterator[tuple[str, str]]:
    """What a leaf is told: its own words, and the step of the plan that it stands on.

    Raises:
        ValueError: for a word in braces, which there means an entry of the blackboard.
    """
    step = leaf.grounds.step if leaf.grounds else None
    told = {"person": step.person, **step.parameters} if step else {}
    for name, value in {**leaf.ports, **told}.items():
        word = value if isinstance(value, str) else f"{value:.6g}"
        if word.startswith("{") and word.endswith("}"):
            raise ValueError(f"{leaf.name}: {name} {word!r} would be read as an entry of the blackboard")
        yield name, word


def _models(root: Behaviour) -> Element:
    """What an editor has to know of every class of leaf: its kind and its ports."""
    models = Element("TreeNodesModel")
    for name, leaves in sorted(_by_class(root).items()):
        kind = "Condition" if isinstance(leaves[0], Condition) else "Action"
        model = ElementTree.SubElement(models, kind, ID=name)
        for port in dict.fromkeys(port for leaf in leaves for port, _ in _ports(leaf)):
            ElementTree.SubElement(model, "input_port", name=port)
    return models


def _by_class(root: Behaviour) -> dict[str, list[Condition | Action]]:
    found: dict[str, list[Condition | Action]] = {}
    for node in preorder(root):
        if isinstance(node, Condition | Action):
            found.setdefault(type(node).__name__, []).append(node)
    return found
