"""Executes a plan as a behaviour tree, and records what it did and why."""

from comity_executor.execution import Execution, ExecutionStatus
from comity_executor.live.heartbeat import Heartbeat
from comity_executor.live.loop import Loop, LoopReport, Overrun
from comity_executor.live.watchdog import Watchdog, WatchdogError
from comity_executor.memory.board import Shared
from comity_executor.memory.visit import PROPER_OUTCOMES, Deed, Visit
from comity_executor.memory.visit_context import NO_ACTS, MakeAct
from comity_executor.memory.write import Write
from comity_executor.nodes.cause import Cause
from comity_executor.nodes.fault import Diagnosed, FaultError
from comity_executor.nodes.identity import NodeId
from comity_executor.nodes.limits import DEFAULT_LIMITS, Limits
from comity_executor.nodes.node import Node, tree_text
from comity_executor.plan_update import ExecutionState, NoPlanUpdate, Planner, PlanUpdate
from comity_executor.robots.capabilities import Capabilities, CapabilityValues, MarginStatement
from comity_executor.robots.carrier import Carrier
from comity_executor.robots.check import RobotCheck, RobotError, check_robot
from comity_executor.robots.goals import (
    LOST,
    STATES,
    ActGoal,
    ActStatus,
    GoalId,
    GoalStatus,
    Motion,
    MotionGoal,
    MotionStatus,
    RelativePose,
)
from comity_executor.robots.map_robot import Localisation, MapGoal, MapRobot, PersonTrack, ReducedPassage
from comity_executor.robots.noticed import Noticed
from comity_executor.robots.robot import Reading, Robot, Words
from comity_executor.robots.scripted import ScriptedRobot
from comity_executor.robots.senses import ReadingSeries, ReadingsFile
from comity_executor.speech.address import Address
from comity_executor.speech.manner import Manner, manner_of
from comity_executor.speech.other_parameters import other_parameters
from comity_executor.speech.phrasebook import Language, Phrasebook, read_wordings
from comity_executor.speech.speaker import Speaker
from comity_executor.speech.utterance import Utterance
from comity_executor.speech.wording import Wording
from comity_executor.subtree import VisitSubtree
from comity_executor.tracing.blackboard_file import BlackboardFile, read_blackboard
from comity_executor.tracing.coverage import LeafCoverage, leaf_coverage
from comity_executor.tracing.divergence import Divergence, first_divergence
from comity_executor.tracing.file import TraceFile
from comity_executor.tracing.history import History, NodeExplanation
from comity_executor.tracing.intervention import Intervention
from comity_executor.tracing.reader import read_nodes, read_trace
from comity_executor.tracing.switch import Switch, switches
from comity_executor.tracing.trace import TraceEvent, trace_lines, trace_sha256
from comity_executor.trees.btcpp import btcpp_xml
from comity_executor.trees.leaf_faults import is_called, leaves_of
from comity_executor.trees.node_names import node_names
from comity_executor.trees.tree import Tree, build_tree

__all__ = [
    "DEFAULT_LIMITS",
    "LOST",
    "NO_ACTS",
    "PROPER_OUTCOMES",
    "STATES",
    "ActGoal",
    "ActStatus",
    "Address",
    "BlackboardFile",
    "Capabilities",
    "CapabilityValues",
    "Carrier",
    "Cause",
    "Deed",
    "Diagnosed",
    "Divergence",
    "Execution",
    "ExecutionState",
    "ExecutionStatus",
    "FaultError",
    "GoalId",
    "GoalStatus",
    "Heartbeat",
    "History",
    "Intervention",
    "Language",
    "LeafCoverage",
    "Limits",
    "Localisation",
    "Loop",
    "LoopReport",
    "MakeAct",
    "Manner",
    "MapGoal",
    "MapRobot",
    "MarginStatement",
    "Motion",
    "MotionGoal",
    "MotionStatus",
    "NoPlanUpdate",
    "Node",
    "NodeExplanation",
    "NodeId",
    "Noticed",
    "Overrun",
    "PersonTrack",
    "Phrasebook",
    "PlanUpdate",
    "Planner",
    "Reading",
    "ReadingSeries",
    "ReadingsFile",
    "ReducedPassage",
    "RelativePose",
    "Robot",
    "RobotCheck",
    "RobotError",
    "ScriptedRobot",
    "Shared",
    "Speaker",
    "Switch",
    "TraceEvent",
    "TraceFile",
    "Tree",
    "Utterance",
    "Visit",
    "VisitSubtree",
    "Watchdog",
    "WatchdogError",
    "Wording",
    "Words",
    "Write",
    "btcpp_xml",
    "build_tree",
    "check_robot",
    "first_divergence",
    "is_called",
    "leaf_coverage",
    "leaves_of",
    "manner_of",
    "node_names",
    "other_parameters",
    "read_blackboard",
    "read_nodes",
    "read_trace",
    "read_wordings",
    "switches",
    "trace_lines",
    "trace_sha256",
    "tree_text",
]
