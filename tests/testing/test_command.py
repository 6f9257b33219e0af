"""`comity test`: what it prints while it runs, and how it ends."""

from __future__ import annotations

import json
import os
import shlex
import signal
import subprocess
import sys
import time
from contextlib import suppress
from functools import partial
from pathlib import Path

import pytest
from downward import needs_fast_downward
from terminal import signals_of_a_terminal

ANOTHER = ("--engine", "fast-downward-opt")
MATRIX = "matrix: {profiles: [arab_woman, german_man]}\n"


@pytest.fixture
def comity(comity):
    """`comity test` in the folder of a scenario."""
    return partial(comity, "test", "--failed", "")


def test_without_a_terminal_every_test_has_a_line_as_it_ends(comity, write):
    """In the log of a build somebody sees where it is; what is printed at the end stays by itself."""
    write("duration at most 7 s, for german_man", more=MATRIX)
    done = comity()
    lines = [line.split()[:2] for line in done.err.splitlines()]
    assert lines == [
        ["PASSED", "two-in-a-room[arab_woman-seed0]"],
        ["FAILED", "two-in-a-room[german_man-seed0]"],
    ]
    assert done.code == 1
    assert "PASSED" not in done.out


@pytest.mark.parametrize(("option", "code"), [("--version", 2), ("--collect-only", 0)])
def test_where_pytest_looks_for_no_test_nothing_is_called_good(option, code, comity):
    """To collect and not to run is what was asked for: the account says how many tests were not run."""
    done = comity("johanna", "--", option)
    assert done.code == code
    assert ("5 not run" in done.out) == (code == 0)
    assert ("expected pytest to look for tests" in done.err) == (code == 2)


@needs_fast_downward
def test_another_engine_of_unified_planning_plans_what_is_tested(comity, write):
    """The plan has the same steps, and a failure says how to see it again with that engine."""
    write("duration at most 7 s", "min_clearance at least 0.3 m")
    done = comity(*ANOTHER, "--json")
    (result,) = json.loads(done.out)["tests"]
    assert done.code == 1
    assert result["again"].endswith(" --engine fast-downward-opt")
    assert "duration at most 7 s" in result["text"]
    assert "min_clearance" not in result["text"]


@needs_fast_downward
def test_a_deadline_is_refused_for_an_engine_that_keeps_none(comity):
    done = comity("in-a-hurry", "--profile", "german_woman", *ANOTHER)
    assert done.code == 2
    assert "by_s: 23.0 of host" in done.out


@pytest.mark.parametrize(
    "options", [("--engine", "nonsense"), pytest.param((*ANOTHER, "--update"), marks=needs_fast_downward)]
)
def test_what_no_engine_can_do_is_refused_before_any_test(options, comity, write):
    path = write("duration at most 60 s")
    done = comity(*options)
    assert done.code == 2
    assert done.err.startswith("comity: ")
    assert [one.name for one in path.parent.iterdir()] == [path.name]


@pytest.mark.parametrize("options", [(), ("--json",)])
def test_golden_episodes_of_no_case_are_named(options, comity, write):
    """Whoever renames a profile, a world or a seed leaves them behind, and nothing is compared any more."""
    path = write("duration at most 60 s", more=MATRIX)
    assert comity("--update").code == 0
    path.write_text(path.read_text().replace("[arab_woman, german_man]", "[arab_woman]"))
    done = comity(*options)
    assert done.code == 0
    (line,) = (line for line in done.err.splitlines() if line.startswith("comity: "))
    assert "room.golden/german_man-seed0.json: expected a golden episode of a case" in line


@pytest.mark.parametrize("options", [(), ("--json",), ("-k", "arab_woman"), ("--profile", "german_woman")])
def test_golden_episodes_whose_scenario_is_not_there_are_named(options, comity, write):
    """Whoever renames or removes a scenario leaves all of them behind."""
    path = write("duration at most 60 s", more=MATRIX)
    assert comity("--update").code == 0
    path.rename(path.with_name("chamber.scenario.yaml"))
    done = comity(*options)
    assert done.code == 0
    (line,) = (line for line in done.err.splitlines() if line.startswith("comity: "))
    assert "room.golden: expected room.scenario.yaml beside these golden episodes, got none" in line
    assert "Call the folder as the scenario is called now, or remove it" in line


def test_golden_episodes_whose_folder_was_called_as_the_scenario_hold_again(comity, write):
    path = write("duration at most 60 s", more=MATRIX)
    assert comity("--update").code == 0
    path.rename(path.with_name("chamber.scenario.yaml"))
    path.with_name("room.golden").rename(path.with_name("chamber.golden"))
    done = comity()
    assert done.code == 0
    assert "comity: " not in done.err


@pytest.mark.parametrize(
    "options", [("--profile", "arab_woman"), ("-k", "arab_woman"), ("{}::two-in-a-room[arab_woman-seed0]",)]
)
def test_golden_episodes_of_cases_that_are_left_out_are_not(options, comity, write):
    path = write("duration at most 60 s", more=MATRIX)
    assert comity("--update").code == 0
    done = comity(*(option.format(path) for option in options))
    assert done.code == 0
    assert "comity: " not in done.err


def test_json_comes_alone(comity, write):
    write("duration at most 60 s", more=MATRIX)
    done = comity("--json")
    assert (done.code, done.err) == (0, "")
    assert json.loads(done.out)["passed"] == 2


def test_the_first_failure_ends_it_where_that_is_asked_for(comity, write):
    write("duration at most 7 s", more=MATRIX)
    done = comity("-x")
    assert "1 test: 0 passed, 1 failed" in done.out
    assert done.err.count("\n") == 1


def test_what_is_copied_from_a_failure_stands_in_one_line_however_long_it_is(comity, write, tmp_path):
    """The command, which is pasted here, the picture's path, and where the sentence stands."""
    folder = tmp_path / "a ward with a long name" / "and one below it" / "for all of the people of the house"
    folder.mkdir(parents=True)
    name = folder.relative_to(tmp_path) / "room of two.scenario.yaml"
    rest = "matrix: {profiles: [arab_woman, 'a man.profile.yaml']}\n"
    write("duration at most 1 s", more=rest, name=str(name))
    (folder / "a man.profile.yaml").write_text(f"schema_version: 1\nname: {'man of the house ' * 5}\n")

    lines = comity("--failed", "runs/failed", "-k", "not arab").out.splitlines()
    assert any(line.startswith(f"{name}:") and line.endswith(": duration at most 1 s") for line in lines)
    (picture,) = (line.removeprefix("  picture    ") for line in lines if line.startswith("  picture "))
    assert (tmp_path / picture).is_file()
    (again,) = (line.removeprefix("  again      ") for line in lines if line.startswith("  again "))
    assert len(again) > 110
    words = shlex.split(again)
    assert words[:2] == ["comity", "test"]
    assert again in comity(*words[2:]).out


@pytest.mark.parametrize(
    ("options", "remedy"),
    [
        (["--shipped", "room.scenario.yaml"], "Leave one of them out"),
        (["--shipped", "--update"], "Copy the scenario"),
        (["empty-room", "--update"], "Copy the scenario"),
    ],
)
def test_what_ships_is_by_itself_and_stays_as_it_is(options, remedy, comity, write):
    write("duration at most 60 s")
    done = comity(*options)
    assert done.code == 2
    assert remedy in done.err
    assert "PASSED" not in done.err


def test_the_command_that_a_failure_names_runs_that_test(comity, write):
    write("duration at most 7 s", "'same for all: conversational_distance'", more=MATRIX)
    told = json.loads(comity("--json", "--profile", "japanese_woman", "--profile", "german_woman").out)
    assert [one["id"].split("[")[1] for one in told["tests"]] == [
        "japanese_woman-seed0]",
        "german_woman-seed0]",
        "across-seed0]",
    ]
    for one in (told["tests"][0], told["tests"][2]):
        again = json.loads(comity(*shlex.split(one["again"])[2:], "--json").out)
        assert [(each["id"], each["text"]) for each in again["tests"]] == [(one["id"], one["text"])]


def ctrl_c(process: subprocess.Popen[str]) -> int:
    """At a terminal every process of the group gets it."""
    os.killpg(process.pid, signal.SIGINT)
    return 130


def told_to_end(process: subprocess.Popen[str]) -> int:
    """As by `kill`: only the program gets it."""
    process.terminate()
    return 143


def timed_out(process: subprocess.Popen[str]) -> int:
    """As by `timeout`: the program gets it, and then its group with it."""
    process.terminate()
    os.killpg(process.pid, signal.SIGTERM)
    return 143


WAYS = pytest.mark.parametrize("stop", [ctrl_c, told_to_end, timed_out])


def working_in(folder: Path) -> list[str]:
    """The commands of processes that still are there after a while; a dead one has no folder."""
    for _ in range(100):
        found = []
        for entry in Path("/proc").glob("[0-9]*"):
            with suppress(OSError):
                if (entry / "cwd").readlink() == folder:
                    found.append((entry / "cmdline").read_text().replace("\0", " "))
        if not found:
            break
        time.sleep(0.05)
    return found


@WAYS
@pytest.mark.parametrize("when", ["its processes start", "the first test has ended"])
def test_whoever_stops_it_ends_it_at_once_and_quietly(when, stop, write, tmp_path):
    for n in range(4):
        write(more=f"matrix: {{profiles: all, seeds: [{n}, {n + 4}]}}\n", name=f"room{n}.scenario.yaml")
    command = [sys.executable, "-m", "comity", "test", "--jobs", "2", "--failed", ""]
    with signals_of_a_terminal():
        process = subprocess.Popen(
            command, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, process_group=0
        )
    assert process.stderr
    first = ""
    if when == "the first test has ended":
        first = process.stderr.readline()
        assert first.startswith("PASSED")
    else:
        while not Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text():
            time.sleep(0.01)
        time.sleep(0.2)
    code = stop(process)
    _, said = process.communicate(timeout=60)
    assert process.returncode == code
    assert "Traceback" not in said
    assert said.splitlines()[-1] == "comity: interrupted"
    assert said.count("PASSED") < 12  # a hundred were still to come
    assert working_in(tmp_path) == []


def children_of(process: subprocess.Popen[str]) -> list[int]:
    return [int(one) for one in Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()]


def test_where_a_worker_is_killed_its_test_has_failed_and_the_others_go_on(write, tmp_path):
    """As where memory runs out."""
    for n in range(2):
        write(
            more=f"matrix: {{profiles: [german_man], seeds: {list(range(8))}}}\n", name=f"{n}.scenario.yaml"
        )
    command = [sys.executable, "-m", "comity", "test", "--jobs", "2", "--failed", ""]
    process = subprocess.Popen(
        command, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, process_group=0
    )
    assert process.stderr
    assert process.stderr.readline().startswith("PASSED")
    os.kill(children_of(process)[0], signal.SIGKILL)
    told, _ = process.communicate(timeout=120)
    assert process.returncode == 1
    assert "16 tests: 15 passed, 1 failed" in told
    assert "crashed while running '" in told
    assert working_in(tmp_path) == []


def test_several_processes_tell_what_one_tells(comity, write):
    """Comparisons, too: all tests of a file are carried out by one process."""
    compared = "differs between german_man and arab_woman: conversational_distance, by at least 90 cm"
    write(f"'{compared}'", "'same for all: safety'", more="matrix: {profiles: all, seeds: [0, 1]}\n")
    shared, alone = (json.loads(comity("--json", "--jobs", jobs).out) for jobs in "21")
    assert len(shared["tests"]) == 28
    for one, other in zip(shared["tests"], alone["tests"], strict=True):
        assert one == other
    assert {one["id"]: one["status"] for one in shared["tests"]}["two-in-a-room[across-seed1]"] == "failed"


@pytest.mark.parametrize(("as_json", "stop"), [(True, ctrl_c), (False, told_to_end), (True, timed_out)])
def test_what_failed_before_it_was_stopped_is_told(as_json, stop, write, tmp_path):
    """Where the second failed test's run is written, the first test has ended."""
    write("duration at most 1 s", more="matrix: {profiles: [german_man], seeds: [0, 1, 2, 3, 4, 5, 6, 7]}\n")
    command = [sys.executable, "-m", "comity", "test", "--jobs", "1", *(["--json"] if as_json else [])]
    with signals_of_a_terminal():
        process = subprocess.Popen(
            command, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, process_group=0
        )
    while not (tmp_path / "runs/failed/room/german_man-seed1/run.json").is_file():
        assert process.poll() is None
        time.sleep(0.01)
    code = stop(process)
    told, said = process.communicate(timeout=60)
    assert process.returncode == code
    assert said.splitlines()[-1] == "comity: interrupted"
    if as_json:
        answer = json.loads(told)
        assert answer["failed"] >= 1
        assert answer["failed"] + answer["not_run"] == 8
        assert "duration at most 1 s" in answer["tests"][0]["text"]
    else:
        assert told.startswith(
            "FAILED two-in-a-room[german_man-seed0]\nroom.scenario.yaml:13: duration at most 1 s"
        )
        assert " not run in " in told


@WAYS
def test_one_object_is_printed_where_it_is_stopped_before_any_test(stop, tmp_path):
    """While it still finds out which tests there are, among them everything that it imports for that."""
    command = [sys.executable, "-m", "comity", "test", "--shipped", "--json", "--jobs", "2"]
    with signals_of_a_terminal():
        process = subprocess.Popen(
            command, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, process_group=0
        )
    while not Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text():
        time.sleep(0.01)
    code = stop(process)
    told, said = process.communicate(timeout=60)
    assert (process.returncode, said) == (code, "comity: interrupted\n")
    answer = json.loads(told)
    assert (answer["tests"], answer["passed"], answer["not_run"]) == ([], 0, None)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["nowhere"], "no such file or folder: nowhere"),
        (["room.scenario.yaml::nobody"], "got 'nobody'"),
        (["-k", "nobody"], "expected tests that -k 'nobody' chooses, got none"),
        (["-k", "(german"], "Wrong expression passed to '-k': (german"),
        (["--", "--no-such-option"], "unrecognized arguments: --no-such-option"),
        (["--fast"], "expected tests that --fast chooses, got none"),
        (["--profile", "nobody", "--fairness"], "nobody"),
        (["empty-room", "--update"], "ships with Comity"),
    ],
)
def test_one_object_is_printed_where_there_is_nothing_to_test(options, said, comity, write):
    write("duration at most 60 s", more="markers: {slow: true}\n")
    for jobs in ("1", "2"):
        done = comity("--json", "--jobs", jobs, *options)
        told = json.loads(done.out)
        assert (done.code, told["tests"], told["not_run"]) == (2, [], None)
        assert said in done.err
        assert comity("--jobs", jobs, *options).out == ""


def test_one_object_tells_that_every_file_is_refused(comity, write):
    write("finishes in 60 s", name="one.scenario.yaml")
    write("ends within 60 s", name="other.scenario.yaml")
    done = comity("--json", "-k", "german")
    told = json.loads(done.out)
    assert (done.code, told["refused"], done.err) == (2, 2, "")
    assert [one["text"].split(": ")[0] for one in told["tests"]] == [
        "one.scenario.yaml:13:14",
        "other.scenario.yaml:13:10",
    ]


def test_where_every_file_is_refused_each_is_told(comity, write):
    for name in ("one", "other"):
        write("finishes in 60 s", name=f"{name}.scenario.yaml")
    done = comity()
    assert done.code == 2
    assert "REFUSED one.scenario.yaml" in done.out
    assert "REFUSED other.scenario.yaml" in done.out


def test_what_is_wrong_for_every_profile_is_told_once(comity, write, tmp_path):
    """A rulebook that all of them read; each test is named."""
    (tmp_path / "rules.yaml").write_text("")
    write("duration at most 60 s", more=f"rulebook: rules.yaml\n{MATRIX}")
    done = comity()
    assert done.code == 2
    assert done.out.count("REFUSED two-in-a-room[") == 2
    assert done.out.count("rules.yaml:1: expected a mapping") == 1


def test_the_command_of_a_refused_file_has_its_profiles(comity, write):
    write("finishes in 60 s")
    told = json.loads(comity("--json", "--profile", "paper").out)
    assert told["tests"][0]["again"] == "comity test room.scenario.yaml --profile paper"


def test_brackets_choose(comity, write):
    write("duration at most 60 s", more=MATRIX)
    done = comity("-k", "(german or japanese) and seed0")
    assert "1 test: 1 passed" in done.out
    assert comity("-k", "(german").code == 2


def test_a_file_that_cannot_be_used_does_not_hide_the_others(comity, write, tmp_path):
    """It is told with its name; a pipe and a link to nowhere are passed over, as pytest does."""
    write("duration at most 60 s")
    write("finishes in 60 s", name="wrong.scenario.yaml")
    os.mkfifo(tmp_path / "pipe.scenario.yaml")
    (tmp_path / "link.scenario.yaml").symlink_to("nowhere.yaml")
    done = comity()
    assert done.code == 2
    assert "2 tests: 1 passed, 1 refused" in done.out
    assert "PASSED   two-in-a-room[arab_woman-seed0]" in done.err
    assert "wrong.scenario.yaml:13:" in done.out


def test_where_no_file_can_be_used_that_is_all_that_is_said(comity, write):
    write("finishes in 60 s")
    done = comity()
    assert (done.code, done.out) == (2, "")
    assert done.err.startswith("comity: room.scenario.yaml:13:")
