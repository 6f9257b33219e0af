"""Fast Downward as a process: its limits, what it leaves behind, and how it says that it is missing."""

from __future__ import annotations

import os
import sys
import tempfile
import time
from pathlib import Path

import pytest
from downward import PROOF, needs_fast_downward

from comity_domain import PlanningFailed
from comity_domain.custom.engines import fast_downward, process
from comity_domain.custom.engines.fast_downward import ground_actions, search

HANGING_ENGINE = """
import os, pathlib, subprocess, sys, time
child = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(600)"])
visit = "(reach_user robot_1 {{0}} front {{1}})\\n(greet_person robot_1 {{0}} verbal none after_0 after_0)\\n"
visits = visit.format("{{0}}", "start here") + visit.format("{{1}}", "{{0}} front")
plan = visits + "; cost = {{2}} (general cost)"
pathlib.Path("plan.1").write_text(plan.format("ada", "bob", 900))
pathlib.Path("plan.2").write_text(plan.format("bob", "ada", 730))
pathlib.Path("plan.3").write_text("(reach_user robot_1 ad")
pathlib.Path({report!r}).write_text(f"{{os.getpid()}} {{child.pid}} {{os.getcwd()}}")
time.sleep(600)
"""
"""An engine that found two plans, was writing a third, started a process of its own, and hangs."""


@pytest.fixture
def temporary(tmp_path, monkeypatch):
    """An empty folder for temporary files, to see what stays."""
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    return folder


KILLS_GUARD = """
import os, pathlib, signal, sys
for entry in pathlib.Path("/proc").glob("[0-9]*"):
    try:
        words, status = (entry / "cmdline").read_bytes().split(b"\\0"), (entry / "stat").read_text()
    except OSError:
        continue
    if b"comity-guard" in words and status.rpartition(")")[2].split()[1] == sys.argv[1]:
        os.kill(int(entry.name), signal.SIGKILL)
print("solved")
"""
"""An engine that lives on while what watches over it is killed."""


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="looks processes up in /proc")
def test_a_guard_that_is_killed_costs_no_plan(tmp_path):
    """Somebody else kills processes; the pipe to this one breaks, and nothing else does."""
    command = [sys.executable, "-c", KILLS_GUARD, str(os.getpid())]
    assert process.run_limited(command, tmp_path, 60.0) == (0, "solved\n")


def is_alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    status = Path(f"/proc/{pid}/stat")
    return not (status.exists() and status.read_text().split(")")[-1].split()[0] == "Z")


def wait_for(condition, patience_s: float = 5.0) -> None:
    """A killed grandchild is gone once the system has reaped it."""
    deadline = time.monotonic() + patience_s
    while not condition() and time.monotonic() < deadline:
        time.sleep(0.01)
    assert condition()


@pytest.fixture
def hanging(tmp_path, monkeypatch):
    """Where the hanging engine reports its processes and its folder."""
    report, driver = tmp_path / "report", tmp_path / "driver.py"
    driver.write_text(HANGING_ENGINE.format(report=str(report)))
    monkeypatch.setattr(fast_downward, "driver", lambda: driver)
    return report


def test_a_cut_off_search_gives_its_best_plan_and_leaves_nothing(hanging, temporary):
    """All of the engine ends with the limit; its cheapest plan proves nothing."""
    found = search("", "", time_limit_s=3.0, search_for=PROOF)
    assert [words[2] for words in ground_actions(found.text) if words[0] == "reach_user"] == ["bob", "ada"]
    assert not found.finished
    parent, child, folder = hanging.read_text().split()
    assert not is_alive(int(parent))
    wait_for(lambda: not is_alive(int(child)))
    assert not Path(folder).exists()
    assert list(temporary.iterdir()) == []


def test_an_interrupted_search_leaves_nothing(hanging, temporary, monkeypatch):
    def interrupt(_, **__):
        wait_for(lambda: hanging.exists() and len(hanging.read_text().split()) == 3)
        monkeypatch.undo()
        raise KeyboardInterrupt

    monkeypatch.setattr(process.Popen, "communicate", interrupt)
    with pytest.raises(KeyboardInterrupt):
        search("", "", time_limit_s=60.0, search_for=PROOF)
    parent, child, folder = hanging.read_text().split()
    assert not is_alive(int(parent))
    wait_for(lambda: not is_alive(int(child)))
    assert not Path(folder).exists()


def test_a_missing_engine_is_named_with_the_extra_that_brings_it(monkeypatch):
    monkeypatch.setattr(fast_downward, "find_spec", lambda _: None)
    with pytest.raises(PlanningFailed, match=r"not installed.*pip install 'comity\[fast-downward\]'"):
        search("", "", time_limit_s=1.0, search_for=PROOF)


@needs_fast_downward
def test_a_broken_problem_shows_what_the_engine_said():
    with pytest.raises(PlanningFailed, match="exit code 31"):
        search("(define (domain d))", "(nonsense)", time_limit_s=30.0, search_for=PROOF)
