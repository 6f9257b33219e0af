"""Planning engines as they come, on the PDDL that Comity writes: no unified-planning, no reasons."""

from __future__ import annotations

import re
import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.bench.environment import interpreter
from tests.downward import PROOF, driver

LIMIT_S = 60.0


@dataclass(frozen=True, slots=True)
class Run:
    """One run of an engine."""

    seconds: float
    cost: int | None
    """None where it found no plan within `LIMIT_S`."""


Engine = Callable[[str, str], Run]
"""From domain and problem to a run."""


def fast_downward(search: str = PROOF) -> Engine:
    """With a search; the default is the one that proves an optimum of visits."""
    return _with([sys.executable, str(driver())], ["--search", search])


def first_plan() -> Engine:
    """As unified-planning calls Fast Downward unless told otherwise: the first plan that LAMA finds."""
    return _with([sys.executable, str(driver()), "--alias", "lama-first"], [])


def symk() -> Engine:
    """SymK's symbolic bidirectional search, in an environment of its own.

    Raises:
        NotInstalledError: if it cannot be had here.
    """
    python = interpreter("symk")
    script = next(python.parents[1].glob("lib/python*/site-packages/up_symk/symk/fast-downward.py"))
    return _with([str(python), str(script)], ["--search", "sym_bd()"])


def _with(driver: list[str], search: list[str]) -> Engine:
    def run(domain: str, problem: str) -> Run:
        with TemporaryDirectory(prefix="comity-bench-") as name:
            folder = Path(name)
            (folder / "domain.pddl").write_text(domain)
            (folder / "problem.pddl").write_text(problem)
            command = [*driver, "--plan-file", "plan", "domain.pddl", "problem.pddl", *search]
            start = time.perf_counter()
            with suppress(subprocess.TimeoutExpired):
                subprocess.run(command, cwd=folder, timeout=LIMIT_S, capture_output=True, check=False)
            seconds = time.perf_counter() - start
            texts = [file.read_text() for file in folder.glob("plan*")]
        costs = [int(found[1]) for text in texts if (found := re.search(r"; cost = (\d+)", text))]
        return Run(seconds, min(costs, default=None))

    return run
