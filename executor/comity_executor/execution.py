"""The execution of one plan: tick it in the world's time, and read what came of it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Literal

from py_trees.common import Status

from comity_domain.plan import Plan
from comity_executor import node as _node
from comity_executor import trace as _trace
from comity_executor.btcpp import btcpp_xml
from comity_executor.intervention import Intervention, held
from comity_executor.limits import DEFAULT_LIMITS, Limits
from comity_executor.recorder import Recorder
from comity_executor.robot import Robot
from comity_executor.senses import ReadingSeries
from comity_executor.trace import TraceEvent
from comity_executor.tree import SKIP, build_tree
from comity_executor.visit import Visit, skipped_visit
from comity_fis.value import Inference

ExecutionStatus = Literal["running", "success", "failure", "stopped"]


class Execution:
    """A plan under way. The caller owns time: it steps the world and calls `tick` in turn.

    Args:
        plan: Per person a Reach_user and then a Greet_person.
        robot: Who carries it out.
        values: Everyone's parameters, by name.
        limits: How patient and how exact.
        interventions: Results to hold, to see what depends on them; none in earnest.

    Raises:
        ValueError: The plan cannot be executed (see `build_tree`).
    """

    def __init__(
        self,
        plan: Plan,
        robot: Robot,
        values: Mapping[str, Inference],
        limits: Limits = DEFAULT_LIMITS,
        interventions: Iterable[Intervention] = (),
    ) -> None:
        self._robot = robot
        self._skipped = tuple(step.person for step in plan.steps if step.action == SKIP)
        self._tree = build_tree(plan, robot, values, limits)
        self._recorder = Recorder(self._tree.root)
        self._interventions = tuple(interventions)
        self._behaviours = tuple(_node.preorder(self._tree.root))
        self.nodes = _node.describe(self._tree.root)
        self.status: ExecutionStatus = "running"
        """`success`: everyone was greeted. `failure`: the visits say who was not."""

    def tick(self) -> ExecutionStatus:
        """Tick the tree once, at the world's time now; nothing happens after the end."""
        if self.status == "running":
            t = self._tree.senses.begin_tick()
            with held(self._interventions, self._behaviours, self._tree.senses):
                self._recorder.tick(t)
            root = self._tree.root.status
            if root is not Status.RUNNING:
                self.status = "success" if root is Status.SUCCESS else "failure"
        return self.status

    def stop(self, text: str) -> None:
        """Stop everything now: the robot comes to rest and breaks its acts off.

        Args:
            text: Why, for the trace.
        """
        if self.status == "running":
            self._recorder.stop(self._robot.now_s(), text)
            self.status = "stopped"

    @property
    def events(self) -> tuple[TraceEvent, ...]:
        """The trace so far."""
        return self._recorder.events

    @property
    def visits(self) -> tuple[Visit, ...]:
        """What came of every visit so far, in the plan's order."""
        done = (visit for meeting in self._tree.meetings for visit in meeting.visits())
        return (*done, *map(skipped_visit, self._skipped))

    @property
    def readings(self) -> ReadingSeries:
        """Every reading that the tree took."""
        return self._tree.senses.series

    def trace_lines(self) -> tuple[str, ...]:
        """The trace in its canonical encoding."""
        return tuple(_trace.trace_lines(self._recorder.events, self.nodes))

    def trace_sha256(self) -> str:
        """The digest of the trace: equal for equal episodes."""
        return _trace.trace_sha256(self.trace_lines())

    def btcpp_xml(self) -> str:
        """The tree for BehaviorTree.CPP and Groot2.

        Raises:
            ValueError: for a name that cannot be said there.
        """
        return btcpp_xml(self._tree.root)

    def tree_text(self) -> str:
        """Draw the tree with the last status of every node."""
        return _node.tree_text(self.nodes, self._recorder.statuses())
