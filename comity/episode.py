"""One episode: everything that happened, to inspect, measure and explain."""

from __future__ import annotations

import platform
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING, Literal

from comity.answers.run import Disturbance
from comity.data_frames import events_table, frames_table, readings_table
from comity.monitoring.measuring import known_of
from comity.monitoring.parameter_updates import values_at
from comity_executor import (
    History,
    Node,
    NodeExplanation,
    PlanUpdate,
    ReadingSeries,
    TraceEvent,
    Visit,
    Write,
    trace_lines,
    trace_sha256,
)
from comity_sim2d import ActEvent, DoorTurn, Frames, Metrics, of_episode

if TYPE_CHECKING:
    from pandas import DataFrame

    from comity.data_frames import Table
    from comity.monitoring.parameter_updates import ParameterUpdate
    from comity.preparation import PlannedEpisode
    from comity.simulation.manoeuvres import MotionSpan
    from comity_domain import PlanStep
    from comity_executor import LoopReport
    from comity_fis import Inference
    from comity_sim2d.metrics.known import Known

Outcome = Literal["success", "partial", "failed", "stopped", "stop_unconfirmed"]

SHOWN = 8
"""Number of visits in an episode's `repr`."""
FRAME_PX = 720
"""Height of an episode's page in a notebook [px]."""


@dataclass(frozen=True, slots=True, eq=False)
class Episode:
    """Everything that happened in an episode."""

    prepared: PlannedEpisode
    seed: int
    outcome: Outcome
    visits: tuple[Visit, ...]
    events: tuple[TraceEvent, ...]
    frames: Frames
    acts: tuple[ActEvent, ...]
    door_turns: tuple[DoorTurn, ...]
    """All openings and shuttings of doors, in order."""
    metrics: Metrics
    nodes: tuple[Node, ...]
    """The behaviour trees, one for every plan."""
    values: Mapping[str, Inference]
    """Everyone's final parameters."""
    steps: tuple[PlanStep, ...]
    """The steps planned for each person, from the last plan that included them."""
    revisions: tuple[PlanUpdate, ...]
    """All plan updates after the first plan, in order."""
    told: tuple[ParameterUpdate, ...]
    """Requests of people during the episode, in order; each applies from then on."""
    disturbances: tuple[Disturbance, ...]
    """Changes, faults, messages and walks of people, by time: the disturbances that the robot faced."""
    readings: ReadingSeries
    """The sensor readings received by the tree."""
    writes: tuple[Write, ...]
    """Every value written to the blackboard, in order."""
    motion: tuple[MotionSpan, ...] = ()
    """The simulated robot's goals and manoeuvres, in order."""
    loop: LoopReport | None = None
    """How the loop of a real robot kept its rate; None in the simulated world."""
    uncertain: frozenset[str] = frozenset()
    """People whose identity a real robot was unsure of at some time: nothing is learnt about them."""
    page: Callable[[Episode], str] | None = None
    """Makes the HTML page for notebooks; None to show the episode as text."""

    def __repr__(self) -> str:
        name, seconds = self.prepared.file.scenario.name, of_episode(self.metrics)["duration_s"]
        visits = [f"{one.person}: {one.outcome}{_stopped_at(one)}" for one in self.visits]
        more = [f"and {len(visits) - SHOWN} more"] if len(visits) > SHOWN else []
        head = f"<Episode {name}, seed {self.seed}: {self.outcome} after {seconds:.1f} s"
        return "\n  ".join((head, *visits[:SHOWN], *more)) + ">"

    def _repr_html_(self) -> str | None:
        if self.page is None:
            return None
        page = escape(self.page(self))
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
        """A person's parameters at a time [s], given their requests until then.

        Raises:
            KeyError: If there is no such person.
        """
        return values_at(self.prepared.values, self.told, person, t)

    @property
    def known(self) -> Known:
        """People's distances and the times of visits: what metrics need besides the frames."""
        return known_of(self.prepared, self.visits, self.events, revisions=self.revisions, told=self.told)

    @property
    def history(self) -> History:
        """The trace with queries about any moment."""
        return History(self.nodes, self.events)

    @property
    def trace_sha256(self) -> str:
        """The digest of the trace, recomputed at every call: equal for equal episodes."""
        return trace_sha256(trace_lines(self.events, self.nodes))

    def why(self, t: float) -> tuple[NodeExplanation, ...]:
        """Explanations of the tree's behaviour at a time [s], one for every running action.

        Raises:
            ValueError: for anything but a time from 0 s on.
        """
        if not isinstance(t, (int, float)) or not 0 <= t < float("inf"):
            raise ValueError(
                f"expected a time from 0 s on, got {t!r}; `comity trace RUN --why NODE` asks of a node"
            )
        return self.history.why_at(t)

    def assert_halted(self, node: str, *, by: str = "") -> None:
        """Assert that a node was halted, optionally by a given cause.

        Args:
            node: A part of its name: `say`.
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


def _stopped_at(visit: Visit) -> str:
    return f", at {visit.docked_at.distance_m:.3f} m" if visit.docked_at else ""


def fingerprint() -> str:
    """What the bytes of a trace also depend on: interpreter, machine, floating-point libraries."""
    from importlib.metadata import version

    libraries = " ".join(f"{name}-{version(name)}" for name in ("numpy", "pymunk", "shapely"))
    return f"{platform.python_implementation()}-{platform.python_version()} {platform.machine()} {libraries}"
