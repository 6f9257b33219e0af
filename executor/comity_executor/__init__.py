"""A plan as a behaviour tree, ticked in the world's time, and the record of what it did and why."""

from comity_executor.cause import Cause
from comity_executor.execution import Execution
from comity_executor.limits import DEFAULT_LIMITS, Limits
from comity_executor.node import Node, tree_text
from comity_executor.noticed import Noticed
from comity_executor.robot import DockingPose, Motion, Reading, Robot
from comity_executor.senses import ReadingSeries
from comity_executor.trace import TraceEvent, read_nodes, read_trace, trace_lines, trace_sha256, write_trace
from comity_executor.tree import Tree, build_tree
from comity_executor.visit import Visit

__all__ = [
    "DEFAULT_LIMITS",
    "Cause",
    "DockingPose",
    "Execution",
    "Limits",
    "Motion",
    "Node",
    "Noticed",
    "Reading",
    "ReadingSeries",
    "Robot",
    "TraceEvent",
    "Tree",
    "Visit",
    "build_tree",
    "read_nodes",
    "read_trace",
    "trace_lines",
    "trace_sha256",
    "tree_text",
    "write_trace",
]
