"""A plan as a behaviour tree, ticked in the world's time, and the record of what it did and why."""

from comity_executor.btcpp import btcpp_xml
from comity_executor.carrier import Carrier
from comity_executor.cause import Cause
from comity_executor.coverage import LeafCoverage, leaf_coverage
from comity_executor.divergence import Divergence, first_divergence
from comity_executor.execution import Execution
from comity_executor.fault import Diagnosed, FaultError
from comity_executor.history import History, Why
from comity_executor.intervention import Intervention
from comity_executor.leaf_faults import is_called, leaves_of
from comity_executor.limits import DEFAULT_LIMITS, Limits
from comity_executor.manner import Manner, manner_of
from comity_executor.node import Node, tree_text
from comity_executor.node_names import node_names
from comity_executor.noticed import Noticed
from comity_executor.revision import Course, NoRevision, Planner, Revision
from comity_executor.robot import DockingPose, Motion, Reading, Robot
from comity_executor.scripted_robot import ScriptedRobot
from comity_executor.senses import ReadingSeries, ReadingsFile
from comity_executor.switch import Switch, switches
from comity_executor.trace import TraceEvent, trace_lines, trace_sha256
from comity_executor.trace_file import TraceFile
from comity_executor.trace_reader import read_nodes, read_trace
from comity_executor.tree import Tree, build_tree
from comity_executor.visit import Deed, Visit
from comity_executor.wording import farewell_text, greeting_text, offer_text

__all__ = [
    "DEFAULT_LIMITS",
    "Carrier",
    "Cause",
    "Course",
    "Deed",
    "Diagnosed",
    "Divergence",
    "DockingPose",
    "Execution",
    "FaultError",
    "History",
    "Intervention",
    "LeafCoverage",
    "Limits",
    "Manner",
    "Motion",
    "NoRevision",
    "Node",
    "Noticed",
    "Planner",
    "Reading",
    "ReadingSeries",
    "ReadingsFile",
    "Revision",
    "Robot",
    "ScriptedRobot",
    "Switch",
    "TraceEvent",
    "TraceFile",
    "Tree",
    "Visit",
    "Why",
    "btcpp_xml",
    "build_tree",
    "farewell_text",
    "first_divergence",
    "greeting_text",
    "is_called",
    "leaf_coverage",
    "leaves_of",
    "manner_of",
    "node_names",
    "offer_text",
    "read_nodes",
    "read_trace",
    "switches",
    "trace_lines",
    "trace_sha256",
    "tree_text",
]
