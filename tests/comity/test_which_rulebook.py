"""One rulebook decides a run: the one asked for, the scenario's, or the right one for those who take part."""

from __future__ import annotations

import pytest
from gliding import SCENARIO, gliding, written

from comity.live.start import as_seen
from comity.preparation import prepare
from comity.scenario import load_scenario

OPEN = SCENARIO.replace("rulebook: bruno2017\n", "")


@pytest.fixture
def amal(comity, monkeypatch, tmp_path_factory):
    """Somebody who is kept on this machine."""
    monkeypatch.setenv("COMITY_HOME", str(tmp_path_factory.mktemp("home")))
    assert comity("profile", "set", "amal", "culture=EGY", "gender=male").code == 0
    return "amal"


def decided(file, **asked):
    prepared = prepare(file, **asked)
    return prepared.rulebook.name, prepared.chosen.why


def test_an_example_goes_by_the_paper(here):
    assert decided(load_scenario("johanna"))[0] == "bruno2017"
    assert decided(load_scenario(written(here, OPEN)))[0] == "bruno2017"


def test_people_who_are_kept_are_met_by_evidence(here, amal):
    assert decided(load_scenario("johanna"), profiles={"johanna": amal}) == (
        "evidence",
        "the stored profile amal takes part",
    )


def test_real_robots_go_by_evidence(here):
    file = load_scenario(written(here, OPEN))
    assert decided(as_seen(file, gliding())) == ("evidence", "a real robot takes part")


def test_what_the_scenario_names_goes_before_who_takes_part(here, amal):
    named = load_scenario(written(here, OPEN + "rulebook: bruno2017-case2\n"))
    assert decided(named, profiles={"host": amal}, rulebook="bruno2017") == ("bruno2017", "asked for")
    named = load_scenario(written(here, OPEN + "rulebook: bruno2017\n"))
    assert decided(as_seen(named, gliding()), profiles={"host": amal}) == ("bruno2017", "the scenario's")


@pytest.mark.parametrize("command", [("infer",), ("explain", "conversational_distance")])
def test_one_value_goes_by_the_same_rulebook_as_a_run(comity, amal, command):
    assert comity(*command, amal, "--json").json["rulebook"] == "evidence"
    assert comity(*command, "arab_man", "--json").json["rulebook"] == "bruno2017"
    assert comity(*command, amal, "--rulebook", "bruno2017", "--json").json["rulebook"] == "bruno2017"


def test_men_and_women_who_are_kept_are_met_alike(comity, amal):
    """The paper's rules keep most men farther away than women; they do not decide about anybody real."""
    assert comity("profile", "set", "mona", "culture=EGY", "gender=female").code == 0
    near = {
        name: comity("infer", name, "--json").json["parameters"]["conversational_distance"]["value"]
        for name in (amal, "mona")
    }
    assert near["amal"] == near["mona"]


def test_a_run_says_which_rulebook_why_and_which_rules_go_by_a_group(comity, here):
    answer = comity("run", "johanna", "--out", "run", "--no-pictures", "--json").json
    assert answer["rulebook"] == "bruno2017"
    assert answer["rulebook_reason"]
    assert answer["group_rules"] == {
        "gender": [1, 2, 3, 4],
        "nationality": [*range(1, 5), *range(9, 14), *range(15, 21)],
    }
    again = comity("run", "run/scenario.yaml", "--out", "again", "--no-pictures").out
    assert again.strip().splitlines()[:2] == [
        "Rulebook bruno2017: the scenario's",
        "  gender in rules 1-4, nationality in rules 1-4, 9-13, 15-20",
    ]
