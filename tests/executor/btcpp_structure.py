"""What BehaviorTree.CPP 4 demands of a file, written from its documentation and not from our exporter.

Sources: https://www.behaviortree.dev/docs/learn-the-basics/xml_format and /docs/nodes-library, and the
checks that its own parser makes (`VerifyXML` in src/xml_parsing.cpp, version 4): one child per tree and
decorator, none for leaves, at least one for control nodes, names of ports, every tag built in or declared.
"""

from __future__ import annotations

import re
from xml.etree import ElementTree

DECORATORS: dict[str, dict[str, str]] = {
    "ForceFailure": {},
    "KeepRunningUntilFailure": {},
    "RetryUntilSuccessful": {"num_attempts": r"-1|[1-9]\d*"},
    "Timeout": {"msec": r"[1-9]\d*"},
}
CONTROLS: dict[str, dict[str, str]] = {
    "Sequence": {},
    "ReactiveSequence": {},
    "Fallback": {},
    "ReactiveFallback": {},
    "Parallel": {"success_count": r"-?\d+", "failure_count": r"-?\d+"},
}
LEAVES: dict[str, dict[str, str]] = {"Sleep": {"msec": r"[1-9]\d*"}}
KINDS = {"Action", "Condition", "Control", "Decorator", "SubTree"}
PORT_TYPES = {"double", "std::string"}
PORTS = {"input_port", "output_port", "inout_port"}
RESERVED = {"name", "ID", "_description", "_fullpath", "_uid"}
"""Names that a port must not have (`IsReservedAttribute`); nor may it begin otherwise than with a letter."""


def faults(text: str) -> list[str]:
    """Everything in a file that BehaviorTree.CPP or Groot2 would stumble over."""
    root = ElementTree.fromstring(text)
    found = []
    if root.tag != "root" or root.get("BTCPP_format") != "4":
        found.append("no <root BTCPP_format='4'>")
    trees = root.findall("BehaviorTree")
    names = [tree.get("ID") for tree in trees]
    if root.get("main_tree_to_execute") not in names or len(set(names)) < len(names):
        found.append("main_tree_to_execute names no tree, or an ID comes twice")
    if len(root.findall("TreeNodesModel")) != 1 or {child.tag for child in root} - {
        "BehaviorTree",
        "TreeNodesModel",
    }:
        found.append("other children of <root> than trees and one model")
    models = {model.get("ID", ""): model for model in root.iterfind("TreeNodesModel/*")}
    for name, model in models.items():
        found += _model_faults(name, model)
    for tree in trees:
        if len(tree) != 1:
            found.append(f"a tree with {len(tree)} children")
        for element in tree.iterfind(".//*"):
            found += _node_faults(element, models)
    return found


def _model_faults(name: str, model: ElementTree.Element) -> list[str]:
    found = []
    if model.tag not in KINDS or not re.fullmatch(r"[A-Za-z_]\w*", name):
        found.append(f"model {model.tag} {name!r}")
    ports = [port.get("name", "") for port in model]
    found += [f"type {port.get('type')!r} of {name}" for port in model if port.get("type") not in PORT_TYPES]
    if {port.tag for port in model} - PORTS or len(set(ports)) < len(ports):
        found.append(f"ports of {name}: a tag that is none, or a name twice")
    found += [
        f"port {port!r} of {name}"
        for port in ports
        if port in RESERVED or not re.fullmatch(r"[A-Za-z]\w*", port)
    ]
    return found


def _node_faults(element: ElementTree.Element, models: dict[str, ElementTree.Element]) -> list[str]:
    tag, children = element.tag, len(element)
    told = {key: value for key, value in element.attrib.items() if key not in RESERVED}
    if tag in DECORATORS or tag in CONTROLS or tag in LEAVES:
        ports = (DECORATORS | CONTROLS | LEAVES)[tag]
        fits = children == 1 if tag in DECORATORS else bool(children) == (tag in CONTROLS)
        found = [] if fits else [f"{tag} with {children} children"]
        wrong = {
            key for key in told.keys() | ports if not re.fullmatch(ports.get(key, "(?!)"), told.get(key, ""))
        }
        return found + [f"{tag}: {key}={told.get(key)!r}" for key in sorted(wrong)]
    if tag not in models:
        return [f"{tag} is neither built in nor declared"]
    declared = {port.get("name") for port in models[tag]}
    found = [f"{tag} has children"] if children and models[tag].tag in ("Action", "Condition") else []
    found += [f"{tag}: port {key!r} is not set" for key in declared if key not in told]
    return found + [f"{tag}: no port {key!r}" for key in told if key not in declared]
