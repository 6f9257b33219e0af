"""A study is carried out once, whatever stops it on the way, and its table is the same to the byte."""

from __future__ import annotations

import csv
import errno
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from study.writing import population, study

from comity.commands.progress import EpisodeRate
from comity.study import Study
from comity.study.carrying import MOST_LOSSES, Ended, EpisodeRunner
from comity.study.journal import line_of, opened_journal, read_journal
from comity.study.local_workers import local_carrier
from comity.study.progress import progress_of
from comity.study.running import run_study
from comity.study.study_plan import load_study
from comity.study.tasks import task_of
from comity.study.worker import TaskDone, carried_out, installation
from comity.system.locks import is_locked
from comity_fis import InputError

resource = pytest.importorskip("resource", reason="limits of POSIX")

NOISY = {"robot.sensor.noise_m": [0.02], "rulebook": ["bruno2017", "evidence"]}
COMMAND = Path(sys.executable).parent / "comity"


def written(folder: Path, seeds: int = 2) -> Path:
    """Eight episodes: two rulebooks, two individuals, two seeds."""
    aged = {"individuals": 2, "facts": {"culture": "SWE", "age": {"from": 20, "to": 90}}}
    population(folder / "people.yaml", groups={"swedes": aged})
    return study(folder / "noisy.yaml", population="people.yaml", factors=NOISY, seeds=seeds)


@pytest.fixture
def noisy(here):
    return written(here)


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The tables with two seeds, and with three, each carried out in one go in this process."""

    def carry_out(tasks):
        yield from (Ended((carried_out(task),)) for task in tasks)

    found = {}
    for seeds in (2, 3):
        folder = tmp_path_factory.mktemp("whole")
        plan = load_study(written(folder, seeds))
        run_study(
            plan, folder / "out", lambda: EpisodeRunner(installation(), carry_out), lambda *_: lambda _: None
        )
        found[seeds] = tables(folder / "out")
    return found


def run(comity, out, *words):
    said = comity("study", "run", "noisy.yaml", "--out", out, *(words or ("--jobs", "1")), "--json")
    assert said.code == 0, said.err
    return said.json


def tables(folder: Path) -> dict[str, bytes]:
    names = ("results.csv", "dictionary.csv", "results.parquet")
    return {name: (folder / name).read_bytes() for name in names if (folder / name).exists()}


def kept(folder: Path) -> int:
    """Episodes in its journal."""
    return len(read_journal(folder / "journal.jsonl").rows)


def hear_interrupts() -> None:
    """A job in the background of a shell inherits that they are ignored."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def begun(out: str, preexec_fn=hear_interrupts) -> subprocess.Popen[bytes]:
    """The command, once its journal has an episode."""
    command = [COMMAND, "study", "run", "noisy.yaml", "--out", out, "--jobs", "1"]
    process = subprocess.Popen(
        command,
        stderr=subprocess.PIPE,
        stdout=subprocess.PIPE,
        preexec_fn=preexec_fn,  # noqa: PLW1509  (no thread runs here)
    )
    while process.poll() is None and not kept(Path(out)):
        time.sleep(0.02)
    return process


def test_two_processes_write_the_same_table_as_one(comity, here, noisy, whole):
    answer = run(comity, "out", "--jobs", "2")
    assert (answer["done"], answer["run_now"], answer["failed"], answer["rows"]) == (8, 8, 0, 8)
    assert answer["status"] == "done"
    assert tables(here / "out") == whole[2]


def test_what_is_there_is_not_run_again_and_a_wider_study_runs_only_what_is_new(comity, here, noisy, whole):
    run(comity, "out")
    assert run(comity, "out")["run_now"] == 0
    assert tables(here / "out") == whole[2]
    written(here, seeds=3)
    answer = run(comity, "out")
    assert (answer["done"], answer["run_now"]) == (12, 4)
    assert tables(here / "out") == whole[3]


STOPS = [(signal.SIGINT, 130, "stopped"), (signal.SIGTERM, 143, "stopped"), (signal.SIGKILL, -9, "begun")]


@pytest.mark.parametrize("stop", STOPS, ids=lambda stop: stop[0].name)
def test_a_study_that_is_stopped_or_killed_goes_on(comity, noisy, whole, stop):
    number, code, status = stop
    out = noisy.parent / "out"
    process = begun("out")
    process.send_signal(number)
    process.communicate()
    assert process.returncode == code
    before = kept(out)
    assert 1 <= before < 8
    account = json.loads((out / "study.json").read_text())
    assert (account["status"], account["done"]) == (status, before if status == "stopped" else 0)
    progress = progress_of(out)
    assert (progress.ended, progress.episodes, progress.is_running) == (before, 8, False)
    for words in (("report", "out"), ("show", "out", "--row", 1)):
        said = comity("study", *words)
        assert (said.code, f"interrupted at {before} of 8 episodes" in said.err) == (2, True)
        assert f"comity study run {noisy} --out out" in said.err.replace("\n", " ")
    planned = comity("study", "plan", "noisy.yaml", "--out", "out", "--json").json
    assert (planned["state"], planned["done"]) == ("interrupted", before)
    assert run(comity, "out")["run_now"] == 8 - before
    assert tables(out) == whole[2]
    assert progress_of(out) is None


def test_the_rate_is_that_of_this_run_since_its_first_episode_and_a_log_has_each_tenth():
    rate = EpisodeRate(missing=100, total=3600)
    assert rate.per_s is None
    told = [rate.count(more, now_s) for more, now_s in ((1, 100.0), (1, 101.0), (8, 103.0), (1, 134.0))]
    assert told == [False, False, True, True]  # a tenth, then half a minute
    assert rate.per_s == pytest.approx(10 / 34)
    assert rate.text().startswith("3511 of 3600 episodes")


def test_without_a_terminal_a_study_says_how_far_it_is(comity, noisy):
    said = comity("study", "run", "noisy.yaml", "--out", "out", "--jobs", 1)
    ended = [int(line.split()[0]) for line in said.err.splitlines() if " of 8 episodes" in line]
    assert ended == [0, *range(1, 9)]


def test_a_full_disk_ends_the_command_and_the_study_goes_on_with_room(comity, here, noisy, whole):
    """The limit on the size of a file stands for the disk: the same call fails."""

    def little_room() -> None:
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (9000, 9000))

    process = begun("out", preexec_fn=little_room)
    _, said = process.communicate()
    assert process.returncode == 2
    assert b"Traceback" not in said
    assert 1 <= kept(here / "out") < 8
    run(comity, "out")
    assert tables(here / "out") == whole[2]


def test_a_line_that_was_cut_off_is_taken_off_and_its_episode_runs_again(comity, here, noisy, whole):
    run(comity, "out")
    journal = here / "out/journal.jsonl"
    journal.write_bytes(journal.read_bytes()[:-40])
    assert run(comity, "out")["run_now"] == 1
    assert tables(here / "out") == whole[2]
    assert kept(here / "out") == journal.read_bytes().count(b"\n") == 8


DAMAGES = (
    lambda line: b"garbage{\n",
    lambda line: b"\n",
    lambda line: b"12\n",
    lambda line: bytes(400) + b"\n",
    lambda line: line[:60] + b"\n",
    lambda line: b'{"key": "x", "rows": [{}]}\n',
    lambda line: line.replace(b'"distance_target_m": 0', b'"distance_target_m": 1'),
)


def test_damaged_lines_in_the_middle_cost_their_own_episodes_alone(comity, here, noisy, whole):
    run(comity, "out")
    journal = here / "out/journal.jsonl"
    first, *lines = journal.read_bytes().splitlines(keepends=True)
    damaged = [damage(line) for damage, line in zip(DAMAGES, lines, strict=True)]
    assert not set(damaged) & set(lines)
    journal.write_bytes(b"".join([first, *damaged]))
    answer = run(comity, "out")
    found = {key: answer[key] for key in ("status", "done", "run_now", "damaged_lines", "rows")}
    assert found == {"status": "done", "done": 8, "run_now": 7, "damaged_lines": 7, "rows": 8}
    assert answer["damaged_at"] == [f"out/journal.jsonl:{number}" for number in range(2, 9)]
    assert journal.read_bytes().startswith(b"".join([first, *damaged]))
    assert tables(here / "out") == whole[2]


def test_a_study_is_done_only_when_its_table_has_every_episode(here, noisy):
    def all_but_one(tasks):
        yield Ended(tuple(carried_out(task) for task in list(tasks)[1:]))

    plan = load_study(noisy)
    answer = run_study(
        plan, here / "out", lambda: EpisodeRunner(installation(), all_but_one), lambda *_: lambda _: None
    )
    assert (answer.status, answer.done, answer.rows) == ("stopped", 7, 7)
    found = Study.load(here / "out")
    progress = found.progress
    assert (progress.ended, progress.episodes, len(found.rows)) == (7, 8, 7)
    assert "interrupted at 7 of 8 episodes" in repr(found)


def test_individuals_who_are_alike_share_an_episode_and_have_a_row_each(comity, here):
    population(here / "people.yaml", groups={"swedes": {"individuals": 3, "facts": {"culture": "SWE"}}})
    study(here / "noisy.yaml", population="people.yaml")
    answer = run(comity, "out")
    assert [answer[key] for key in ("episodes", "different", "done", "run_now", "rows")] == [3, 1, 3, 1, 3]


def test_episodes_of_earlier_conditions_are_counted_and_stay_in_the_journal(comity, here, noisy):
    run(comity, "out")
    study(here / "noisy.yaml", population="people.yaml", factors={**NOISY, "rulebook": ["evidence"]}, seeds=2)
    answer = run(comity, "out")
    assert [answer[key] for key in ("done", "run_now", "rows", "other")] == [4, 0, 4, 4]
    assert kept(here / "out") == 8


ROW = {"person": "x", "outcome": "greeted", "value": 0.1 + 0.2}


def test_a_journal_has_what_was_kept_before_the_next_line(tmp_path):
    path = tmp_path / "journal.jsonl"
    for key in "ab":
        with opened_journal(path) as journal:
            journal.keep([TaskDone(key, (ROW,), 0.5)])
            assert read_journal(path).rows[key] == (ROW,)
        path.write_bytes(path.read_bytes() + b'{"key": "c"')
    assert [*read_journal(path).rows] == ["a", "b"]


DONE = TaskDone("a" * 64, (ROW,), 0.5)


@given(st.integers(0), st.integers(1, 255))
def test_any_changed_byte_of_a_line_is_found(tmp_path_factory, place, flip):
    path = tmp_path_factory.mktemp("journal") / "journal.jsonl"
    whole, line = line_of(TaskDone("b" * 64, (ROW,), 0.5)), bytearray(line_of(DONE))
    line[place % (len(line) - 1)] ^= flip
    path.write_bytes(whole + line + whole)
    found = read_journal(path)
    assert DONE.key not in found.rows
    assert [*found.rows] == ["b" * 64]
    assert found.damaged[0] == 2


def test_lines_without_a_checksum_are_read_as_they_are(tmp_path):
    path = tmp_path / "journal.jsonl"
    content = json.loads(line_of(DONE))
    del content["crc32"]
    path.write_text(json.dumps(content) + "\n", encoding="utf-8")
    found = read_journal(path)
    assert (found.rows, found.damaged) == ({DONE.key: (ROW,)}, ())


def _tasks(noisy):
    plan, carrier = load_study(noisy), local_carrier(2)
    return carrier, [task_of(plan, cell, carrier.installed) for cell in plan.cells()]


def test_a_worker_that_is_killed_loses_no_episode(noisy):
    carrier, tasks = _tasks(noisy)
    ended, lost, killed = [], 0, False
    for batch in carrier.carry_out(iter(tasks)):
        ended, lost = [*ended, *batch.done], lost + batch.lost
        if not killed:
            killed = True
            _kill_a_child()
    assert lost == 1
    assert {one.key for one in ended} == {one.key for one in tasks}
    assert all("error" not in row for one in ended for row in one.rows)


def _kill_a_child() -> None:
    from multiprocessing import active_children

    active_children()[0].kill()


def test_an_episode_that_kills_every_worker_is_a_row_with_an_error_after_ten_losses(noisy, monkeypatch):
    carrier, (task, *_) = _tasks(noisy)
    monkeypatch.setattr("comity.study.local_workers._serve", _end_at_once)
    ended = [*carrier.carry_out(iter([task]))]
    assert sum(batch.lost for batch in ended) == MOST_LOSSES
    (done,) = (one for batch in ended for one in batch.done)
    (row,) = done.rows
    assert (row["person"], row["outcome"]) == ("johanna", "error")
    assert "10 workers" in row["error"]


def _end_at_once(connection) -> None:
    os.kill(os.getpid(), signal.SIGKILL)


def test_an_episode_that_raises_is_a_row_with_its_error(noisy, monkeypatch):
    _, (task, *_) = _tasks(noisy)

    def broken(*_, **__):
        raise ZeroDivisionError("of all things")

    monkeypatch.setattr("comity.study.worker.execute", broken)
    (row,) = carried_out(task).rows
    assert row == {"person": "johanna", "outcome": "error", "error": "ZeroDivisionError: of all things"}


def test_an_episode_without_a_plan_is_a_row_with_the_reason(here):
    factors = {"people.visited.at_m": [[0.4, 4.2]], "place.furniture": [[]]}
    walls = [[[0, 3.5], [1.5, 3.5]], [[1.5, 3.5], [1.5, 4.5]]]
    plan = load_study(study(here / "s.yaml", factors={**factors, "place.walls_m": [walls]}))
    (cell,) = plan.cells()
    (row,) = carried_out(task_of(plan, cell, local_carrier(1).installed)).rows
    assert row["outcome"] in ("unreachable", "no_plan")
    assert row["reason"]


def test_a_folder_with_other_things_is_refused_before_anything_runs(comity, here, noisy):
    (here / "taken").mkdir()
    (here / "taken/thesis.txt").write_text("mine")
    assert comity("study", "run", "noisy.yaml", "--out", "taken").code == 2
    assert [path.name for path in (here / "taken").iterdir()] == ["thesis.txt"]
    study(here / "other.yaml")
    assert comity("study", "run", "other.yaml", "--out", "out").code == 0
    said = comity("study", "run", "noisy.yaml", "--out", "out")
    assert said.code == 2
    assert "that of the study other" in said.err


def test_two_commands_do_not_write_to_one_folder(comity, here, noisy):
    process = begun("out")
    said = comity("study", "run", "noisy.yaml", "--out", "out")
    assert progress_of(Path("out")).is_running
    process.kill()
    process.communicate()
    assert said.code == 2
    assert "written to now" in said.err


def test_a_copy_on_a_read_only_disk_is_not_taken_for_running(tmp_path, monkeypatch):
    """No test may mount a disk: the system's answer stands in for one."""

    def refused(*_, **__):
        raise OSError(errno.EROFS, "Read-only file system")

    (tmp_path / ".lock").touch()
    monkeypatch.setattr("comity.system.locks.locked", refused)
    assert not is_locked(tmp_path)


def test_processes_and_a_cluster_are_not_asked_for_at_once(comity, noisy):
    said = comity(
        "study", "run", "noisy.yaml", "--out", "out", "--jobs", 2, "--scheduler", "tcp://127.0.0.1:1"
    )
    assert said.code == 2


def test_a_study_that_was_run_is_loaded(comity, here, noisy):
    run(comity, "out")
    found = Study.load("out")
    with (here / "out/results.csv").open(encoding="utf-8", newline="") as file:
        assert [dict(row) for row in found.rows] == list(csv.DictReader(file))
    assert found.columns["distance_actual_m"]["unit"] == "m"
    with pytest.raises(InputError):
        Study.load(here)
