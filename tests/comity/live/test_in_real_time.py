"""A robot in real time is brought to rest by Ctrl-C and SIGTERM, and its run folder is whole."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

TESTS = Path(__file__).parents[2]
ROBOT = '''
import os, threading, time
from gliding import Gliding

class Real:
    """The gliding robot, stepped by a thread of its own in real time."""

    def __init__(self):
        self._robot = Gliding({"johanna": (4.0, 3.0, 180.0)}, t=time.monotonic())
        self._moves = os.path.abspath("moves.txt")  # the thread outlives the test, and its folder
        threading.Thread(target=self._live, daemon=True).start()

    def _live(self):
        while True:
            time.sleep(0.02)
            self._robot.sleep(time.monotonic() - self._robot.t)
            with open(self._moves, "a") as file:
                file.write(f"{self._robot._speed}\\n")

    def __getattr__(self, name):
        if name == "sleep":
            raise AttributeError(name)
        return getattr(self._robot, name)
'''


NOW = """

    def now_s(self):
        return time.monotonic()
"""


@pytest.mark.integration
@pytest.mark.parametrize("which", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_brings_the_base_to_rest_and_the_run_folder_is_whole(here, which):
    (here / "real_robot.py").write_text(ROBOT, encoding="utf-8")
    options = ["--robot", "real_robot:Real", "--adults-only", "--out", "own", "--json"]
    command = [sys.executable, "-m", "comity", "run", "johanna", *options]
    paths = os.pathsep.join((str(TESTS), os.environ.get("PYTHONPATH", "")))
    process = subprocess.Popen(command, stdout=subprocess.PIPE, env={**os.environ, "PYTHONPATH": paths})
    ends_s = time.monotonic() + 60
    while not is_moving(here) and time.monotonic() < ends_s:
        time.sleep(0.1)
    time.sleep(1.0)
    process.send_signal(which)
    out, _ = process.communicate(timeout=60)
    answer = json.loads(out)
    assert process.returncode == 1
    assert (answer["status"], answer["outcome"]) == ("done", "stopped")
    assert answer["loop"]["interrupted_by"] == which.name
    assert "replay.html" in answer["files"]
    speeds = [float(line) for line in (here / "moves.txt").read_text(encoding="utf-8").split()]
    assert max(speeds) > 0.0
    assert speeds[-1] == 0.0


@pytest.mark.integration
def test_a_whole_visit_by_a_clock_that_never_stands_still_is_recorded(here, comity, monkeypatch):
    monkeypatch.syspath_prepend(str(here))
    text = ROBOT.replace("return getattr(self._robot, name)", "return getattr(self._robot, name)" + NOW)
    (here / "real_clock.py").write_text(text, encoding="utf-8")
    said = comity("run", "johanna", "--robot", "real_clock:Real", "--adults-only", "--out", "own", "--json")
    assert said.code == 0
    assert (said.json["status"], said.json["outcome"]) == ("done", "success")
    assert "replay.html" in said.json["files"]


def is_moving(here: Path) -> bool:
    moves = here / "moves.txt"
    return moves.exists() and any(line != "0.0" for line in moves.read_text(encoding="utf-8").split())
