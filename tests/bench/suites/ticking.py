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
from py_trees.decorators import FailureIsRunning
from py_trees.trees import BehaviourTree

from comity_executor import DEFAULT_LIMITS, ScriptedRobot, TraceFile
from comity_executor.leaves.docking_band import enter_band
from comity_executor.memory.visit import PlannedPose
from comity_executor.nodes.cause import Account
from comity_executor.nodes.leaf import Action, Condition
from comity_executor.robots.robot import Reading
from comity_executor.robots.senses import Senses
from comity_executor.tracing.recorder import Recorder
from tests.bench.contest import Bench, in_turn
from tests.bench.rows import Row

TICKS = 200_000
"""Ticks times nodes, of one turn."""
NODES = 13
"""Of a visit's block."""
SELDOM, OFTEN = 0.005, 0.1
"""The share of ticks in which a leaf comes to something else: as in a visit, and far more often."""
PERSON = "johanna"
Read = Callable[[str], Reading | None]


def run(bench: Bench) -> list[Row]:
    """Trees of 1, 8 and 80 visits at once; a leaf changes its mind as seldom as in a visit, and often."""
    rows: list[Row] = []
    for blocks in (1,) if bench.quick else (1, 8, 80):
        for changes in (SELDOM, OFTEN):
            ticks = max(2, TICKS // (blocks * NODES) // (10 if bench.quick else 1))
            turns: dict[str, Callable[[], float]] = {
                "bare tick_once": partial(_bare, blocks, changes, ticks),
                "comity recorder": partial(_recorded, blocks, changes, ticks),
                "comity recorder and the disk": partial(_streamed, blocks, changes, ticks),
            }
            task = f"{blocks * NODES + 1} nodes, changes {changes:g}"
            rows += in_turn(turns, rounds=bench.rounds, suite="ticking", task=task, per="tick")
    return rows


class Look:
    """A reading in every tick, and a change in some."""

    def __init__(self, read: Read, dice: random.Random, changes: float) -> None:
        self._read, self._dice, self._share = read, dice, changes
        self._band = enter_band(PlannedPose(1.01, 0.0), DEFAULT_LIMITS)
        self._reading: Reading | None = None

    def changes(self) -> bool:
        """Whether this is a tick with a change."""
        self._reading = self._read(PERSON)
        return self._dice.random() < self._share

    def account(self) -> Account | None:
        """What was read, as `docked?` says it."""
        return self._band.account(self._reading) if self._reading else None


class Question(Condition):
    """Looks at the person; the answer changes now and then."""

    def __init__(self, name: str, look: Look, *, answer: bool) -> None:
        super().__init__(name)
        self._look, self._answer = look, answer

    def check(self) -> bool:
        """The answer of this tick."""
        self._answer ^= self._look.changes()
        return self._answer

    def explain(self) -> Account | None:
        """What was read."""
        return self._look.account()


class Work(Action):
    """Looks at the person, and goes on; now and then it is done."""

    def __init__(self, name: str, look: Look) -> None:
        super().__init__(name)
        self._look = look

    def step(self) -> Status:
        """The status of this tick."""
        return Status.SUCCESS if self._look.changes() else Status.RUNNING

    def explain(self) -> Account | None:
        """What was read."""
        return self._look.account()


def _tree(blocks: int, read: Read, changes: float) -> Behaviour:
    dice = random.Random(blocks)
    look = partial(Look, read, dice, changes)
    return Parallel("root", ParallelPolicy.SuccessOnAll(False), [_block(look) for _ in range(blocks)])


def _block(look: Callable[[], Look]) -> Behaviour:
    """What greets a person in a visit's tree: 12 nodes, of which it ticks 11."""

    def act() -> Behaviour:
        return Selector("done", False, [Question("done?", look(), answer=False), Work("act", look())])

    greet = Parallel("greet", ParallelPolicy.SuccessOnAll(False), [Work("keep", look()), act(), act()])
    achieve = Sequence("achieve", False, [Question("docked?", look(), answer=True), greet])
    visited = Selector("visited", False, [Question("greeted?", look(), answer=False), achieve])
    return FailureIsRunning("visit", visited)


def _bare(blocks: int, changes: float, ticks: int) -> float:
    robot = ScriptedRobot({PERSON: 3.0})
    seen: dict[str, Reading | None] = {}

    def read(person: str) -> Reading | None:
        if person not in seen:
            seen[person] = robot.read(person)
        return seen[person]

    tree = _tree(blocks, read, changes)

    def tick(_: int) -> None:
        seen.clear()
        tree.tick_once()

    return _seconds(tick, ticks)


def _recorded(blocks: int, changes: float, ticks: int) -> float:
    tree, senses, _ = _observed(blocks, changes)

    def tick(_: int) -> None:
        senses.begin_tick()
        tree.tick()

    return _seconds(tick, ticks)


def _observed(blocks: int, changes: float) -> tuple[BehaviourTree, Senses, Recorder]:
    senses = Senses(ScriptedRobot({PERSON: 3.0}))
    tree, recorder = BehaviourTree(_tree(blocks, senses.read, changes)), Recorder(senses.now_s)
    recorder.watch(tree.root)
    tree.add_visitor(recorder)
    return tree, senses, recorder


def _streamed(blocks: int, changes: float, ticks: int) -> float:
    """Events as text in a file once per simulated second, as a run does it."""
    tree, senses, recorder = _observed(blocks, changes)
    with TemporaryDirectory() as folder, TraceFile(Path(folder) / "trace.jsonl", recorder.nodes) as file:

        def tick(i: int) -> None:
            senses.begin_tick()
            tree.tick()
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
