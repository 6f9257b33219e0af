"""One episode: the plan executed in the world, and what happened."""

from __future__ import annotations

import platform
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from comity_executor import Execution, TraceEvent, Visit
from comity_sim2d import ActEvent, Frames, Metrics, World, measure

if TYPE_CHECKING:
    from comity.preparation import Prepared

Outcome = Literal["success", "partial", "failed", "stopped"]

AFTERMATH_S = 0.5
"""The world goes on for so long after the last act, so that the frames show the robot at rest."""


@dataclass(frozen=True, slots=True)
class Episode:
    """What happened, all of it."""

    prepared: Prepared
    seed: int
    outcome: Outcome
    visits: tuple[Visit, ...]
    events: tuple[TraceEvent, ...]
    trace_lines: tuple[str, ...]
    trace_sha256: str
    frames: Frames
    acts: tuple[ActEvent, ...]
    metrics: Metrics


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
    """

    def __init__(self, prepared: Prepared, *, seed: int = 0) -> None:
        self._prepared = prepared
        self._seed = seed
        self._world = World(prepared.scene, seed, route_map=prepared.route_map)
        self._execution = Execution(prepared.plan, self._world.robot, prepared.values)

    def run(self, watch: Callable[[Progress], None] | None = None) -> None:
        """Carry the plan out to its end, or to the scenario's limit.

        Args:
            watch: Called once per simulated second.
        """
        world, execution = self._world, self._execution
        limit_s = self._prepared.file.scenario.limits.time_s
        while execution.tick() == "running":
            if world.time_s >= limit_s:
                execution.stop(f"the scenario's limit of {limit_s:g} s was reached")
                break
            if watch and world.time_s % 1.0 < 1e-9:
                watch(Progress(world.time_s, _doing(execution)))
            world.step()
        world.run(AFTERMATH_S)

    def so_far(self) -> Episode:
        """What happened."""
        world, execution = self._world, self._execution
        return Episode(
            prepared=self._prepared,
            seed=self._seed,
            outcome=_outcome(self._prepared, execution),
            visits=execution.visits,
            events=execution.events,
            trace_lines=execution.trace_lines(),
            trace_sha256=execution.trace_sha256(),
            frames=world.frames,
            acts=world.events,
            metrics=measure(world.frames, touches=len(world.robot_touches)),
        )


def execute(prepared: Prepared, *, seed: int = 0) -> Episode:
    """Carry a plan out.

    Args:
        prepared: The scenario with its plan.
        seed: For the noise of sensors, where the scenario has any.
    """
    live = LiveEpisode(prepared, seed=seed)
    live.run()
    return live.so_far()


def fingerprint() -> str:
    """What else the bytes of a trace depend on: interpreter, machine, libraries that compute with floats."""
    from importlib.metadata import version

    libraries = " ".join(f"{name}-{version(name)}" for name in ("numpy", "pymunk", "shapely"))
    return f"{platform.python_implementation()}-{platform.python_version()} {platform.machine()} {libraries}"


def _outcome(prepared: Prepared, execution: Execution) -> Outcome:
    greeted = sum(visit.outcome in ("greeted", "skipped") for visit in execution.visits)
    wanted = len(execution.visits) + len(prepared.asked.unreachable)
    if greeted == wanted:
        return "success"
    if execution.status == "stopped":
        return "stopped"
    return "partial" if greeted or prepared.asked.unreachable else "failed"


def _doing(execution: Execution) -> str:
    """The person whose visit goes on, if any."""
    pending = (visit.person for visit in execution.visits if visit.outcome == "pending")
    return next((f"visiting {person}" for person in pending), "done")
