"""A tick with the recorder that makes the trace, against the bare tick of the same tree."""

from __future__ import annotations

import random
import time
from collections.abc import Callable

from py_trees.behaviour import Behaviour
from py_trees.common import ParallelPolicy, Status
from py_trees.composites import Parallel, Selector, Sequence

from comity_executor.recorder import Recorder
from tests.bench.contest import Bench, in_turn
from tests.bench.rows import Row

TICKS = 20_000
"""Ticks times nodes, of one turn."""


def run(bench: Bench) -> list[Row]:
    """Trees of 10, 100 and 1000 nodes whose leaves change their minds one time in ten."""
    rows: list[Row] = []
    for nodes in (10,) if bench.quick else (10, 100, 1000):
        ticks = max(2, TICKS // nodes // (10 if bench.quick else 1))
        turns: dict[str, Callable[[], float]] = {
            "bare tick_once": lambda n=nodes, t=ticks: _bare(n, t),
            "comity recorder": lambda n=nodes, t=ticks: _recorded(n, t),
        }
        rows += in_turn(turns, rounds=bench.rounds, suite="ticking", task=f"{nodes} nodes", per="tick")
    return rows


class Leaf(Behaviour):
    """Keeps its status nine times in ten."""

    def __init__(self, name: str, dice: random.Random) -> None:
        super().__init__(name)
        self.dice = dice

    def update(self) -> Status:
        """The status of this tick."""
        if self.status != Status.INVALID and self.dice.random() < 0.9:
            return self.status
        return self.dice.choice((Status.RUNNING, Status.SUCCESS, Status.FAILURE))


def _tree(nodes: int) -> Behaviour:
    dice = random.Random(nodes)
    branches = [
        (Sequence if i % 2 else Selector)(
            f"branch {i}", False, [Leaf(f"leaf {i}.{j}", dice) for j in range(9)]
        )
        for i in range(max(1, nodes // 10))
    ]
    return Parallel("root", ParallelPolicy.SuccessOnAll(False), branches)


def _bare(nodes: int, ticks: int) -> float:
    tree = _tree(nodes)
    start = time.process_time()
    for _ in range(ticks):
        tree.tick_once()
    return (time.process_time() - start) / ticks


def _recorded(nodes: int, ticks: int) -> float:
    recorder = Recorder(_tree(nodes))
    start = time.process_time()
    for i in range(ticks):
        recorder.tick(i * 0.05)
    return (time.process_time() - start) / ticks
