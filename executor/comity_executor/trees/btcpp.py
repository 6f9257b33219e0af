"""A behaviour tree as BehaviorTree.CPP v4 XML, which Groot2 shows and a C++ robot can execute.

Every class of leaf becomes a node model, and what its plan step says becomes its ports; a leaf has all ports
of its model. Control nodes have counterparts there: a sequence or fallback without memory is the reactive one
(which allows one running child, as ours have), a parallel counts successes and failures, `Retry` and
`Timeout` are decorators. An act that is tried again after a pause while time is left takes several:

    Timeout > RetryUntilSuccessful > Fallback    Act
                                                 ForceFailure > Sleep

Format: https://www.behaviortree.dev/docs/learn-the-basics/xml_format, version 4.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Literal
from xml.etree import ElementTree

from py_trees.behaviour import Behaviour
from py_trees.common import ParallelPolicy
from py_trees.composites import Parallel, Selector, Sequence
from py_trees.decorators import SuccessIsRunning

from comity_executor.leaves.custom_act import CustomAct
from comity_executor.nodes.act_timeout import ActTimeout
from comity_executor.nodes.leaf import Action, Condition
from comity_executor.nodes.retry import Retry
from comity_executor.nodes.simulated_timeout import SimulatedTimeout

TREE = "Visits"
"""The identifier of the one tree in the file."""
Element = ElementTree.Element
Leaf = Condition | Action | CustomAct
"""What another engine has a node of its own for; what is in a custom act is the user's business."""


def btcpp_xml(root: Behaviour) -> str:
    """The tree, with a model of every leaf.

    Args:
        root: A tree of this package's nodes and py_trees' composites.

    Raises:
        ValueError: for a node that has no counterpart.
    """
    document = Element("root", BTCPP_format="4", main_tree_to_execute=TREE)
    tree = ElementTree.SubElement(document, "BehaviorTree", ID=TREE)
    models = _models_of(root)
    tree.append(_element(root, models))
    document.append(_document(models))
    ElementTree.indent(document)
    return ElementTree.tostring(document, encoding="unicode", xml_declaration=True) + "\n"


def _element(node: Behaviour, models: Models) -> Element:
    if isinstance(node, Leaf):
        tag = type(node).__name__
        return Element(
            tag, {"name": node.name} | {port: _ports(node).get(port, "") for port in models[tag].ports}
        )
    tag, attributes = _tag(node)
    element = Element(tag, {"name": node.name} | attributes)
    children = [_element(child, models) for child in node.children]
    element.extend(_tried_again(node, *children) if isinstance(node, ActTimeout) else children)
    return element


def _tag(node: Behaviour) -> tuple[str, dict[str, str]]:
    """The element of a node that is no leaf, and its ports."""
    match node:
        case Sequence() | Selector():
            kind = "Sequence" if isinstance(node, Sequence) else "Fallback"
            return (kind if node.memory else f"Reactive{kind}"), {}
        case Parallel():
            return "Parallel", {"success_count": _successes(node), "failure_count": "1"}
        case Retry():
            return "RetryUntilSuccessful", {"num_attempts": str(node.num_failures)}
        case SimulatedTimeout():
            return "Timeout", {"msec": _msec(node.duration_s)}
        case SuccessIsRunning():
            return "KeepRunningUntilFailure", {}
    raise ValueError(f"{node.name} ({type(node).__name__}) has no counterpart in BehaviorTree.CPP")


def _successes(node: Parallel) -> str:
    """How many children must succeed; -1: all of them."""
    return "1" if isinstance(node.policy, ParallelPolicy.SuccessOnOne) else "-1"


def _msec(duration_s: float) -> str:
    return str(round(1000 * duration_s))


def _tried_again(node: ActTimeout, act: Element) -> Iterator[Element]:
    """The act, and after a failure a pause and the act again: so often as the time allows at the most."""
    about = act.get("name", "")
    attempts = str(node.attempts)
    retry = Element("RetryUntilSuccessful", name=f"Retry {attempts}({about})", num_attempts=attempts)
    once = ElementTree.SubElement(retry, "Fallback", name=f"Attempt({about})")
    once.append(act)
    failed = ElementTree.SubElement(once, "ForceFailure", name=f"Failed({about})")
    ElementTree.SubElement(
        failed, "Sleep", name=f"Pause {node.pause_s:g} s({about})", msec=_msec(node.pause_s)
    )
    yield retry


def _ports(leaf: Leaf) -> dict[str, str]:
    """What a leaf is told, in words.

    Raises:
        ValueError: for a word in braces, which there means an entry of the blackboard.
    """
    words = {}
    for name, value in leaf.ports.items():
        word = value if isinstance(value, str) else f"{value:.6g}"
        if word.startswith("{") and word.endswith("}"):
            raise ValueError(f"{leaf.name}: {name} {word!r} would be read as an entry of the blackboard")
        words[name] = word
    return words


@dataclass(frozen=True, slots=True)
class Model:
    """A class of leaves."""

    kind: Literal["Action", "Condition"]
    ports: Mapping[str, Literal["double", "std::string"]]
    """With their types: a number wherever every leaf has one."""


Models = Mapping[str, Model]
"""By the name of the class."""


def _models_of(root: Behaviour) -> Models:
    found: dict[str, list[Leaf]] = {}
    for node in _down_to_leaves(root):
        if isinstance(node, Leaf):
            found.setdefault(type(node).__name__, []).append(node)
    return {name: _model(leaves) for name, leaves in sorted(found.items())}


def _down_to_leaves(node: Behaviour) -> Iterator[Behaviour]:
    """Every node that has an element of its own."""
    yield node
    if not isinstance(node, Leaf):
        for child in node.children:
            yield from _down_to_leaves(child)


def _model(leaves: list[Leaf]) -> Model:
    told = [leaf.ports for leaf in leaves]
    names = dict.fromkeys(name for ports in told for name in ports)
    words = {name for name in names if any(isinstance(ports.get(name, ""), str) for ports in told)}
    return Model(
        "Condition" if isinstance(leaves[0], Condition) else "Action",
        {name: "std::string" if name in words else "double" for name in names},
    )


def _document(models: Models) -> Element:
    """What an editor has to know of every class of leaf: its kind and its ports."""
    document = Element("TreeNodesModel")
    for name, model in models.items():
        element = ElementTree.SubElement(document, model.kind, ID=name)
        for port, kind in model.ports.items():
            ElementTree.SubElement(element, "input_port", name=port, type=kind)
    return document
