"""An episode in progress, simulated or around a real robot, tick by tick."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from datetime import date
from functools import partial
from math import dist
from typing import TYPE_CHECKING, cast

from comity.answers.run import Disturbance
from comity.episode import Episode, Outcome
from comity.live.driving import drive, stop_of
from comity.live.real_world import RealWorld
from comity.live.reduced_margin_check import require_reduced_margin
from comity.monitoring.fallible_planner import FalliblePlanner
from comity.monitoring.guarding import Guarding
from comity.monitoring.lateness import late_s
from comity.monitoring.measuring import figures
from comity.monitoring.operating import Approved, Operating
from comity.monitoring.patience import limits_of
from comity.monitoring.replanning import WorldPlanner
from comity.people.adulthood import is_under_age
from comity.planning.narrow_gap import narrow_gap
from comity.schedule import Schedule, Stage
from comity.simulation.happenings import told as told_only
from comity.simulation.manoeuvres import MotionLog
from comity.simulation.passages import passages, without_room
from comity.simulation.scene_later import scene_at
from comity.simulation.walks import walks
from comity_domain.choices.greeting import NO_GESTURE
from comity_executor import (
    NO_ACTS,
    PROPER_OUTCOMES,
    Execution,
    ExecutionStatus,
    MakeAct,
    Node,
    PlanUpdate,
    ReadingSeries,
    TraceEvent,
    Write,
)
from comity_executor.memory.visit_context import SAY_ACT
from comity_fis.errors import InputError
from comity_sim2d import DoorTurn, Frames, SceneError, World
from comity_sim2d.base.drive import stopping_time_s
from comity_sim2d.people.undisturbed import undisturbed_walks
from comity_sim2d.pose import wrap_angle

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from comity.environment import Environment
    from comity.live.operator import Operator
    from comity.people.profile import Profile
    from comity.preparation import PlannedEpisode
    from comity.scenario import ScenarioFile
    from comity.schedule import Happening
    from comity_domain import Plan, Visitee
    from comity_executor import LoopReport, MapRobot, Planner
    from comity_fis import Inference, Rulebook
    from comity_sim2d.people.reactions import Shown

AFTERMATH_S = 0.5
"""Time for which the world continues after the last act, so that the frames show the robot at rest [s]."""
LONGEST_AFTERMATH_S, REST_M_S, REST_RAD_S = 5.0, 0.01, 0.01
"""Maximum of that time [s] while the robot moves faster than `REST_M_S` [m/s] or turns faster than
`REST_RAD_S` [rad/s]: it may retreat from an approaching person, and a base with slow dynamics takes longer to
stop."""

SOONER_S = 10
"""Additional length of walks without the robot, for people who arrive sooner because of it [s]."""


@dataclass(frozen=True, slots=True)
class EpisodeProgress:
    """Progress of an episode, for display."""

    simulated_s: float
    doing: str


class LiveEpisode:
    """An episode in progress: whatever ends it, its record so far can be read.

    Args:
        prepared: The scenario with its plan.
        seed: Seed of the sensor noise, if any.
        happenings: Events during the episode, besides the scenario's changes and faults.
        acts: Custom behaviours in place of the robot's acts, by the act's name (see `Execution`).
        robot: A real robot in the place of the simulated one, on the scenario's map (see `MapRobot`). What
            people say happens at its times; faults, walks, doors and stops are those of the real world.
        planner: A planner in place of ours.
        operator: Operator of a real robot; every command is recorded in the trace.
        unreviewed_wordings: Whether a real robot says wordings that nobody who speaks the language has
            reviewed; else it says the name and the plainest word for it in the language of the site.

    Raises:
        InputError: `acts` names no act that a greeting can have, there is an operator and no robot, or the
            robot is real and somebody is, or may be, a child, or it may not keep the scenario's margin.
        RobotError: The robot cannot be driven.
    """

    def __init__(
        self,
        prepared: PlannedEpisode,
        *,
        seed: int = 0,
        happenings: Iterable[Happening] = (),
        acts: Mapping[str, MakeAct] = NO_ACTS,
        robot: MapRobot | None = None,
        planner: Planner | None = None,
        operator: Operator | None = None,
        unreviewed_wordings: bool = False,
    ) -> None:
        _check_acts(prepared.rulebook, acts)
        self._prepared = prepared
        self._seed = seed
        self._base = robot
        self._world: Environment
        self._heartbeat = None
        stop = None
        if robot is None:
            _refuse(operator)
            self._world = World(
                prepared.scene, seed, route_map=prepared.route_map, places=prepared.asked.places
            )
        else:
            _refuse_children(prepared.file, prepared.profiles, prepared.day)
            require_reduced_margin(prepared.file, robot)
            self._world = RealWorld(robot, prepared.scene, operator)
            self._world.robot.learn_places(prepared.asked.places)
            self._heartbeat = stop_of(robot)
            own_stop = self._heartbeat.read if self._heartbeat else robot.emergency
            stop = self._world.robot.stop_of(own_stop)
        limits = limits_of(prepared.file.scenario.limits, attend_s=prepared.attend_s)
        if robot is None:  # the clock of a real robot need not start at 0
            limits = replace(limits, ends_s=prepared.file.scenario.limits.time_s)
        self._listener = WorldPlanner(prepared, self._world)
        self._planner = FalliblePlanner(self._listener)
        self._guard = Guarding(prepared, self._planner)
        happens = (*prepared.happenings, *happenings)
        self._schedule = Schedule(happens if robot is None else told_only(happens))
        self._motion = MotionLog()
        self._loop: LoopReport | None = None
        asks: Planner = planner or self._planner
        self._execution = Execution(
            prepared.plan,
            self._world.robot,
            prepared.values,
            limits,
            planner=Approved(asks, operator) if operator else asks,
            unserved=prepared.asked.unreachable,
            acts=acts,
            emergency=stop,
            speaker=replace(prepared.speaker, reviewed_only=robot is not None and not unreviewed_wordings),
        )
        self._operating = operator and Operating(
            operator,
            self._listener,
            self._guard,
            self._schedule,
            self._execution,
            prepared=prepared,
            tolerance_m=self._world.robot.capabilities.tolerance_m,
        )

    def run(self, watch: Callable[[EpisodeProgress], None] | None = None) -> None:
        """Execute the plan to its end, or to the scenario's time limit.

        Args:
            watch: Called once per second of the episode.
        """
        # Where the world is real, nothing is left that touches it.
        stage = Stage(cast("World", self._world), self._guard, self._execution)
        self._schedule.step(stage)
        if isinstance(self._world, World):
            self._run_simulated(self._world, stage, watch)
        else:
            self._run_real(cast("RealWorld", self._world), stage, watch)

    def _run_simulated(
        self, world: World, stage: Stage, watch: Callable[[EpisodeProgress], None] | None
    ) -> None:
        while self._tick(world) == "running" and not self._ends_in_time():
            if watch and world.time_s % 1.0 < 1e-9:
                watch(self._progress())
            began_s = world.time_s
            world.step()
            self._motion.note(world.robot.motion().text, world.robot.goal, began_s, world.time_s)
            self._schedule.step(stage)
        _come_to_rest(world, self._execution)

    def _run_real(
        self, world: RealWorld, stage: Stage, watch: Callable[[EpisodeProgress], None] | None
    ) -> None:
        told_s = 0
        self._guard.doubt(world.robot.uncertain)

        def each() -> None:
            nonlocal told_s
            world.observe()
            self._guard.doubt(world.robot.uncertain)
            self._schedule.step(stage)
            if self._operating:
                self._operating.carry_out(world.time_s)
            self._ends_in_time()
            if watch and world.time_s >= told_s + 1:
                told_s = int(world.time_s)
                watch(self._progress())

        assert self._base is not None
        self._loop = drive(self._execution, self._base, self._heartbeat, each)
        with suppress(Exception):  # where its clock is broken, the last frame stands
            world.observe()

    def _ends_in_time(self) -> bool:
        """Whether the scenario's time is over, which ends the execution."""
        limit_s = self._prepared.file.scenario.limits.time_s
        if self._world.time_s < limit_s:
            return False
        over = f"the scenario's limit of {limit_s:g} s was reached (`time_s` of its limits allows more)"
        self._execution.stop(over, halt="timed_out")
        return True

    def _progress(self) -> EpisodeProgress:
        return EpisodeProgress(self._world.time_s, _doing(self._execution))

    def resume(self) -> bool:
        """Let a real robot go on after its stop was pressed and released (see `Execution.resume`)."""
        return self._execution.resume()

    def _tick(self, world: World) -> ExecutionStatus:
        """Tick the tree; where nobody is there to resume after a stop, all ends once the robot rests.

        After a contact it goes on when its base lets it: in a simulation that harms nobody and is counted.
        """
        execution = self._execution
        was_pressed = world.robot.emergency_stop.was_pressed
        resumes = self._prepared.file.scenario.limits.resumes or not was_pressed
        if resumes:
            execution.resume()
        execution.tick()
        if execution.stopped_by and execution.is_at_rest and not resumes:
            execution.stop(f"{execution.stopped_by} (with `resumes: true` in its limits a scenario goes on)")
        return execution.status

    def change(self, person: str, values: Inference, text: str) -> None:
        """Update a person's parameters from the next tick on, after a request or learning.

        Args:
            person: The person.
            values: All their parameters.
            text: What happened, in words, for the trace.

        Raises:
            KeyError: If there is no such person.
        """
        self._guard.tell(person, values, text)
        now_s = self._world.time_s
        self._schedule.record(Disturbance(now_s, now_s, "message", person, text))

    @property
    def plan(self) -> Plan:
        """The current plan."""
        return self._execution.plan

    @property
    def revisions(self) -> tuple[PlanUpdate, ...]:
        """All plan updates so far, in order."""
        return self._execution.revisions

    @property
    def door_turns(self) -> tuple[DoorTurn, ...]:
        """All openings and shuttings of doors so far, in order."""
        return self._world.door_turns

    @property
    def nodes(self) -> tuple[Node, ...]:
        """The behaviour tree."""
        return self._execution.nodes

    @property
    def events(self) -> tuple[TraceEvent, ...]:
        """The trace so far."""
        return self._execution.events

    def frames_since(self, count: int) -> Frames:
        """Poses of all entities so far, without the first `count` frames."""
        return self._world.frames_since(count)

    @property
    def readings(self) -> ReadingSeries:
        """The sensor readings received by the tree so far."""
        return self._execution.readings

    @property
    def writes(self) -> tuple[Write, ...]:
        """Every value written to the blackboard so far."""
        return self._execution.writes

    @property
    def shown(self) -> tuple[Shown, ...]:
        """True reactions of people so far, whether or not the robot noticed."""
        return self._world.shown

    @property
    def disturbances(self) -> tuple[Disturbance, ...]:
        """Changes, faults and messages so far, by time; walks are told once the episode is over."""
        real = self._world.disturbances if isinstance(self._world, RealWorld) else ()
        return tuple(sorted((*self._schedule.disturbances, *real), key=lambda one: one.t))

    def _disturbances(self, frames: Frames) -> tuple[Disturbance, ...]:
        people = (person.name for person in self._prepared.scene.people)
        passed = passages(frames, self._world.margin_decisions, partial(self._lacks, frames))
        stayed = without_room(frames, self._world.events, self._prepared.scene.people)
        found = (*self.disturbances, *walks(frames, people), *passed, *stayed)
        return tuple(sorted(found, key=lambda one: one.t))

    def _lacks(self, frames: Frames, t: float) -> str:
        """How much too narrow the robot's way was at a time [s], in words; empty if it was not."""
        goal = next((span.goal for span in self._motion.spans if span.end_s > t), None)
        if goal is None:
            return ""
        try:
            scene = scene_at(self._prepared.scene, frames, t, turns=self.door_turns)
        except SceneError:  # bodies overlap at that time
            return ""
        gap = narrow_gap(scene, "", [goal])
        return "" if gap is None else gap.lacks

    def _undisturbed(self, frames: int) -> dict[str, NDArray[np.float64]]:
        """The walks of simulated people without the robot, those left out that a change moved."""
        world = self._world
        if not isinstance(world, World):
            return {}
        hz = round(1.0 / world.step_s)
        ticks = frames - 1 + SOONER_S * hz
        alone = undisturbed_walks(
            self._prepared.scene, self._seed, ticks, control_hz=hz, turns=world.door_turns
        )
        changed = {one.about for one in self._schedule.disturbances if one.kind == "change"}
        return {name: walk for name, walk in alone.items() if name not in changed}

    def so_far(self) -> Episode:
        """The episode so far."""
        world, execution = self._world, self._execution
        frames, told = world.frames, self._listener.told
        return Episode(
            prepared=self._prepared,
            seed=self._seed,
            outcome=_outcome(execution, self._prepared.visitees, self._prepared.asked.unreachable),
            visits=execution.visits,
            events=execution.events,
            frames=frames,
            acts=world.events,
            door_turns=world.door_turns,
            metrics=figures(
                self._prepared,
                frames,
                world.robot_touches,
                execution.visits,
                execution.events,
                revisions=execution.revisions,
                told=told,
                undisturbed=self._undisturbed(len(frames)),
            ),
            nodes=execution.nodes,
            values=execution.values,
            steps=execution.steps,
            revisions=execution.revisions,
            told=told,
            disturbances=self._disturbances(frames),
            motion=tuple(self._motion.spans),
            readings=execution.readings,
            writes=execution.writes,
            loop=self._loop,
            uncertain=frozenset(self._guard.was_uncertain),
        )


def execute(
    prepared: PlannedEpisode,
    *,
    seed: int = 0,
    acts: Mapping[str, MakeAct] = NO_ACTS,
    robot: MapRobot | None = None,
    unreviewed_wordings: bool = False,
) -> Episode:
    """Execute a plan.

    Args:
        prepared: The scenario with its plan.
        seed: Seed of the sensor noise, if any.
        acts: Behaviours of your own in place of the robot's acts, by the act's name.
        robot: A real robot in the place of the simulated one.
        unreviewed_wordings: Whether a real robot says wordings that nobody has reviewed.
    """
    live = LiveEpisode(prepared, seed=seed, acts=acts, robot=robot, unreviewed_wordings=unreviewed_wordings)
    live.run()
    return live.so_far()


IN_A_STUDY = (
    "For a study with children, state `child_study: true`, and of each child `guardian_consent: true`."
)
STATE_AGES = (
    "State the age in the profile; or, where you know that all are adults, `adults_only: true` in the "
    "scenario (`--adults-only`)."
)


def _refuse_children(file: ScenarioFile, profiles: Mapping[str, Profile], day: date | None) -> None:
    """Reject visits of a real robot to children or people of unknown age, except in a study with consent."""
    scenario = file.scenario
    for name in scenario.visited():
        is_child = is_under_age(profiles[name], day)
        if (is_child is None and scenario.adults_only) or is_child is False:
            continue
        if scenario.child_study and scenario.people[name].guardian_consent:
            continue
        raise InputError(
            expected=f"adults before a real robot: {name} is 18 or older",
            got="an age below 18" if is_child else "no age",
            remedy=IN_A_STUDY if is_child else STATE_AGES,
            where=file.where("people", name),
        )


def _refuse(operator: Operator | None) -> None:
    if operator is not None:
        raise InputError(
            expected="an operator of a real robot",
            got="one without a robot",
            remedy="Give the robot, too: the simulated one runs faster than anybody could speak.",
        )


def _check_acts(rulebook: Rulebook, acts: Iterable[str]) -> None:
    gestures = rulebook.parameters.get("greeting_gesture")
    categories = getattr(gestures, "categories", ())
    known = (SAY_ACT, *(each.name for each in categories if each.name != NO_GESTURE))
    for act in acts:
        if act not in known:
            raise InputError(
                expected=f"an act of a greeting: {', '.join(known)}",
                got=f"acts[{act!r}]",
                remedy="Name one of these, or add the gesture to `greeting_gesture` of the rulebook.",
            )


def _come_to_rest(world: World, execution: Execution) -> None:
    """Let the world go on after the end, until the robot has stood for a moment."""
    end_s = world.time_s + max(LONGEST_AFTERMATH_S, stopping_time_s(world.scene.robot))
    stands_s, before = 0.0, world.robot.pose
    while stands_s < AFTERMATH_S - world.step_s / 2 and world.time_s < end_s:
        world.step()
        execution.tick()  # until it has heard that the robot rests
        here = world.robot.pose
        turned_rad = abs(wrap_angle(here.heading_rad - before.heading_rad))
        is_still = dist(before.xy, here.xy) <= REST_M_S * world.step_s
        rests = is_still and turned_rad <= REST_RAD_S * world.step_s
        stands_s = stands_s + world.step_s if rests else 0.0
        before = here


def _outcome(execution: Execution, visitees: Sequence[Visitee], unreachable: Collection[str]) -> Outcome:
    """The outcome: partial if one person was greeted and another was late or not fully served."""
    if execution.status == "stop_unconfirmed":
        return execution.status
    fared = {visit.person: visit.outcome for visit in execution.visits}
    wanted = fared.keys() | set(unreachable)
    if sum(outcome in PROPER_OUTCOMES for outcome in fared.values()) == len(wanted):
        return "partial" if any(late_s(visitees, visit) for visit in execution.visits) else "success"
    if execution.status == "stopped":
        return "stopped"
    return "partial" if any(outcome in ("greeted", "unfinished") for outcome in fared.values()) else "failed"


def _doing(execution: Execution) -> str:
    """Why the robot stands still, or the person whose visit is in progress, if any."""
    if execution.stopped_by is not None:
        return f"standing until it is resumed: {execution.stopped_by}"
    pending = (visit.person for visit in execution.visits if visit.outcome == "pending")
    return next((f"visiting {person}" for person in pending), "done")
