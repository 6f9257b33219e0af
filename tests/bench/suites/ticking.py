"""A tick with the recorder that makes the trace, against the bare tick of the same tree; and with the disk.

Every leaf reads the world and can account for what it read, as the leaves of a visit do: the recorder asks
those whose result changed. The recorded tree keeps every reading in a series, the bare one forgets it.
"""

from __future__ import annotations

import gc
import random
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

from py_trees.behaviour import Behaviour
from py_trees.common import ParallelPolicy, Status
from py_trees.composites import Parallel, Selector, Sequence

from comity_executor import DEFAULT_LIMITS, ScriptedRobot, TraceFile
from comity_executor.leaves.docking_band import enter_band
from comity_executor.memory.visit import PlannedPose
from comity_executor.nodes.cause import Telling
from comity_executor.nodes.leaf import Action
from comity_executor.nodes.node import describe
from comity_executor.robots.robot import Reading
from comity_executor.robots.senses import Senses
from comity_executor.tracing.recorder import Recorder
from tests.bench.contest import Bench, in_turn
from tests.bench.rows import Row

TICKS = 200_000
"""Ticks times nodes, of one turn."""
PERSON = "johanna"
Read = Callable[[str], Reading | None]


def run(bench: Bench) -> list[Row]:
    """Trees of 10, 100 and 1000 nodes whose leaves change their minds one time in ten."""
    rows: list[Row] = []
    for nodes in (10,) if bench.quick else (10, 100, 1000):
        ticks = max(2, TICKS // nodes // (10 if bench.quick else 1))
        turns: dict[str, Callable[[], float]] = {
            "bare tick_once": partial(_bare, nodes, ticks),
            "comity recorder": partial(_recorded, nodes, ticks),
            "comity recorder and the disk": partial(_streamed, nodes, ticks),
        }
        rows += in_turn(turns, rounds=bench.rounds, suite="ticking", task=f"{nodes} nodes", per="tick")
    return rows


class Leaf(Action):
    """Looks at the person, and keeps its status nine times in ten."""

    def __init__(self, name: str, read: Read, dice: random.Random) -> None:
        super().__init__(name)
        self._read = read
        self._dice = dice
        self._band = enter_band(PlannedPose(1.01, 0.0), DEFAULT_LIMITS)
        self._reading: Reading | None = None

    def step(self) -> Status:
        """The status of this tick."""
        self._reading = self._read(PERSON)
        if self.status != Status.INVALID and self._dice.random() < 0.9:
            return self.status
        return self._dice.choice((Status.RUNNING, Status.SUCCESS, Status.FAILURE))

    def explain(self) -> Telling | None:
        """What was read, as `docked?` says it."""
        return partial(self._band.account, self._reading) if self._reading else None


def _tree(nodes: int, read: Read) -> Behaviour:
    dice = random.Random(nodes)
    branches = [
        (Sequence if i % 2 else Selector)(
            f"branch {i}", False, [Leaf(f"leaf {i}.{j}", read, dice) for j in range(9)]
        )
        for i in range(max(1, nodes // 10))
    ]
    return Parallel("root", ParallelPolicy.SuccessOnAll(False), branches)


def _bare(nodes: int, ticks: int) -> float:
    robot = ScriptedRobot({PERSON: 3.0})
    seen: dict[str, Reading | None] = {}

    def read(person: str) -> Reading | None:
        if person not in seen:
            seen[person] = robot.read(person)
        return seen[person]

    tree = _tree(nodes, read)

    def tick(_: int) -> None:
        seen.clear()
        tree.tick_once()

    return _seconds(tick, ticks)


def _recorded(nodes: int, ticks: int) -> float:
    senses = Senses(ScriptedRobot({PERSON: 3.0}))
    recorder = Recorder(_tree(nodes, senses.read))

    def tick(i: int) -> None:
        senses.begin_tick()
        recorder.tick(i * 0.05)

    return _seconds(tick, ticks)


def _streamed(nodes: int, ticks: int) -> float:
    """Events as text in a file once per simulated second, as a run does it."""
    senses = Senses(ScriptedRobot({PERSON: 3.0}))
    tree = _tree(nodes, senses.read)
    recorder = Recorder(tree)
    with TemporaryDirectory() as folder, TraceFile(Path(folder) / "trace.jsonl", describe(tree)) as file:

        def tick(i: int) -> None:
            senses.begin_tick()
            recorder.tick(i * 0.05)
            if i % 20 == 19:
                file.keep(recorder.events)

        return _seconds(tick, ticks)


def _seconds(tick: Callable[[int], None], ticks: int) -> float:
    """Processor time of one tick; what earlier turns left behind is collected before."""
    gc.collect()
    start = time.process_time()
    for i in range(ticks):
        tick(i)
    return (time.process_time() - start) / ticks
