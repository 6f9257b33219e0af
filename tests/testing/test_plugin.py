"""The pytest plugin: what it collects, how it names it, and what it says."""

from __future__ import annotations

import subprocess
import sys
import xml.etree.ElementTree as ET

import pytest
from plugin import PLUGIN, REMEMBERING
from rooms import scenario

pytest_plugins = ["pytester"]

MATRIX = "matrix: {profiles: [arab_woman, german_man], seeds: [0, 1]}\n"


@pytest.fixture
def room(pytester: pytest.Pytester):
    def written(*sentences: str, more: str = "", name: str = "room.scenario.yaml") -> None:
        (pytester.path / name).write_text(scenario(*sentences, more=more), encoding="utf-8")

    return written


def test_there_is_one_test_for_each_profile_and_seed_and_one_that_compares(room, pytester):
    room("same for all: safety", more=MATRIX)
    said = pytester.runpytest_inprocess(*PLUGIN, "--collect-only", "-q")
    said.stdout.fnmatch_lines(
        [
            f"room.scenario.yaml::two-in-a-room[[]{part}]"
            for part in (
                "arab_woman-seed0",
                "arab_woman-seed1",
                "german_man-seed0",
                "german_man-seed1",
                "across-seed0",
                "across-seed1",
            )
        ]
    )


def test_rulebooks_and_worlds_are_part_of_the_id(room, pytester):
    worlds = "noisy: {place: {noise_db: 80}}, quiet: {}"
    room(more=f"matrix: {{rulebooks: [bruno2017], worlds: {{{worlds}}}}}\n")
    said = pytester.runpytest_inprocess(*PLUGIN, "--collect-only", "-q")
    said.stdout.fnmatch_lines(
        ["*two-in-a-room[[]arab_woman-bruno2017-noisy-seed0]", "*[[]arab_woman-bruno2017-quiet-seed0]"]
    )


def test_words_and_node_ids_choose(room, pytester):
    room(more=MATRIX)
    said = pytester.runpytest_inprocess(*PLUGIN, "-k", "german_man and seed1", "-q")
    said.assert_outcomes(passed=1, deselected=3)
    said = pytester.runpytest_inprocess(*PLUGIN, "room.scenario.yaml::two-in-a-room[arab_woman-seed0]")
    said.assert_outcomes(passed=1)


def test_a_failure_reads_like_a_sentence(room, pytester):
    """Place, expected, got, cause, picture, and the command that shows it again."""
    room("conversational_distance of host is 90 cm within 1 cm")
    said = pytester.runpytest_inprocess(*PLUGIN, "-p", "no:terminalreporter_extra")
    said.assert_outcomes(failed=1)
    said.stdout.fnmatch_lines(
        [
            "room.scenario.yaml:13: conversational_distance of host is 90 cm within 1 cm",
            "  expected   conversational_distance of host from 0.890 m to 0.910 m",
            "  got        0.640 m, 25 cm too little",
            "  because    parameter conversational_distance of host 0.640 m (culture)",
            "*made of   individualism is LC1 and gender is female*close (rule 1, 0.84);",
            "  picture    runs/failed/room/arab_woman-seed0/picture.png",
            "  again      comity test 'room.scenario.yaml::two-in-a-room[[]arab_woman-seed0]'",
        ]
    )
    folder = pytester.path / "runs/failed/room/arab_woman-seed0"
    assert (folder / "picture.png").read_bytes().startswith(b"\x89PNG")
    assert (folder / "trace.jsonl").is_file()


def test_the_picture_of_a_failure_goes_once_its_test_passes(room, pytester):
    room("duration at most 1 s")
    pytester.runpytest_inprocess(*PLUGIN).assert_outcomes(failed=1)
    room("duration at most 100 s")
    pytester.runpytest_inprocess(*PLUGIN).assert_outcomes(passed=1)
    assert list((pytester.path / "runs/failed").iterdir()) == []


def test_the_report_for_machines_has_profile_seed_distances_and_outcome(room, pytester):
    room()
    pytester.runpytest_inprocess(*PLUGIN, "--junitxml", "report.xml")
    report = ET.parse(pytester.path / "report.xml")
    found = {each.get("name"): each.get("value") for each in report.iter("property")}
    assert {
        name: found.get(name) for name in ("scenario", "profile", "seed", "rulebook", "world", "outcome")
    } == {
        "scenario": "two-in-a-room",
        "profile": "arab_woman",
        "seed": "0",
        "rulebook": "bruno2017",
        "world": None,
        "outcome": "success",
    }
    assert abs(float(found["distance_reached_m.host"]) - 0.6402) < 0.01


def test_the_report_for_machines_says_of_a_comparison_whom_it_compares(room, pytester):
    room("same for all: safety", more=MATRIX)
    pytester.runpytest_inprocess(*PLUGIN, "-k", "across-seed1", "--junitxml", "report.xml")
    report = ET.parse(pytester.path / "report.xml")
    assert {each.get("name"): each.get("value") for each in report.iter("property")} == {
        "scenario": "two-in-a-room",
        "profiles": "arab_woman, german_man",
        "seed": "1",
        "rulebook": "bruno2017",
    }


def test_the_report_for_machines_says_rulebook_and_world_of_a_matrix(room, pytester):
    rulebooks = "[bruno2017, bruno2017-case2]"
    worlds = "{empty: {}, small: {place: {width_m: 5, height_m: 4}}}"
    room(more=f"matrix: {{profiles: [german_man], rulebooks: {rulebooks}, worlds: {worlds}}}\n")
    pytester.runpytest_inprocess(*PLUGIN, "--junitxml", "report.xml")
    told = set()
    for test in ET.parse(pytester.path / "report.xml").iter("testcase"):
        found = {each.get("name"): each.get("value") for each in test.iter("property")}
        told.add((found["rulebook"], found["world"]))
    assert told == {(b, w) for b in ("bruno2017", "bruno2017-case2") for w in ("empty", "small")}


def test_processes_share_the_work(room, pytester):
    room("same for all: outcome", more=MATRIX)
    said = pytester.runpytest_subprocess(*PLUGIN, "-n2")
    said.assert_outcomes(passed=6)


def test_other_profiles_may_take_the_place_of_those_of_the_matrix(room, pytester):
    room(more=MATRIX)
    said = pytester.runpytest_inprocess(*PLUGIN, "--comity-profile", "japanese_woman", "--collect-only", "-q")
    said.stdout.fnmatch_lines(
        ["*[[]japanese_woman-seed0]", "*[[]japanese_woman-seed1]", "2 tests collected*"]
    )


def test_markers_come_from_the_file(room, pytester):
    room("duration at most 1 s", more="markers: {slow: true, xfail: the robot is not that fast}\n")
    said = pytester.runpytest_inprocess(*PLUGIN, "--strict-markers", "-rx")
    said.assert_outcomes(xfailed=1)
    said.stdout.fnmatch_lines(["*the robot is not that fast*"])
    assert not (pytester.path / "runs").exists()
    said = pytester.runpytest_inprocess(*PLUGIN, "-m", "not slow")
    said.assert_outcomes(deselected=1)


def test_what_passes_though_it_must_fail_is_reported(room, pytester):
    room("duration at most 100 s", more="markers: {xfail: not yet}\n")
    pytester.runpytest_inprocess(*PLUGIN).assert_outcomes(failed=1)


def test_a_comparison_may_hold_where_every_case_must_fail(room, pytester):
    """All of them are too slow alike: there is no other way to have the sentence in that file."""
    marked = f"{MATRIX}markers: {{xfail: the robot is not that fast}}\n"
    room("duration at most 1 s", "same for all: outcome", more=marked)
    said = pytester.runpytest_inprocess(*PLUGIN)
    said.assert_outcomes(xfailed=4, xpassed=2)
    assert said.ret == 0


def test_a_file_that_cannot_be_used_says_where(room, pytester):
    room("aproach from the front")
    said = pytester.runpytest_inprocess(*PLUGIN)
    said.assert_outcomes(errors=1)
    said.stdout.fnmatch_lines(["room.scenario.yaml:13:5: expected*got 'aproach'. Did you mean 'approach'?"])


def test_a_word_that_only_this_scenario_can_refuse_is_no_traceback(room, pytester):
    room("Dock_to_usr is never halted")
    said = pytester.runpytest_inprocess(*PLUGIN)
    said.assert_outcomes(failed=1)
    said.stdout.fnmatch_lines(["room.scenario.yaml:13:*got 'Dock_to_usr'. Did you mean 'Dock_to_user'?"])
    said.stdout.no_fnmatch_line("*Traceback*")


def test_other_files_are_nobodys_tests(pytester):
    (pytester.path / "notes.yaml").write_text("a: 1\n")
    pytester.runpytest_inprocess(*PLUGIN).assert_outcomes()


def test_without_scenarios_nothing_heavy_is_imported():
    """Whoever has Comity installed and tests something else does not wait for it."""
    script = (
        "import sys; import comity.testing.pytest_plugin; "
        "print([name for name in sys.modules if name.split('.')[0] in "
        "('numpy', 'pydantic', 'lark', 'yaml', 'pymunk', 'matplotlib', 'unified_planning', 'py_trees')])"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


@pytest.fixture
def failed_once(room, pytester):
    """One scenario that passes, two that fail, and a test of another kind that failed and is mended."""
    room("docking_error at most 5 cm", name="good.scenario.yaml")
    room("duration at most 1 s", more="matrix: {profiles: [german_man, arab_woman]}\n")
    test = pytester.makepyfile(test_plain="def test_plain():\n    assert False\n")
    pytester.runpytest_inprocess(*REMEMBERING)
    test.write_text("def test_plain():\n    pass\n")


def test_only_what_failed_the_last_time_is_run_again(failed_once, pytester):
    """Pytest leaves out whatever it does not find under the names that it kept."""
    pytester.runpytest_inprocess(*REMEMBERING, "--lf").assert_outcomes(failed=2, passed=1)


def test_what_failed_the_last_time_comes_first(failed_once, pytester):
    said = pytester.runpytest_inprocess(*REMEMBERING, "--ff", "-v")
    tried = [line.split("::")[0] for line in said.outlines if " PASSED " in line or " FAILED " in line]
    assert tried[-1] == "good.scenario.yaml"


def test_a_run_goes_on_where_the_last_one_stopped(failed_once, pytester):
    pytester.runpytest_inprocess(*REMEMBERING, "--stepwise")
    said = pytester.runpytest_inprocess(*REMEMBERING, "--stepwise")
    said.assert_outcomes(failed=1, deselected=1)


def test_golden_episodes_whose_scenario_is_not_there_are_warned_of(room, pytester):
    pytester.mkdir("hall")
    room(name="hall/room.scenario.yaml")
    pytester.runpytest_inprocess(*PLUGIN, "--comity-update").assert_outcomes(passed=1)
    (pytester.path / "hall" / "room.scenario.yaml").rename(pytester.path / "hall" / "chamber.scenario.yaml")
    said = pytester.runpytest_inprocess(*PLUGIN)
    said.assert_outcomes(passed=1, warnings=1)
    said.stdout.fnmatch_lines(
        ["*hall/room.golden: expected room.scenario.yaml beside these golden episodes*"]
    )


def test_golden_episodes_beside_their_scenario_are_not_warned_of(room, pytester):
    room()
    pytester.runpytest_inprocess(*PLUGIN, "--comity-update").assert_outcomes(passed=1)
    pytester.runpytest_inprocess(*PLUGIN).assert_outcomes(passed=1, warnings=0)


@pytest.mark.parametrize("more", [(), ("-n", "2")], ids=["alone", "in two processes"])
def test_a_golden_episode_of_a_profile_that_was_dropped_is_warned_of_once(more, room, pytester):
    """As `comity test` names it; what is compared is none."""
    room(more="matrix: {profiles: [arab_woman, german_man]}\n")
    pytester.runpytest_inprocess(*PLUGIN, "--comity-update").assert_outcomes(passed=2, warnings=0)
    assert len(list((pytester.path / "room.golden").iterdir())) == 2
    room(more="matrix: {profiles: [german_man]}\n")
    said = pytester.runpytest_inprocess(*PLUGIN, *more)
    said.assert_outcomes(passed=1, warnings=1)
    said.stdout.fnmatch_lines(
        [
            "*PytestWarning: room.golden/arab_woman-seed0.json: expected a golden episode of a case, got one "
            "that no case is compared with. *or remove it and run `comity test --update`."
        ]
    )
    assert said.stdout.str().count("no case is compared with") == 1
