"""One episode: the plan executed in the world, and what happened."""

from __future__ import annotations

import platform
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from html import escape
from math import dist
from typing import TYPE_CHECKING, Literal, cast

from comity.data_frames import events_table, frames_table, readings_table
from comity.live.driving import drive, stop_of
from comity.live.real_world import RealWorld
from comity.monitoring.fallible_planner import FalliblePlanner
from comity.monitoring.guarding import Guarding
from comity.monitoring.lateness import late_s
from comity.monitoring.measuring import figures
from comity.monitoring.patience import limits_of
from comity.monitoring.replanning import WorldPlanner
from comity.monitoring.told import values_at
from comity.schedule import Disturbance, Schedule, Stage
from comity.simulation.happenings import told as told_only
from comity.simulation.walks import walks
from comity_executor import (
    NO_ACTS,
    Execution,
    ExecutionStatus,
    History,
    MakeAct,
    Node,
    ReadingSeries,
    Revision,
    TraceEvent,
    Visit,
    Why,
    Write,
    trace_lines,
    trace_sha256,
)
from comity_executor.memory.meeting import NO_GESTURE, UTTER
from comity_fis.errors import InputError
from comity_sim2d import ActEvent, DoorTurn, Frames, Metrics, World, of_episode
from comity_sim2d.base.drive import stopping_time_s
from comity_sim2d.pose import wrap_angle

if TYPE_CHECKING:
    from pandas import DataFrame

    from comity.data_frames import Table
    from comity.environment import Environment
    from comity.monitoring.told import Told
    from comity.preparation import Prepared
    from comity.schedule import Happening
    from comity_domain import Plan, PlanStep
    from comity_executor import LoopReport, MapRobot, Planner
    from comity_fis import Inference
    from comity_sim2d.people.reactions import Shown

Outcome = Literal["success", "partial", "failed", "stopped", "stop_unconfirmed"]

AFTERMATH_S = 0.5
"""The world goes on for so long after the last act, so that the frames show the robot at rest."""
LONGEST_AFTERMATH_S, REST_M_S, REST_RAD_S = 5.0, 0.01, 0.01
"""Longer, up to the first [s], while the robot moves faster than the second [m/s] or turns faster than the
third [rad/s]: it may go back before a person who comes. A soft base takes longer to stop."""

SHOWN = 8
"""Visits in an episode's `repr`."""
FRAME_PX = 720
"""Height of an episode's page in a notebook."""


@dataclass(frozen=True, slots=True, eq=False)
class Episode:
    """What happened, all of it."""

    prepared: Prepared
    seed: int
    outcome: Outcome
    visits: tuple[Visit, ...]
    events: tuple[TraceEvent, ...]
    frames: Frames
    acts: tuple[ActEvent, ...]
    door_turns: tuple[DoorTurn, ...]
    """Every door that was opened or shut, in order."""
    metrics: Metrics
    nodes: tuple[Node, ...]
    """The behaviour trees, one for every plan."""
    values: Mapping[str, Inference]
    """Everyone's parameters as they were in the end."""
    steps: tuple[PlanStep, ...]
    """What was planned for everybody, by the last plan that had them."""
    revisions: tuple[Revision, ...]
    """What took over from the first plan, in order."""
    told: tuple[Told, ...]
    """What people asked for on the way, in order: it counts from then on."""
    disturbances: tuple[Disturbance, ...]
    """Changes, faults, messages and walks of people, by time: what the robot had to cope with."""
    readings: ReadingSeries
    """What the robot's sensors told the tree."""
    writes: tuple[Write, ...]
    """Every value that an entry of the blackboard got, in order."""
    loop: LoopReport | None = None
    """How the loop of a real robot kept its rate; None in the simulated world."""
    uncertain: frozenset[str] = frozenset()
    """Of whom a real robot was not sure at some time who they were: nothing is learnt about them."""

    def __repr__(self) -> str:
        name, seconds = self.prepared.file.scenario.name, of_episode(self.metrics)["duration_s"]
        visits = [f"{one.person}: {one.outcome}{_stopped_at(one)}" for one in self.visits]
        more = [f"and {len(visits) - SHOWN} more"] if len(visits) > SHOWN else []
        head = f"<Episode {name}, seed {self.seed}: {self.outcome} after {seconds:.1f} s"
        return "\n  ".join((head, *visits[:SHOWN], *more)) + ">"

    def _repr_html_(self) -> str:
        from comity.recording import page_of

        page = escape(page_of(self))
        return f'<iframe srcdoc="{page}" width="100%" height="{FRAME_PX}" style="border: 0"></iframe>'

    def to_frame(self, table: Table = "frames") -> DataFrame:
        """One of the episode's tables as a pandas DataFrame.

        Args:
            table: `frames`: where everybody was at every control tick; `events`: every change of a node of
                the tree; `readings`: what the robot's sensors told the tree.

        Raises:
            ImportError: if pandas is not installed.
            ValueError: for another table.
        """
        match table:
            case "frames":
                return frames_table(self.frames)
            case "events":
                return events_table(self.events)
            case "readings":
                return readings_table(self.readings)
        raise ValueError(f"expected frames, events or readings, got {table!r}")

    def values_at(self, person: str, t: float) -> Inference:
        """Somebody's parameters at a time [s], as they had been told by then.

        Raises:
            KeyError: if nobody of the scenario is called so.
        """
        return values_at(self.prepared.values, self.told, person, t)

    @property
    def history(self) -> History:
        """The trace, to ask about any moment."""
        return History(self.nodes, self.events)

    @property
    def trace_sha256(self) -> str:
        """The digest of the trace, written out anew whenever it is asked for: equal for equal episodes."""
        return trace_sha256(trace_lines(self.events, self.nodes))

    def why(self, t: float) -> tuple[Why, ...]:
        """Why the tree did at a time [s] what it did: one reason for every action that runs then.

        Raises:
            ValueError: for anything but a time from 0 s on.
        """
        if not isinstance(t, (int, float)) or not 0 <= t < float("inf"):
            raise ValueError(
                f"expected a time from 0 s on, got {t!r}; `comity trace RUN --why NODE` asks of a node"
            )
        return self.history.why_at(t)

    def assert_halted(self, node: str, *, by: str = "") -> None:
        """Hold that a node was halted, and because of what.

        Args:
            node: A part of its name: `utter`.
            by: A part of any link of the chain of causes: `docked?`.

        Raises:
            AssertionError: if it was not; the message lists its halts.
            ValueError: if no node is named.
        """
        if not node:
            raise ValueError("expected a part of the name of a node, got ''")
        halts = [event for event in self.events if node in event.node and event.halt]
        if any(by in cause.text for halt in halts for cause in halt.because):
            return
        found = "; ".join(
            f"t={halt.t:.2f} {halt.node} {halt.halt} because {', '.join(c.text for c in halt.because)}"
            for halt in halts
        )
        raise AssertionError(f"no halt of {node!r} by {by!r}; halts of such nodes: {found or 'none'}")


@dataclass(frozen=True, slots=True)
class Progress:
    """How far an episode is, for whoever waits for it."""

    simulated_s: float
    doing: str


class LiveEpisode:
    """An episode under way: whatever ends it, what happened so far can be read.

    Args:
        prepared: The scenario with its plan.
        seed: For the noise of sensors, where the scenario has any.
        happenings: What happens while it runs, besides the scenario's changes and faults.
        acts: Behaviours of your own in place of the robot's acts, by the act's name (see `Execution`).
        robot: A real robot in the place of the simulated one, on the scenario's map (see `MapRobot`). What
            people say happens at its times; faults, walks, doors and stops are those of the real world.
        planner: Whom to ask when things change, in the place of ours.

    Raises:
        InputError: `acts` names no act that a greeting can have.
        RobotError: The robot cannot be driven.
    """

    def __init__(
        self,
        prepared: Prepared,
        *,
        seed: int = 0,
        happenings: Iterable[Happening] = (),
        acts: Mapping[str, MakeAct] = NO_ACTS,
        robot: MapRobot | None = None,
        planner: Planner | None = None,
    ) -> None:
        _check_acts(prepared, acts)
        self._prepared = prepared
        self._seed = seed
        self._base = robot
        self._world: Environment
        if robot is None:
            self._world = World(
                prepared.scene, seed, route_map=prepared.route_map, places=prepared.asked.places
            )
        else:
            self._world = RealWorld(robot, prepared.scene)
            self._world.robot.learn_places(prepared.asked.places)
        limits = limits_of(prepared.file.scenario.limits, attend_s=prepared.attend_s)
        self._listener = WorldPlanner(prepared, self._world)
        self._planner = FalliblePlanner(self._listener)
        self._guard = Guarding(prepared, self._planner)
        happens = (*prepared.happenings, *happenings)
        self._schedule = Schedule(happens if robot is None else told_only(happens))
        self._heartbeat = stop_of(robot) if robot else None
        self._loop: LoopReport | None = None
        self._execution = Execution(
            prepared.plan,
            self._world.robot,
            prepared.values,
            limits,
            planner=planner or self._planner,
            unserved=prepared.asked.unreachable,
            acts=acts,
            emergency=self._heartbeat.read if self._heartbeat else None,
        )

    def run(self, watch: Callable[[Progress], None] | None = None) -> None:
        """Carry the plan out to its end, or to the scenario's limit.

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

    def _run_simulated(self, world: World, stage: Stage, watch: Callable[[Progress], None] | None) -> None:
        while self._tick(world) == "running" and not self._ends_in_time():
            if watch and world.time_s % 1.0 < 1e-9:
                watch(self._progress())
            world.step()
            self._schedule.step(stage)
        _come_to_rest(world, self._execution)

    def _run_real(self, world: RealWorld, stage: Stage, watch: Callable[[Progress], None] | None) -> None:
        told_s = 0
        self._guard.doubt(world.robot.uncertain)

        def each() -> None:
            nonlocal told_s
            world.observe()
            self._guard.doubt(world.robot.uncertain)
            self._schedule.step(stage)
            self._ends_in_time()
            if watch and world.time_s >= told_s + 1:
                told_s = int(world.time_s)
                watch(self._progress())

        assert self._base is not None
        self._loop = drive(self._execution, self._base, self._heartbeat, each)
        world.observe()

    def _ends_in_time(self) -> bool:
        """Whether the scenario's time is over, which ends the execution."""
        limit_s = self._prepared.file.scenario.limits.time_s
        if self._world.time_s < limit_s:
            return False
        over = f"the scenario's limit of {limit_s:g} s was reached (`time_s` of its limits allows more)"
        self._execution.stop(over, halt="timed_out")
        return True

    def _progress(self) -> Progress:
        return Progress(self._world.time_s, _doing(self._execution))

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
        """Somebody's parameters are others from the next tick on: they said, or one learnt, something.

        Args:
            person: Who.
            values: All their parameters.
            text: What happened, in words, for the trace.

        Raises:
            KeyError: if nobody is called so.
        """
        self._guard.tell(person, values, text)
        now_s = self._world.time_s
        self._schedule.record(Disturbance(now_s, now_s, "message", person, text))

    @property
    def plan(self) -> Plan:
        """The plan under way: the first one, or what came of it."""
        return self._execution.plan

    @property
    def revisions(self) -> tuple[Revision, ...]:
        """What took over from the first plan so far, in order."""
        return self._execution.revisions

    @property
    def door_turns(self) -> tuple[DoorTurn, ...]:
        """Every door that was opened or shut so far, in order."""
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
        """Where everybody was so far, without the first `count` frames."""
        return self._world.frames_since(count)

    @property
    def readings(self) -> ReadingSeries:
        """What the robot's sensors told the tree so far."""
        return self._execution.readings

    @property
    def writes(self) -> tuple[Write, ...]:
        """Every value that an entry of the blackboard got so far."""
        return self._execution.writes

    @property
    def shown(self) -> tuple[Shown, ...]:
        """What people truly showed so far, whether or not the robot noticed."""
        return self._world.shown

    @property
    def disturbances(self) -> tuple[Disturbance, ...]:
        """Changes, faults and messages so far, by time; walks are told once the episode is over."""
        halts = self._world.halts if isinstance(self._world, RealWorld) else ()
        return tuple(sorted((*self._schedule.disturbances, *halts), key=lambda one: one.t))

    def _disturbances(self, frames: Frames) -> tuple[Disturbance, ...]:
        people = (person.name for person in self._prepared.scene.people)
        return tuple(sorted((*self.disturbances, *walks(frames, people)), key=lambda one: one.t))

    def so_far(self) -> Episode:
        """What happened."""
        world, execution = self._world, self._execution
        frames, told = world.frames, self._listener.told
        return Episode(
            prepared=self._prepared,
            seed=self._seed,
            outcome=_outcome(self._prepared, execution),
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
            ),
            nodes=execution.nodes,
            values=execution.values,
            steps=execution.steps,
            revisions=execution.revisions,
            told=told,
            disturbances=self._disturbances(frames),
            readings=execution.readings,
            writes=execution.writes,
            loop=self._loop,
            uncertain=frozenset(self._guard.was_uncertain),
        )


def execute(
    prepared: Prepared,
    *,
    seed: int = 0,
    acts: Mapping[str, MakeAct] = NO_ACTS,
    robot: MapRobot | None = None,
) -> Episode:
    """Carry a plan out.

    Args:
        prepared: The scenario with its plan.
        seed: For the noise of sensors, where the scenario has any.
        acts: Behaviours of your own in place of the robot's acts, by the act's name.
        robot: A real robot in the place of the simulated one.
    """
    live = LiveEpisode(prepared, seed=seed, acts=acts, robot=robot)
    live.run()
    return live.so_far()


def _stopped_at(visit: Visit) -> str:
    return f", at {visit.docked_at.distance_m:.3f} m" if visit.docked_at else ""


def _check_acts(prepared: Prepared, acts: Iterable[str]) -> None:
    gestures = prepared.rulebook.parameters.get("greeting_gesture")
    categories = getattr(gestures, "categories", ())
    known = (UTTER, *(each.name for each in categories if each.name != NO_GESTURE))
    for act in acts:
        if act not in known:
            raise InputError(
                expected=f"an act of a greeting: {', '.join(known)}",
                got=f"acts[{act!r}]",
                remedy="Name one of these, or add the gesture to `greeting_gesture` of the rulebook.",
            )


def fingerprint() -> str:
    """What else the bytes of a trace depend on: interpreter, machine, libraries that compute with floats."""
    from importlib.metadata import version

    libraries = " ".join(f"{name}-{version(name)}" for name in ("numpy", "pymunk", "shapely"))
    return f"{platform.python_implementation()}-{platform.python_version()} {platform.machine()} {libraries}"


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


def _outcome(prepared: Prepared, execution: Execution) -> Outcome:
    """Partial where somebody was greeted and somebody could not be served to the end, or only late."""
    if execution.status == "stop_unconfirmed":
        return execution.status
    fared = {visit.person: visit.outcome for visit in execution.visits}
    wanted = fared.keys() | prepared.asked.unreachable.keys()
    if sum(outcome in ("greeted", "skipped") for outcome in fared.values()) == len(wanted):
        return "partial" if any(late_s(prepared, visit) for visit in execution.visits) else "success"
    if execution.status == "stopped":
        return "stopped"
    return "partial" if any(outcome in ("greeted", "unfinished") for outcome in fared.values()) else "failed"


def _doing(execution: Execution) -> str:
    """The person whose visit goes on, if any."""
    pending = (visit.person for visit in execution.visits if visit.outcome == "pending")
    return next((f"visiting {person}" for person in pending), "done")
