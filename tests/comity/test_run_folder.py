"""The run folder: what is written stays readable, whatever ends the run, and no two runs share one."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from functools import partial
from pathlib import Path
from resource import RLIMIT_FSIZE, setrlimit

import pytest

from comity.output.run_folder import claimed, is_run, open_run
from comity.system.locks import LOCK, is_locked, locked
from comity_executor import read_trace
from comity_fis import InputError
from comity_sim2d import World, read_frames_csv


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupted_run_keeps_what_happened_so_far(number, comity, here, monkeypatch):
    step, steps = World.step, []

    def interrupted(world):
        steps.append(world)
        if len(steps) == 100:
            signal.raise_signal(number)
        step(world)

    monkeypatch.setattr(World, "step", interrupted)
    said = comity("run", "--out", "run")
    assert (said.code, said.err) == (128 + number, "comity: interrupted\n")
    account = json.loads((here / "run" / "run.json").read_text())
    assert (account["status"], account["error"]) == ("crashed", "interrupted")
    assert {"trace.jsonl", "frames.csv"} <= set(account["files"])
    assert "Navigate_to_user(johanna)  running" in comity("trace", "run").out


def test_a_killed_run_leaves_all_but_its_last_second(comity, here):
    """No handler runs on SIGKILL: what is on disk was written before; it can be read and watched."""
    script = (
        "import os, signal; from comity_sim2d import World; from comity.__main__ import main\n"
        "step = World.step\n"
        "def killed(world):\n"
        "    if world.time_s > 7: os.kill(os.getpid(), signal.SIGKILL)\n"
        "    step(world)\n"
        "World.step = killed; import sys; sys.argv = ['comity', 'run', '--out', 'run']; main()"
    )
    done = subprocess.run([sys.executable, "-c", script], check=False, capture_output=True)
    assert done.returncode == -signal.SIGKILL
    assert json.loads((here / "run" / "run.json").read_text())["status"] == "running"
    assert read_trace(here / "run" / "trace.jsonl")[-1].t == pytest.approx(5.9)
    assert read_frames_csv(here / "run" / "frames.csv").time_s[-1] == pytest.approx(7.0)
    said = comity("trace", "run")
    assert "Dock_to_user(johanna)  running" in said.out
    assert said.out.endswith("The run was killed; up to a second of what happened last is missing.\n")
    assert comity("replay", "run").code == 0
    for name in ("trace.jsonl", "frames.csv"):  # killed while the system was writing
        written = (here / "run" / name).read_bytes()
        (here / "run" / name).write_bytes(written[:-30])
    assert comity("trace", "run").code == 0
    assert comity("replay", "run").code == 0


def test_a_run_says_how_much_room_it_takes(comity, here):
    """The bytes of each file over the simulated minutes."""
    run = comity("run", "--out", "run", "--json").json
    for name in ("trace.jsonl", "readings.csv", "frames.csv"):
        size = (here / "run" / name).stat().st_size
        assert run["bytes_per_minute"][name] == pytest.approx(60 * size / run["simulated_s"], abs=0.5)
    assert run["bytes_per_minute"]["trace.jsonl"] < 60_000
    assert comity("trace", "run", "--json").json["bytes_per_minute"] == run["bytes_per_minute"]
    assert "Size  trace.jsonl " in comity("trace", "run").out


def test_a_run_that_still_goes_on_says_so(comity, here):
    comity("run", "--out", "run", "--json")
    account = json.loads((here / "run" / "run.json").read_text())
    (here / "run" / "run.json").write_text(
        json.dumps(account | {"status": "running", "bytes_per_minute": {}})
    )
    assert comity("trace", "run").out.endswith("is missing.\n")
    with locked(here / "run"):
        assert comity("trace", "run").out.endswith("The run still goes on; this is how far it has come.\n")
    assert not (here / "run" / LOCK).exists()


def test_a_lock_that_a_killed_run_left_behind_is_none(comity, here):
    comity("run", "--out", "run", "--json")
    (here / "run" / LOCK).touch()
    (here / "empty").mkdir()
    (here / "empty" / LOCK).touch()
    assert not is_locked(here / "run")
    assert comity("run", "--out", "run", "--json").code == 0
    assert comity("run", "--out", "empty", "--json").code == 0


def test_a_folder_that_a_run_writes_to_is_refused_to_another(comity, here):
    with claimed(here / "run", new=True):
        said = comity("run", "--out", "run")
    assert said.code == 2
    assert "a folder that another run writes to now" in said.err
    assert not is_run(here / "run")


def test_runs_without_a_folder_of_their_own_are_numbered(comity):
    episodes = [comity("run", "--json").json["episode"] for _ in range(2)]
    assert episodes == ["runs/johanna-1", "runs/johanna-2"]


def test_a_number_that_another_run_takes_meanwhile_is_passed_over(comity, here, monkeypatch):
    from comity.output import run_folder

    (here / "runs" / "johanna-1").mkdir(parents=True)
    numbers = iter((1, 1, 2))  # looked at before the planning, then found taken, then free
    monkeypatch.setattr(run_folder, "_next_free", lambda scenario: Path(f"runs/{scenario}-{next(numbers)}"))
    assert comity("run", "--json").json["episode"].endswith("johanna-2")


def test_a_run_without_a_trace_says_so(comity, here):
    comity("run", "--out", "run", "--json")
    (here / "run" / "trace.jsonl").unlink()
    said = comity("trace", "run")
    assert said.code == 2
    assert "crashed or is still running" in said.err


@pytest.mark.parametrize(
    "words",
    [["run", "x" * 300], ["infer", "x" * 300], ["infer", "--rulebook", "x" * 300], ["trace", "x" * 300]],
    ids=lambda words: " ".join(words)[:20],
)
def test_a_name_too_long_for_the_system_is_refused(comity, words):
    said = comity(*words)
    assert said.code == 2
    assert "File name too long" in said.err
    assert "Traceback" not in said.err


def test_a_reader_who_has_seen_enough_is_no_failure(here):
    """`comity infer german_woman | head -1` ends with 0 and without complaint."""
    line = f"{sys.executable} -m comity infer german_woman | head -1; exit ${{PIPESTATUS[0]}}"
    done = subprocess.run(["bash", "-c", line], cwd=here, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("Rulebook bruno2017")


@pytest.mark.parametrize("words", ["--version", "--help", "run --help", "maps"])
def test_a_reader_who_wants_to_see_nothing_is_no_failure_either(here, words):
    line = f"{sys.executable} -u -m comity {words} | true; exit ${{PIPESTATUS[0]}}"
    done = subprocess.run(["bash", "-c", line], cwd=here, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")


FAILS = """\
schema_version: 1
name: fails
place: {width_m: 6, height_m: 4}
robot: {at_m: [1, 2]}
people: {anna: {profile: german_woman, at_m: [5, 2], facing_deg: 180}}
goals: [{greet: anna}]
expect: [duration at most 1 s]
"""


@pytest.mark.parametrize("flag", ["", "-u"])
def test_a_failed_test_is_told_by_the_exit_code_also_where_nobody_reads_on(here, flag):
    (here / "fails.scenario.yaml").write_text(FAILS)
    line = f"{sys.executable} {flag} -m comity test fails.scenario.yaml | true; exit ${{PIPESTATUS[0]}}"
    done = subprocess.run(["bash", "-c", line], cwd=here, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "Traceback" not in done.stderr


def test_a_run_from_python_takes_its_folder_as_text_or_path(here):
    import comity

    for folder in ("text", here / "path"):
        assert comity.run("johanna", out=folder).outcome == "success"
    assert (here / "text" / "plan.json").read_bytes() == (here / "path" / "plan.json").read_bytes()


@pytest.mark.parametrize("out", ["ff", "ff/run", "ff/a/run", "link"])
def test_a_file_in_the_place_of_a_folder_is_refused_and_no_loop(out, comity, here):
    (here / "ff").write_text("a file")
    (here / "link").symlink_to("nowhere")
    said = comity("run", "--out", out)
    assert said.code == 2
    assert f"{out}: expected a folder for the run" in said.err


def test_a_file_in_the_place_of_runs_is_refused(comity, here):
    (here / "runs").write_text("a file")
    said = comity("run")
    assert said.code == 2
    assert "runs is a file" in said.err


@pytest.mark.parametrize("missing", ["scenario.yaml", "picture.png", "replay.html"])
def test_a_file_that_has_no_room_is_not_there_by_half(missing, comity, here):
    """The system takes so much of every file: what is longer is missing, and nothing else is left over.

    The page names its folder: both names are as long.
    """
    comity("run", "--out", "whole")
    room = (here / "whole" / missing).stat().st_size - 1
    done = subprocess.run(
        [sys.executable, "-m", "comity", "run", "--out", "other"],
        preexec_fn=partial(setrlimit, RLIMIT_FSIZE, (room, room)),
        check=False,
        capture_output=True,
    )
    assert done.returncode == 2
    assert done.stderr.startswith(b"comity: the output could not be written: expected room for it")
    left = {path.name for path in (here / "other").iterdir()}
    assert left <= {path.name for path in (here / "whole").iterdir()} - {missing}
    account = json.loads((here / "other" / "run.json").read_text())
    assert account["status"] == "crashed"
    assert set(account["files"]) == left


@pytest.mark.parametrize("command", ["trace", "metrics", "replay"])
def test_a_pipe_for_an_account_is_refused_and_not_waited_for(command, comity, here):
    (here / "run").mkdir()
    os.mkfifo(here / "run" / "run.json")
    said = comity(command, "run")
    assert (said.code, said.out) == (2, "")
    assert "got a folder whose run.json is damaged" in said.err


def test_nor_is_a_device_read_to_its_end(here):
    (here / "run").mkdir()
    (here / "run" / "run.json").symlink_to("/dev/zero")
    assert not is_run(here / "run")
    with pytest.raises(InputError, match="damaged"):
        open_run(here / "run")
