"""However planning ends, it says so with 1 or 2, and nothing stays: no process, no temporary file."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

BITS = 26


def counter() -> tuple[str, str]:
    """Counting to 2^26 in binary: one way only, and nothing that could shorten it."""
    actions = []
    for bit in range(BITS):
        lower = range(bit)
        needs = " ".join([f"(not (on b{bit}))", *(f"(on b{i})" for i in lower)])
        makes = " ".join([f"(on b{bit})", *(f"(not (on b{i}))" for i in lower)])
        actions.append(
            f"(:action carry-{bit} :parameters () :precondition (and {needs}) :effect (and {makes}))"
        )
    bits = " ".join(f"b{i}" for i in range(BITS))
    domain = f"(define (domain counter) (:constants {bits}) (:predicates (on ?b)) {' '.join(actions)})"
    goal = " ".join(f"(on b{i})" for i in range(BITS))
    return domain, f"(define (problem all) (:domain counter) (:init) (:goal (and {goal})))"


@pytest.fixture
def files(tmp_path):
    """The endless problem, and an empty folder for temporary files."""
    domain, problem = counter()
    (tmp_path / "d.pddl").write_text(domain)
    (tmp_path / "p.pddl").write_text(problem)
    (tmp_path / "temporary").mkdir()
    return tmp_path


def start(files: Path, *words: str) -> subprocess.Popen[str]:
    """`comity plan` on it, in a process of its own."""
    command = [sys.executable, "-m", "comity", "plan", "--domain", "d.pddl", "--problem", "p.pddl", *words]
    environment = {
        **os.environ,
        "TMPDIR": str(files / "temporary"),
        "PYTHONPATH": os.pathsep.join(map(os.path.abspath, filter(None, sys.path))),
    }
    return subprocess.Popen(command, cwd=files, env=environment, stderr=subprocess.PIPE, text=True)


def working_in(files: Path) -> dict[int, str]:
    """Processes in the temporary folder, with what they run."""
    found = {}
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            if str(files / "temporary") in str((entry / "cwd").readlink()):
                found[int(entry.name)] = (entry / "cmdline").read_text().replace("\0", " ")
        except OSError:
            continue
    return found


def search_of(files: Path) -> int:
    """The process that searches, once it does."""
    for _ in range(600):
        for pid, command in working_in(files).items():
            if "bin/downward" in command:
                return pid
        time.sleep(0.1)
    raise AssertionError("the search never began")


def gone(files: Path) -> bool:
    for _ in range(100):
        if not working_in(files) and not list((files / "temporary").iterdir()):
            return True
        time.sleep(0.05)
    return False


needs_proc = pytest.mark.skipif(not Path("/proc/self/cwd").exists(), reason="looks processes up in /proc")


@needs_proc
@pytest.mark.parametrize(
    ("victim", "sent", "code", "words"),
    [
        ("search", signal.SIGKILL, 1, "killed from outside"),
        ("comity", signal.SIGTERM, 143, ""),
        ("comity", signal.SIGKILL, -signal.SIGKILL, ""),
    ],
)
def test_whoever_is_killed_nothing_is_left_behind(files, victim, sent, code, words):
    process = start(files)
    search = search_of(files)
    os.kill(search if victim == "search" else process.pid, sent)
    _, said = process.communicate(timeout=60)
    assert process.returncode == code, said
    assert words in said
    assert "Traceback" not in said
    assert gone(files)


@needs_proc
def test_over_its_time_it_ends_with_1_and_leaves_nothing(files):
    process = start(files, "--limit", "2")
    _, said = process.communicate(timeout=60)
    assert process.returncode == 1
    assert "no plan was found within 2 s" in said
    assert gone(files)
