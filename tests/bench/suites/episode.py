"""Processor time of one simulated second: the world, the tree and the recording of the visit to Johanna."""

from __future__ import annotations

import time

from tests.bench.contest import Bench
from tests.bench.rows import Row


def run(bench: Bench) -> list[Row]:
    """The shipped scenario, planned once and executed anew each round."""
    try:
        from comity.episode import execute
        from comity.preparation import prepare
        from comity.scenario import load_scenario
    except ImportError as error:
        return [Row(suite="episode", task="johanna", contestant="comity", note=str(error))]
    prepared = prepare(load_scenario("johanna"))
    seconds: list[float] = []
    simulated = 0.0
    for _ in range(bench.rounds):
        start = time.process_time()
        episode = execute(prepared)
        cost = time.process_time() - start
        simulated = episode.events[-1].t
        seconds.append(cost / simulated)
    note = f"{1 / sorted(seconds)[len(seconds) // 2]:.0f} simulated seconds per processor second"
    return [
        Row(
            suite="episode",
            task=f"johanna, {simulated:.1f} s",
            contestant="comity",
            seconds=tuple(seconds),
            per="simulated s",
            note=note,
        )
    ]
