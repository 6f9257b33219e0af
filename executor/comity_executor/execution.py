"""Execution of a plan: ticks its tree in the world's time, and reports the outcome."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from types import MappingProxyType
from typing import Literal

from py_trees.behaviour import Behaviour
from py_trees.common import Status
from py_trees.trees import BehaviourTree

from comity_domain.plans.actions import SKIP
from comity_domain.plans.plan import Plan, PlanStep
from comity_executor.leaves.give_up import why_failed
from comity_executor.memory.asking import Asking
from comity_executor.memory.board import Shared
from comity_executor.memory.memory import Memory
from comity_executor.memory.progress import progress_of
from comity_executor.memory.visit import PROPER_OUTCOMES, Visit, skipped_visit
from comity_executor.memory.visit_context import NO_ACTS, MakeAct, VisitContext
from comity_executor.memory.write import Write
from comity_executor.nodes import node as _node
from comity_executor.nodes.cause import Cause
from comity_executor.nodes.fault import FaultError
from comity_executor.nodes.leaf import Action
from comity_executor.nodes.limits import DEFAULT_LIMITS, Limits
from comity_executor.nodes.node import Node
from comity_executor.plan_update import ExecutionState, NoPlanUpdate, Planner, PlanUpdate
from comity_executor.recovery import Later, Recovery, broken
from comity_executor.robots.check import require_robot
from comity_executor.robots.goals import GoalId, MotionGoal
from comity_executor.robots.raised import raised
from comity_executor.robots.rest import Rest
from comity_executor.robots.robot import Robot
from comity_executor.robots.senses import ReadingSeries, Senses
from comity_executor.robots.status import has_stopped
from comity_executor.speech.speaker import SPEAKER, Speaker
from comity_executor.tracing import trace as _trace
from comity_executor.tracing.intervention import Intervention, held
from comity_executor.tracing.recorder import Recorder
from comity_executor.tracing.trace import EventStatus, Halt, TraceEvent
from comity_executor.trees.btcpp import btcpp_xml
from comity_executor.trees.leaf_faults import LeafFaults
from comity_executor.trees.tree import Tree, build_tree
from comity_fis.inference.value import Inference

ExecutionStatus = Literal["running", "success", "failure", "stopped", "stop_unconfirmed"]
RESUMED = Cause("condition", "the stop was released, and the robot was told to resume", None)
NOBODY: Mapping[str, str] = MappingProxyType({})


class Execution:
    """A plan in execution. The caller owns time: it steps the world and calls `tick` in turn.

    Args:
        plan: For each person a Reach_user, then a Greet_person.
        robot: The robot that executes it.
        values: Everyone's parameters, by name.
        limits: Timeouts, attempts and tolerances.
        interventions: Results to hold fixed, for counterfactual runs; empty in normal use.
        planner: Asked when things change and when the tree fails; None: the plan stays fixed, and a failed
            tree has failed for good.
        unserved: People left out because no plan can serve them, and why; a planner considers them again when
            the rest is done.
        acts: Custom behaviours in place of the robot's acts, by the act's name (`say` or a gesture): a
            function of the node's name, such as `juggle(johanna)`, and the person.
        emergency: Returns why the robot must stand still, replacing the robot's own call: in real time, the
            `read` of a `Heartbeat`.
        speaker: Chooses the wordings and forms of address.

    Raises:
        RobotError: If the robot lacks a call, or returns an invalid value (see `check_robot`).
        ValueError: If the plan cannot be executed (see `build_tree`).
    """

    def __init__(
        self,
        plan: Plan,
        robot: Robot,
        values: Mapping[str, Inference],
        limits: Limits = DEFAULT_LIMITS,
        interventions: Iterable[Intervention] = (),
        *,
        planner: Planner | None = None,
        unserved: Mapping[str, str] = NOBODY,
        acts: Mapping[str, MakeAct] = NO_ACTS,
        emergency: Callable[[], object] | None = None,
        speaker: Speaker = SPEAKER,
    ) -> None:
        require_robot(robot, dict.fromkeys(step.person for step in plan.steps))
        self._robot = robot
        self._limits = limits = replace(limits, tolerance_m=robot.capabilities.tolerance_m)
        self._planner = planner
        self._values = values
        self._acts = dict(acts)
        self._speaker = speaker
        self._interventions = tuple(interventions)
        self._behaviours: tuple[Behaviour, ...] = ()
        self._actions: list[Action] = []
        """Action leaves of the current tree, and earlier ones that still have to be ended again."""
        self._has_to_rest = False
        self._ended_s = 0.0
        self._has_resumed = False
        self._looks: GoalId | None = None
        """The goal of turning to a person while no plan is in execution."""
        self._base_rest = Rest(robot, limits.cruise_speed_m_s)
        self._senses = Senses(robot, emergency)
        self._memory = Memory(self._senses.now_s)
        self._asking = Asking(limits, self._memory.shared)
        self._faults = LeafFaults()
        self._recovery = Recovery(planner, limits) if planner else None
        self._deeds = 0
        """Number of people served and of other agenda items done."""
        self._next: PlanUpdate | None = None
        self._no_more: str | None = None
        """Why no other plan took over after the last failure; None if one did."""
        self._trees: list[Tree] = []
        """The trees of all plans so far."""
        self._unserved: Mapping[str, str] = NOBODY
        """People left out of the current plan, and why."""
        self._revisions: list[PlanUpdate] = []
        self._recorder = Recorder(self._senses.now_s)
        self.tree = BehaviourTree(self._begin(plan, values, unserved if planner else NOBODY))
        """The behaviour tree; each new plan replaces its root. Visitors and handlers can be added."""
        self.tree.add_visitor(self._recorder)
        self.tree.add_pre_tick_handler(self._faults.arm)
        self.tree.add_post_tick_handler(self._faults.disarm)
        self.status: ExecutionStatus = "running"
        """`success`: everyone was greeted, or declined. `failure`: the visits say who was not. `stopped`: by
        `stop`, or by an exception outside the leaves. `stop_unconfirmed`: the base was commanded to stop, by
        the emergency stop or at the end, and has not confirmed in time that it is at rest; every further
        `tick` repeats the command."""

    def go_on_from(self, halted: Execution) -> None:
        """Skip what a halted execution has already said or shown; call it before the first tick.

        An emergency stop that was pressed then and not resumed still holds.
        """
        self._senses.stop_button.hold(halted.stopped_by)
        for person, visit in halted._memory.visits.items():
            if person in self._memory.visits:
                self._memory.visits[person].done_before = (*visit.done_before, *visit.performed)

    def tick(self) -> ExecutionStatus:
        """Tick the tree once, at the world's current time; after the end, only repeat pending stops.

        No exception of a robot call or a leaf leaves this method: one outside the leaves ends the execution
        as `stopped`, with its text.
        """
        if self.status == "running":
            self._end_what_goes_on()
            try:
                self._begin_and_step()
            except Exception as error:
                self.stop(raised(error))
        self._end_what_goes_on()
        self._watch_rest()
        return self.status

    @property
    def stopped_by(self) -> str | None:
        """Why the robot stands still: its stop was pressed, and not resumed; None if it may move."""
        return self._senses.stop_button.reason

    @property
    def is_at_rest(self) -> bool:
        """Whether the base had to be at rest in the last tick, and confirmed it."""
        return self._base_rest.is_confirmed

    def resume(self) -> bool:
        """Resume after a released stop: the next tick senses and plans everything again.

        Returns:
            Whether execution resumes; False while the stop is pressed.
        """
        if self.stopped_by is not None:
            self._has_resumed = self._senses.stop_button.resume()
        return self.stopped_by is None

    def _begin_and_step(self) -> None:
        t = self._senses.begin_tick()
        root = self._step_held(t) if self._interventions else self._step(t)
        if root is not Status.RUNNING:
            self.status = "success" if root is Status.SUCCESS else "failure"
            self._conclude(*filter(None, (why_failed(self.tree.root), self._no_more)))
        else:
            self._rest_if_left()
            self._renew_goal()

    def _end_what_goes_on(self) -> None:
        """Retry ending leaves whose end raised an exception; after the end of all, stop the base, too."""
        for leaf in self._actions:
            if leaf.has_to_end_again:
                leaf.try_to_end()
        if self._has_to_rest:
            self._rest()

    def _watch_rest(self) -> None:
        """Report a base that has not come to rest in time."""
        rest = self._base_rest
        has_to_rest = self.status != "running" or self.stopped_by is not None
        t = self._senses.look_at_clock() if has_to_rest else self._senses.now_s()
        rest.look(t, has_to_rest=has_to_rest)
        if rest.is_overdue:
            self.stop(f"the base has not come to rest within {rest.patience_s:g} s after it was told to stop")
            self.status = "stop_unconfirmed"

    def _rest_if_left(self) -> None:
        """Stop a goal whose leaf has ended, unless another leaf has taken the base."""
        holder = self._memory.shared.base
        if holder is None or any(leaf.id == holder.id and leaf.is_under_way for leaf in self._actions):
            return
        with suppress(Exception):  # retried at the end of the next tick
            if holder.goal is not None or not has_stopped(self._robot):
                self._robot.stop(holder.goal)
            self._memory.shared.base = None

    def _renew_goal(self) -> None:
        """Renew the base's goal: this tick has read the stop, and its tree still wants the goal."""
        holder = self._memory.shared.base
        goal = holder.goal if holder else self._looks
        if goal is not None and self.stopped_by is None:
            with suppress(Exception):  # then the base stops by itself, and the leaf notices
                self._robot.renew(goal)

    def _rest(self) -> None:
        """Stop the base, again in every tick until it confirms that it has stopped."""
        self._has_to_rest = True
        with suppress(Exception):
            self._robot.stop()
            self._has_to_rest = not has_stopped(self._robot, self._ended_s)

    def _step_held(self, t: float) -> Status:
        """The same with results held by interventions."""
        known = [each for each in self._interventions if each.path < len(self._behaviours)]
        with held(known, self._behaviours, self._senses):
            return self._step(t)

    def _step(self, t: float) -> Status:
        """Review the plan and tick its tree; returns the root's status."""
        if self.stopped_by is not None:
            return self._tick_tree()
        if self._has_resumed:
            self._take_up_again(t)
        if self._recovery and self._recovery.is_waiting:
            return self._take(t, self._recovery.look(self._course(t)))
        if self._planner and self._next is None and self._planner.has_news(t):
            self._review(t, self._planner)
        root = self._tick_tree()
        if root is Status.FAILURE and self._next is not None:
            if self._recovery and not self._next.was_asked_for:
                self._recovery.count_change()
            self._renew(t, self._next)
            root = self._tick_tree()
        if root is Status.FAILURE and self._recovery:
            root = self._recover(t, self._recovery)
        return root

    def _take_up_again(self, t: float) -> None:
        """After a stop nothing continues as planned: the plan is reviewed."""
        self._has_resumed = False
        if self._recovery and self._recovery.is_waiting:
            with suppress(Exception):  # the wait continues until there is a new plan
                self.tree.root.stop(Status.INVALID)
            self._recorder.note_halts(t, RESUMED.text, "preempted")
        elif self._planner:
            self._review(t, self._planner, (RESUMED,))

    def _tick_tree(self) -> Status:
        self.tree.tick()
        return self.tree.root.status

    def raise_in(self, leaf: str, error: FaultError, *, times: int = 1) -> None:
        """Make a leaf raise an exception at its next tick, which becomes a failure.

        Args:
            leaf: Its name, `say(johanna)`, or its action alone, `say`.
            error: The exception.
            times: Number of its ticks that raise.
        """
        self._faults.add(leaf, error, times)

    def stop(self, text: str, *, halt: Halt = "emergency") -> None:
        """Stop everything now: the robot comes to rest and aborts its acts.

        Args:
            text: The reason, for the trace.
            halt: The kind of halt: `timed_out` if the time is over.
        """
        if self.status == "running":
            self.status = "stopped"
            with suppress(Exception):  # of a custom behaviour: all others are still ended
                self.tree.root.stop(Status.INVALID)
            for leaf in self._actions:
                leaf.terminate(Status.INVALID)
            self._recorder.note_halts(self._senses.look_at_clock(), text, halt)
            self._conclude(text)

    def _conclude(self, *reasons: str) -> None:
        """End the execution: every open visit is closed with its reason, and the base rests."""
        for visit in self.visits:
            if visit.outcome == "pending" and visit.person in self._memory.visits:
                self._memory.visits[visit.person].give_up("; ".join(reasons))
        self._memory.close()
        self._ended_s = self._senses.look_at_clock()
        self._rest()

    @property
    def plan(self) -> Plan:
        """The current plan."""
        return self._trees[-1].plan

    @property
    def steps(self) -> tuple[PlanStep, ...]:
        """The steps planned for each person, from the last plan that included them."""
        plans = (plan for tree in self._trees for plan in tree.plans)
        stops = {(step.action, step.person): step for plan in plans for step in plan.steps}
        return tuple(stops.values())

    @property
    def revisions(self) -> tuple[PlanUpdate, ...]:
        """All plan updates so far: one per event `rebound` or `replanned`, in order."""
        return tuple(self._revisions)

    @property
    def values(self) -> Mapping[str, Inference]:
        """Everyone's current parameters."""
        return self._values

    @property
    def nodes(self) -> tuple[Node, ...]:
        """The trees of all plans so far, one after the other, each in pre-order."""
        return self._recorder.nodes

    @property
    def events(self) -> tuple[TraceEvent, ...]:
        """The trace so far."""
        return tuple(self._recorder.events)

    @property
    def visits(self) -> tuple[Visit, ...]:
        """The outcome of every visit so far, in the order in which people were first planned for."""
        found: dict[str, Visit] = {}
        for tree in self._trees:
            found |= {visit.person: visit for meeting in tree.meetings for visit in meeting.visits()}
            skipped = (step.person for step in tree.plan.steps if step.action == SKIP)
            found |= {person: skipped_visit(person) for person in skipped}
        return tuple(found.values())

    @property
    def blackboard(self) -> tuple[Shared, ...]:
        """The current entries of the blackboard, with their readers and writers."""
        return tuple(self._memory.space.shared().values())

    @property
    def writes(self) -> tuple[Write, ...]:
        """Every value written to the blackboard so far, with time and leaf."""
        return tuple(self._memory.space.history)

    @property
    def readings(self) -> ReadingSeries:
        """Every reading that the tree took."""
        return self._senses.series

    def trace_lines(self) -> tuple[str, ...]:
        """The trace in its canonical encoding."""
        return tuple(_trace.trace_lines(self.events, self.nodes))

    def trace_sha256(self) -> str:
        """The digest of the trace: equal for equal episodes."""
        return _trace.trace_sha256(self.trace_lines())

    def btcpp_xml(self) -> str:
        """The current plan's tree as XML for BehaviorTree.CPP and Groot2.

        Raises:
            ValueError: For a name that cannot be expressed there.
        """
        return btcpp_xml(self.tree.root)

    def _review(self, t: float, planner: Planner, because: tuple[Cause, ...] = ()) -> None:
        """Ask whether the plan still holds, and why; updated parameters take effect at once."""
        course = self._course(t)
        try:
            revision = planner.review(course)
        except Exception as error:
            self._note("not_replanned", broken(error))
            revision = self._permitted(course, planner)
        if revision is None:
            return
        revision = replace(revision, because=(*because, *revision.because))
        if revision.replanned:
            self._next = revision
            self._memory.shared.outdated = "; ".join(cause.text for cause in revision.because[:2])
        else:
            self._asking.forget(revision.moved)
            self._values = revision.values
            self._trees[-1].rebind(revision.plan, revision.values)
            self._revisions.append(revision)
            self._note("rebound", revision.because)

    def _permitted(self, course: ExecutionState, planner: Planner) -> PlanUpdate | None:
        """The permitted part of the plan after the planner raised an exception.

        If the planner cannot determine even that, the plan must not continue: the tree fails, and the robot
        rests.
        """
        try:
            return planner.permitted(course)
        except Exception as error:
            causes = broken(error)
            self._memory.shared.outdated = causes[-1].text
            self._note("not_replanned", causes)
            return None

    def _recover(self, t: float, recovery: Recovery) -> Status:
        """After a failure of the tree: continue with another plan, wait for one, or end."""
        course = self._course(t)
        if self._is_everybody_served():
            return Status.SUCCESS
        return self._take(t, recovery.after_failure(course))

    def _take(self, t: float, answer: PlanUpdate | Later | NoPlanUpdate | None) -> Status:
        """Apply the planner's answer after a failure; returns the overall status."""
        if isinstance(answer, PlanUpdate):
            self._renew(t, answer)
        elif answer is not None:
            self._note("not_replanned", answer.because)
            self._no_more = answer.because[-1].text if answer.because else None
        if isinstance(answer, Later) and answer.look_for is not None:
            with suppress(Exception):  # a robot that cannot turn still waits
                self._memory.shared.base = None  # the turn replaces the last command
                self._senses.require_fresh()
                self._looks = self._robot.go(MotionGoal("face", answer.look_for))
        return Status.FAILURE if isinstance(answer, NoPlanUpdate) else Status.RUNNING

    def _is_everybody_served(self) -> bool:
        """Whether the tree failed although nothing is left to do: one of its leaves raised an exception."""
        served = all(visit.outcome in PROPER_OUTCOMES for visit in self.visits)
        return served and not self._unserved

    def _renew(self, t: float, revision: PlanUpdate) -> None:
        """Switch to another plan."""
        self._next, self._looks = None, None
        self._asking.forget(revision.moved)
        for step in revision.plan.steps:
            if step.person in self._memory.visits:
                self._memory.visits[step.person].start_again()
        self.tree.root = self._begin(revision.plan, revision.values, revision.unserved)
        if self.tree.tree_update_handler:
            self.tree.tree_update_handler()
        self._revisions.append(revision)
        self._note("replanned", revision.because)

    def _begin(self, plan: Plan, values: Mapping[str, Inference], unserved: Mapping[str, str]) -> Behaviour:
        """Build the tree of a plan, watched by the recorder; returns its root."""
        self._values, self._unserved = values, unserved
        for person in unserved.keys() & self._memory.visits.keys():
            self._memory.visits[person].give_up(unserved[person])
        tree = build_tree(
            plan,
            self._robot,
            values,
            self._limits,
            senses=self._senses,
            memory=self._memory,
            acts=self._acts,
            unserved=unserved,
            speaker=self._speaker,
        )
        nodes = tuple(_node.preorder(tree.root))
        self._behaviours += nodes
        self._actions = [
            *(leaf for leaf in self._actions if leaf.has_to_end_again),
            *(node for node in nodes if isinstance(node, Action)),
        ]
        self._trees.append(tree)
        self._recorder.watch(tree.root)
        return tree.root

    def _note(self, status: EventStatus, because: tuple[Cause, ...]) -> None:
        """Record what became of the plan itself, at the node `plan_holds?`."""
        self._recorder.note(self._trees[-1].holds, status, because)

    def _meetings(self) -> Iterator[VisitContext]:
        return (meeting for tree in self._trees for meeting in tree.meetings)

    def _course(self, t: float) -> ExecutionState:
        visits = self.visits
        done = tuple(visit.person for visit in visits if visit.outcome in ("greeted", "declined"))
        deeds = len(done) + sum(deed.done_s is not None for visit in visits for deed in visit.agenda)
        if self._recovery and deeds > self._deeds:
            self._recovery.begin_again()
        self._deeds = deeds
        return ExecutionState(
            t=t,
            plan=self.plan,
            values=self._values,
            done=done,
            failures={
                visit.person: visit.failure
                for visit in visits
                if visit.failure and visit.outcome not in PROPER_OUTCOMES
            },
            may_replan=self._recovery is not None and self._recovery.may_change,
            progress=progress_of(self._meetings(), self._robot),
            unserved=self._unserved,
            asked=self._asking.people,
            refused=self._asking.refused,
        )
