"""Eight hours of a real robot at 20 Hz: what a tick costs, and what memory and the run folder grow by.

The robot follows a person who walks on and on, which is as much as an episode can ask of a tick. A study:
`make studies`; `docs/reference/benchmarks.md` has its figures.
"""

from __future__ import annotations

import math
import resource
import time

import numpy as np
import pytest
from gliding import Gliding, written

from comity.live.start import as_seen
from comity.preparation import prepare
from comity.recording import record
from comity.scenario import load_scenario
from comity_executor import read_trace
from comity_executor.tracing.file import parts_of

HOURS = 8.0
SCENARIO = """schema_version: 1
name: long
adults_only: true
place: {width_m: 12, height_m: 8}
robot: {at_m: [1, 1]}
people:
  anna: {at_m: [8, 4], profile: arab_woman}
goals:
  - greet: anna
limits: {time_s: SECONDS, patience_s: SECONDS, reach_s: 3600, blocked_s: 600, replans: 100}
"""


class Following(Gliding):
    """Anna walks in a circle, once in a minute; what a tick cost is known when the next one is waited for."""

    def begin(self) -> None:
        self.costs_s: list[float] = []
        self.kilobytes: list[int] = []
        self._cpu_s = time.process_time()

    def sleep(self, seconds: float) -> None:
        self.costs_s.append(time.process_time() - self._cpu_s)
        if len(self.costs_s) % 72_000 == 1:  # an hour
            self.kilobytes.append(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
        super().sleep(seconds)
        angle = 2.0 * math.pi * (self.t - 100.0) / 60.0
        self.people["anna"] = (
            8.0 + 2.0 * math.cos(angle),
            4.0 + 2.0 * math.sin(angle),
            math.degrees(angle) + 90.0,
        )
        self.velocity["anna"] = (-0.21 * math.sin(angle), 0.21 * math.cos(angle))
        self._cpu_s = time.process_time()


@pytest.mark.parametrize("hours", [0.05, pytest.param(HOURS, marks=pytest.mark.study)])
def test_ticks_stay_cheap_memory_is_bounded_and_the_trace_can_be_read(here, hours):
    file = load_scenario(written(here, SCENARIO.replace("SECONDS", f"{hours * 3600:g}")))
    robot = Following({"anna": (10.0, 4.0, 90.0)}, keeps_log=False)
    robot.begin()
    prepared = prepare(as_seen(file, robot))
    recorded = record(prepared, out=here / "own", views=(), robot=robot)
    ticks = len(robot.costs_s)
    assert ticks >= hours * 72_000 - 40
    frames = (here / "own" / "frames.csv").stat().st_size
    trace = sum(part.stat().st_size for part in parts_of(here / "own" / "trace.jsonl"))
    costs_ms = 1e3 * np.array(robot.costs_s)
    report(ticks, costs_ms, robot.kilobytes, frames + trace)
    assert len(read_trace(here / "own" / "trace.jsonl")) == len(recorded.episode.events)
    # A frame and a reading are 8 numbers or so each; an hour has 72,000 of both.
    grown = np.diff(robot.kilobytes[1:])
    assert (grown <= 40_000).all()


def report(ticks: int, costs_ms: np.ndarray, kilobytes: list[int], on_disk: int) -> None:
    """The figures of the study; pytest shows them with -s."""
    share = 100.0 * float((costs_ms < 100.0).mean())
    median, most, longest = np.quantile(costs_ms, [0.5, 0.999, 1.0])
    print(f"\n{ticks} ticks, {share:.3f} % under 100 ms of CPU")
    print(f"median {median:.2f} ms, 99.9 % up to {most:.2f} ms, the longest {longest:.0f} ms")
    print(f"memory after each hour: {', '.join(f'{each / 1000:.0f}' for each in kilobytes)} MB")
    print(f"trace and frames: {on_disk / 1e6:.1f} MB")
