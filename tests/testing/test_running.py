"""`comity test` calls pytest with a configuration of its own, and leaves everything else as it was."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from functools import partial
from pathlib import Path

import pytest

from comity.system.garbage import MANY

MATRIX = "matrix: {profiles: [arab_woman, german_man]}\n"


@pytest.fixture
def comity(comity):
    """`comity test` in the folder of a scenario."""
    return partial(comity, "test", "--failed", "")


def passed(told: str) -> list[str]:
    return [one["id"] for one in json.loads(told)["tests"] if one["status"] == "passed"]


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_what_pytest_is_set_to_in_the_folder_changes_nothing(jobs, comity, write, tmp_path, monkeypatch):
    """Options, hooks and tests of Python, and packages that are called as those that run."""
    write(more=MATRIX)
    write(more=MATRIX, name="other.scenario.yaml", room=lambda room: room.replace("two-in", "three-in"))
    (tmp_path / "pytest.ini").write_text("[pytest]\naddopts = --no-such-option\nnorecursedirs = *\n")
    (tmp_path / "conftest.py").write_text("raise SystemExit('somebody else is asked')\n")
    (tmp_path / "test_own.py").write_text("def test_own():\n    assert False\n")
    (tmp_path / "test_own.txt").write_text(">>> 1\n2\n")
    for name in ("comity", "pytest", "xdist", "execnet"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").write_text("raise SystemExit('somebody else is called so, too')\n")
    monkeypatch.setenv("PYTEST_ADDOPTS", "--no-such-option")
    monkeypatch.setenv("PYTEST_PLUGINS", "no_such_plugin")
    done = comity("--json", "--jobs", jobs)
    assert (done.code, done.err, len(passed(done.out))) == (0, "", 4)
    assert os.environ["PYTEST_ADDOPTS"] == "--no-such-option"


def test_the_folder_is_left_as_it_was(comity, write, tmp_path):
    """What pytest keeps for the next time is elsewhere."""
    path = write(more=MATRIX)
    assert comity().code == 0
    assert list(tmp_path.iterdir()) == [path]


def test_options_of_pytest_follow_after_two_dashes(comity, write, tmp_path):
    write("duration at most 7 s, for german_man", more=MATRIX)
    assert "2 tests: 1 passed, 1 failed" in comity().out
    told = comity(".", "--", "--lf", "--junitxml", "report.xml").out
    assert "1 test: 0 passed, 1 failed" in told
    assert 'tests="1"' in (tmp_path / "report.xml").read_text()


def test_all_tests_of_a_file_are_carried_out_by_one_process_that_collects_garbage_seldom(write, tmp_path):
    for n in range(4):
        write(more="matrix: {seeds: [0, 1, 2]}\n", name=f"{n}.scenario.yaml")
    # The report for machines has no worker, and pytest's own plugins may look on.
    (tmp_path / "watching.py").write_text(
        "import gc, os\n"
        "def pytest_runtest_call(item):\n"
        "    with open(f'{os.getpid()}.seen', 'a') as file:\n"
        "        file.write(f'{item.path.name} {gc.get_threshold()[0]}\\n')\n"
    )
    command = [sys.executable, "-m", "comity", "test", "--jobs", "2", "--", "-p", "watching"]
    environment = {**os.environ, "PYTHONPATH": str(tmp_path)}
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    assert "12 tests: 12 passed" in done.stdout
    seen = [
        {tuple(line.split()) for line in path.read_text().splitlines()} for path in tmp_path.glob("*.seen")
    ]
    assert len(seen) == 2
    assert not seen[0] & seen[1]
    assert {threshold for lines in seen for _, threshold in lines} == {str(MANY)}


def test_a_file_that_must_fail_is_told_as_that(comity, write):
    """It is pytest that expects it, of cases; a comparison of them may hold."""
    marked = f"{MATRIX}markers: {{xfail: the robot is not that fast}}\n"
    write("duration at most 1 s", "same for all: outcome", more=marked)
    told = json.loads(comity("--json").out)
    assert [one["status"] for one in told["tests"]] == ["xfailed", "xfailed", "passed"]
    assert "duration at most 1 s" in told["tests"][0]["text"]
    write("duration at most 60 s", more=marked)
    done = comity("--json")
    assert done.code == 1
    assert {(one["status"], one["text"]) for one in json.loads(done.out)["tests"]} == {
        ("xpassed", "[XPASS(strict)] the robot is not that fast")
    }


def test_a_folder_that_may_not_be_looked_into_is_refused_and_the_others_are_tested(
    comity, write, tmp_path, monkeypatch
):
    """As root may look into all, the refusal is the system's in its place."""
    write()
    (tmp_path / "locked").mkdir()
    scan = os.scandir

    def refusing(folder):
        if Path(folder).name == "locked":
            raise PermissionError(13, "Permission denied", str(folder))
        return scan(folder)

    monkeypatch.setattr(os, "scandir", refusing)
    told = json.loads(comity("--json", "--jobs", "1").out)
    assert (told["passed"], told["refused"]) == (1, 1)
    (refused,) = (one for one in told["tests"] if one["status"] == "refused")
    assert "Permission denied" in refused["text"]


def test_a_defect_of_comity_fails_one_test_with_a_traceback(comity, write, monkeypatch):
    from comity.testing.runner import result

    honest = result.judged

    def judged(claim, **others):
        if "german" in claim.id:
            raise ZeroDivisionError("a defect")
        return honest(claim, **others)

    write(more=MATRIX)
    monkeypatch.setattr(result, "judged", judged)
    done = comity("--jobs", "1")
    assert done.code == 1
    assert "2 tests: 1 passed, 1 failed" in done.out
    assert "ZeroDivisionError: a defect" in done.out


def test_pytest_is_not_imported_before_there_is_something_to_test():
    code = (
        "import sys; from comity.__main__ import main; sys.argv = ['comity', 'test', '--help']\n"
        "try: main()\n"
        "finally: print([name for name in sys.modules if name.startswith(('pytest', '_pytest', 'xdist'))])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.stdout.splitlines()[-1] == "[]"
