"""Processor time of one simulated second: the world, the tree and the recording of the visit to Johanna."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TypeVar

from comity.live_episode import LiveEpisode
from comity.preparation import PlannedEpisode, prepare
from comity.scenario import load_scenario
from comity_executor import ReadingsFile, TraceFile
from comity_sim2d import FramesFile
from tests.bench.contest import Bench
from tests.bench.rows import Row

ResultT = TypeVar("ResultT")
SCENARIOS = ("johanna", "reception")


def run(bench: Bench) -> list[Row]:
    """Shipped scenarios, planned once and executed anew each round; what the tree and the disk take of it."""
    return [row for name in SCENARIOS[: 1 if bench.quick else None] for row in _rows(name, bench.rounds)]


def _rows(name: str, rounds: int) -> list[Row]:
    prepared = prepare(load_scenario(name))
    turns = [_turn(prepared) for _ in range(rounds)]
    whole = tuple(whole for whole, _, _ in turns)
    speed = f"{1 / sorted(whole)[rounds // 2]:.0f} simulated seconds per processor second"
    parts = {
        "of which tree and trace": tuple(tree for _, tree, _ in turns),
        "of which writing trace, readings, frames": tuple(disk for _, _, disk in turns),
    }
    rows = [
        Row(suite="episode", task=name, contestant="comity", seconds=whole, per="simulated s", note=speed)
    ]
    for part, seconds in parts.items():
        ratios = tuple(own / all_ for own, all_ in zip(seconds, whole, strict=True))
        row = Row(
            suite="episode", task=name, contestant=part, seconds=seconds, per="simulated s", ratios=ratios
        )
        rows.append(row)
    return rows


def _turn(prepared: PlannedEpisode) -> tuple[float, float, float]:
    """Seconds per simulated second: of all, of the tree with its recorder, of writing once a second."""
    stopwatch, disk = Stopwatch(), Stopwatch()
    with (
        TemporaryDirectory() as folder,
        TraceFile(Path(folder) / "trace.jsonl", ()) as trace,
        FramesFile(Path(folder) / "frames.csv") as frames,
        ReadingsFile(Path(folder) / "readings.csv") as readings,
    ):
        start = time.process_time()
        live = LiveEpisode(prepared)
        tick = live._execution.tick
        vars(live._execution)["tick"] = lambda: stopwatch.during(tick)

        def keep(_: object = None) -> None:
            trace.keep(live.events)
            frames.keep(live.frames_since(frames.count))
            readings.keep(live.readings)

        live.run(lambda _: disk.during(keep))
        disk.during(keep)
        whole = time.process_time() - start
    simulated = live.events[-1].t
    return whole / simulated, stopwatch.seconds / simulated, disk.seconds / simulated


class Stopwatch:
    """Adds up the processor time of calls."""

    def __init__(self) -> None:
        self.seconds = 0.0

    def during(self, call: Callable[[], ResultT]) -> ResultT:
        """Call it, and count how long it takes."""
        start = time.process_time()
        result = call()
        self.seconds += time.process_time() - start
        return result
