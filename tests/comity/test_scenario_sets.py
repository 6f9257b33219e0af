"""What ships is listed by theme or by set, and every name that is listed can be run, drawn and tested."""

from __future__ import annotations

import pytest

from comity.scenario import load_scenario
from comity.system import scenario_sets
from comity.system.library import find, shipped
from comity.system.scenario_sets import SETS, THEMES, by_theme, set_named
from comity_fis import InputError


def test_every_shipped_file_is_in_a_theme_or_a_set():
    files = {path for files in by_theme().values() for path in files.values()}
    files |= {path for each in SETS for path in set_named(each).values()}
    folder = next(iter(files)).parents[1]
    assert files == set(folder.rglob("*.yaml"))
    assert all(by_theme()[theme] for theme in THEMES)


def test_scenarios_are_listed_by_theme_in_the_order_of_reading(comity):
    rows = comity("scenarios", "--json").json["scenarios"]
    assert list(dict.fromkeys(row["theme"] for row in rows)) == list(THEMES)
    assert rows[0] | {"about": ""} == {"name": "johanna", "about": "", "theme": "first visits"}
    text = comity("scenarios").out
    heads = [line for line in text.splitlines() if line and not line.startswith(" ")]
    assert heads[:-1] == [theme.capitalize() for theme in THEMES]
    assert heads[-1].endswith("comity scenarios --set comity-bench-1")


def test_a_set_is_listed_by_the_names_that_load_its_scenarios(comity):
    rows = comity("scenarios", "--set", "comity-bench-1", "--json").json["scenarios"]
    assert [row["name"] for row in rows] == list(set_named("comity-bench-1"))
    for row in rows:
        assert load_scenario(row["name"]).scenario.about == row["about"]


def test_tests_of_a_set_and_of_what_is_to_learn_from_can_be_named_together(comity):
    options = ("--shipped", "--set", "comity-bench-1", "-k", "bedside or johanna", "--profile", "unknown")
    tests = comity("test", *options, "--jobs", 1, "--failed", "", "--json").json["tests"]
    assert [test["id"] for test in tests if "across" not in test["id"]] == [
        "johanna[unknown-seed0]",
        "bedside[unknown-seed0]",
    ]
    assert all(test["status"] == "passed" for test in tests)
    assert "'comity-bench-1/bedside::bedside[unknown-seed0]'" in tests[-1]["again"] + tests[-2]["again"]


@pytest.mark.parametrize(
    ("words", "remedy"),
    [
        (["run", "own-words"], "It is called 'own-wishes' now."),
        (["run", "bedside"], "write 'comity-bench-1/bedside'"),
        (["plan", "whoever-waits-longest"], "It is called 'comity-bench-1/priority-first' now."),
        (["draw", "ward-round"], "write 'comity-bench-1/ward-round'"),
        (["run", "comity-bench-1/bedsid"], "Did you mean 'comity-bench-1/bedside'?"),
        (["scenarios", "--set", "comity-bench"], "Did you mean 'comity-bench-1'?"),
        (["test", "--set", "comity-bench"], "Did you mean 'comity-bench-1'?"),
    ],
)
def test_a_former_or_misspelt_name_says_what_to_type(comity, words, remedy):
    said = comity(*words)
    assert said.code == 2
    assert remedy in " ".join(said.err.split())


def test_every_former_name_leads_to_what_ships():
    former = scenario_sets._RENAMED
    assert set(former.values()) <= set(shipped("scenario"))
    assert not set(former) & set(shipped("scenario"))


def test_a_file_of_ones_own_may_have_a_former_name(here):
    (here / "bedside").write_text("")
    assert find("scenario", "bedside")[0].name == "bedside"
    with pytest.raises(InputError, match="own-wishes"):
        find("scenario", "own-words")
