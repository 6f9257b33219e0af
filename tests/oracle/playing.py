"""Play the oracle's scenarios, in as many processes as there are cores."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from datetime import date
from pathlib import Path

from comity.preparation import prepare
from comity.recording import record
from comity.scenario import load_scenario
from comity.specification.matrix import PAPER
from comity_fis import ComityError
from tests.oracle.line import Line, failed, line_of

SCENARIOS = Path(__file__).parent / "scenarios"
DAY = date(2026, 1, 1)
"""On which facts with dates are taken where a scenario names no day."""


def play(only: str = "") -> Iterator[Line]:
    """Play the scenarios whose names contain a word, in alphabetical order, for the four profiles each."""
    paths = [path for path in sorted(SCENARIOS.glob("*.yaml")) if only in path.name]
    with (
        tempfile.TemporaryDirectory() as store,
        ProcessPoolExecutor(initializer=_use_store, initargs=(store,)) as processes,
    ):
        for lines in processes.map(_lines_of, paths):
            yield from lines


def _use_store(folder: str) -> None:
    """Keep the profiles that a developer has stored out of the episodes."""
    os.environ["COMITY_HOME"] = folder


def _lines_of(path: Path) -> list[Line]:
    return [_line(path, profile) for profile in PAPER]


def _line(path: Path, profile: str) -> Line:
    file = load_scenario(str(path))
    case = f"{file.scenario.name}[{profile}]"
    people = file.scenario.matrix.people or (file.scenario.goals[0].person,)
    with tempfile.TemporaryDirectory() as folder:
        try:
            prepared = prepare(file, profiles=dict.fromkeys(people, profile), at=file.scenario.at or DAY)
            record(prepared, out=Path(folder), views=())
        except ComityError as error:
            return failed(case, error)
        run, plan = (
            json.loads((Path(folder) / name).read_text("utf-8")) for name in ("run.json", "plan.json")
        )
    return line_of(case, run, plan)
