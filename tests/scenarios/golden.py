"""How the robot moves today: numbers that nobody asked for, but that must not change unnoticed.

`golden.jsonl` has a line for the sampled case of each scenario, and `make golden` writes it again: a commit
that means to change the motion says so, and keeps the new lines.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from comity.episode import Episode, fingerprint
from comity.testing.trials.attempt import attempted
from tests.scenarios.every import SCENARIOS, sample_of

FILE = Path(__file__).with_name("golden.jsonl")
TOLERANCES = {
    "path_length_m": 0.05,
    "duration_s": 0.2,
    "stalled_s": 0.2,
    "heading_change_rad": 0.1,
    "min_clearance_m": 0.02,
    "plan_cost_m": 0.01,
}
"""How far each number may be off: nobody would notice less (our choice)."""
Values = Mapping[str, float]


def values_of(trial: Episode) -> Values:
    """The numbers of one episode, in hundredths."""
    metrics = {name: getattr(trial.metrics, name, None) for name in TOLERANCES}
    metrics["plan_cost_m"] = trial.prepared.plan.cost / 100.0
    return {name: round(value, 2) for name, value in metrics.items() if value is not None}


def moved(golden: Values, now: Values) -> dict[str, tuple[float | None, float | None]]:
    """The numbers that differ by more than they may, before and now."""
    return {
        name: (golden.get(name), now.get(name))
        for name, tolerance in TOLERANCES.items()
        if (name in golden) != (name in now)
        or (name in golden and abs(golden[name] - now[name]) > tolerance + 1e-9)
    }


def read() -> tuple[str, dict[str, Values]]:
    """The fingerprint of the machine that the numbers are of, and the numbers by scenario."""
    head, *lines = [json.loads(line) for line in FILE.read_text(encoding="utf-8").splitlines()]
    return head["fingerprint"], {line.pop("scenario"): line for line in lines}


def main() -> None:
    """Play one case of every scenario, and write what came of it."""
    with ProcessPoolExecutor(len(os.sched_getaffinity(0))) as processes:
        lines = list(processes.map(_line, SCENARIOS))
    FILE.write_text("".join(_written(lines)), encoding="utf-8", newline="\n")


def _line(name: str) -> dict[str, object]:
    claim = sample_of(name)
    return {"scenario": name, "case": claim.id, **values_of(attempted(claim.case))}


def _written(lines: list[dict[str, object]]) -> Iterator[str]:
    for line in ({"fingerprint": fingerprint()}, *lines):
        yield json.dumps(line, ensure_ascii=False) + "\n"


if __name__ == "__main__":
    main()
