"""The commands need nothing that POSIX alone has: they run with all of it taken away, as on Windows."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path

import pytest
from tiny_domain import PLAN, write_tiny_domain

pytestmark = pytest.mark.integration
BLOCKER = Path(__file__).parent / "without_posix"
SILENT = "ignore:only soft file lock"
"""filelock warns of a Linux without `fcntl`."""
LATE = """
from pathlib import Path
from comity.custom_domain import plan_domain
from comity_domain.custom import process
process.LATEST_S = 0.0
plan_domain(Path("d.pddl"), Path("p.pddl"), time_limit_s=0.001)
"""
Call = Callable[..., subprocess.CompletedProcess[str]]


@pytest.fixture(scope="module")
def call(tmp_path_factory: pytest.TempPathFactory) -> Call:
    """A Python without POSIX, in a folder that holds the run `run`."""
    folder = tmp_path_factory.mktemp("elsewhere")
    own = {name: str(folder / name) for name in ("COMITY_HOME", "COMITY_CACHE")}
    environment = {**os.environ, "PYTHONPATH": str(BLOCKER), "PYTHONWARNINGS": SILENT, **own}

    def call(*words: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [sys.executable, *words],
            cwd=folder,
            env=environment,
            capture_output=True,
            encoding="utf-8",
            check=False,
        )

    write_tiny_domain(folder)
    assert call("-m", "comity", "run", "johanna", "--out", "run").stderr == ""
    return call


def test_what_is_taken_away_is_away(call: Call) -> None:
    assert "import of fcntl halted" in call("-c", "import fcntl").stderr
    methods = (
        "import multiprocessing, os; print(multiprocessing.get_all_start_methods(), hasattr(os, 'fork'))"
    )
    assert "forkserver" not in call("-c", methods).stdout
    assert "False" in call("-c", methods).stdout


@pytest.mark.parametrize(
    "words",
    [
        "plan two-visits",
        "infer german_woman",
        "explain conversational_distance german_woman",
        "scenarios",
        "replay run --gif episode.gif",
        "trace run",
        "trace run --why johanna",
        "test johanna two-visits --profile paper --jobs 2",
        "profile consent amal remember --by us",
        "--version",
    ],
)
def test_a_command_runs(words: str, call: Call) -> None:
    done = call("-m", "comity", *words.split())
    assert done.returncode == 0, done.stderr
    assert done.stdout


@pytest.mark.skipif(find_spec("up_fast_downward") is None, reason="Fast Downward is not installed")
def test_a_domain_of_ones_own_is_planned_and_its_time_is_limited(call: Call) -> None:
    """Fast Downward's driver gets no limits here; the time limit of the process ends it."""
    assert call("-m", "comity", *PLAN).returncode == 0
    assert "no plan was found within 0.001 s" in call("-c", LATE).stderr
