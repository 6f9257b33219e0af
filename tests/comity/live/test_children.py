"""A real robot goes to no child, nor to anybody who may be one, but in a study with consent."""

from __future__ import annotations

from itertools import product

import pytest
from gliding import Gliding

import comity
from comity_fis import InputError

SCENARIO = """schema_version: 1
name: one
place: {{width_m: 8, height_m: 6}}
robot: {{at_m: [1, 1]}}
adults_only: {adults_only}
child_study: {child_study}
people:
  anna: {{at_m: [3.0, 3.0], guardian_consent: {consent}, profile: {{name: anna{age}}}}}
goals: [{{greet: anna}}]
"""
AGES = {"": None, ", age: 17": 17, ", age: 18": 18, ", age: 40": 40}


CASES = [*product(AGES, *[("true", "false")] * 3)]


@pytest.mark.parametrize(("age", "adults_only", "child_study", "consent"), CASES)
def test_whom_a_real_robot_may_go_to(here, age, adults_only, child_study, consent):
    path = here / "one.scenario.yaml"
    text = SCENARIO.format(age=age, adults_only=adults_only, child_study=child_study, consent=consent)
    path.write_text(text, encoding="utf-8")
    robot = Gliding({"anna": (3.0, 3.0, 0.0)})
    years = AGES[age]
    may = (years is not None and years >= 18) or (child_study == consent == "true")
    may = may or (years is None and adults_only == "true")
    if may:
        assert comity.run(path, robot=robot).outcome == "success"
    else:
        with pytest.raises(InputError, match="adults before a real robot"):
            comity.run(path, robot=robot)
        assert robot.log == []
    assert comity.run(path).outcome == "success"  # the simulated one goes to everybody


@pytest.mark.parametrize(("age", "is_noted"), [(6, True), (17.9, True), (18, False), (40, False)])
def test_what_is_inferred_for_a_child_has_a_note(age, is_noted):
    for values in (comity.infer({"age": age}), comity.infer(age=age)):
        assert any("under 18" in note for note in values.notes) == is_noted


@pytest.mark.parametrize("rulebook", ["bruno2017", "evidence"])
@pytest.mark.parametrize("age", ["age: 9", "other: {age_band: under 18}"])
def test_a_run_notes_a_child_whatever_its_rules_read_and_its_own_scenario_still_knows(here, age, rulebook):
    """Also as a run that was passed on says it: the real robot refuses what the run wrote out."""
    text = SCENARIO.format(adults_only="true", child_study="false", consent="false", age=f", {age}")
    (here / "one.scenario.yaml").write_text(text)
    episode = comity.run("one.scenario.yaml", rulebook=rulebook, out="run")
    assert any("under 18" in note for note in episode.values["anna"].notes)
    robot = Gliding({"anna": (3.0, 3.0, 0.0)})
    with pytest.raises(InputError, match="adults before a real robot"):
        comity.run("run/scenario.yaml", robot=robot, adults_only=True)
    assert robot.log == []


@pytest.mark.parametrize("word", ["no", "false", 1, None])
def test_that_all_are_adults_is_stated_by_true_alone(here, word):
    text = SCENARIO.format(adults_only="false", child_study="false", consent="false", age="")
    (here / "one.scenario.yaml").write_text(text)
    robot = Gliding({"anna": (3.0, 3.0, 0.0)})
    with pytest.raises(InputError, match="True or False for adults_only"):
        comity.run("one.scenario.yaml", robot=robot, adults_only=word)
    assert robot.log == []


@pytest.fixture
def kid(comity, monkeypatch, tmp_path_factory):
    """A child who is kept on this machine, and of whom something was learnt before the age was known."""
    monkeypatch.setenv("COMITY_HOME", str(tmp_path_factory.mktemp("home")))
    assert comity("profile", "set", "kid", "culture=SWE").code == 0
    assert comity("profile", "ask", "kid", "--answer", "0.5", "--counts-as", "observation").code == 0
    assert comity("profile", "set", "kid", "age=9").code == 0
    return "kid"


def test_what_was_learnt_of_somebody_who_is_a_child_counts_for_nothing(comity, kid):
    told = comity("infer", kid, "--json").json["parameters"]["conversational_distance"]
    assert told["value"] == pytest.approx(0.825)
    assert "learnt" not in [part["origin"] for part in told["contributions"]]
    answer = comity("run", "johanna", "--as", f"johanna={kid}", "--no-pictures", "--json").json
    assert answer["visits"][0]["distance_target_m"] == pytest.approx(0.825)


@pytest.mark.parametrize(
    "command",
    [
        ("profile", "ask", "kid", "--answer", "0.5", "--counts-as", "observation"),
        ("profile", "observe", "kid", "--signal", "stepped_back", "--distance", "0.8"),
        ("visits", "kid", "--times", "1", "--wants", "0.5..0.6", "--keep"),
    ],
)
def test_nothing_is_learnt_about_children_by_any_door(comity, kid, command):
    said = comity(*command)
    assert said.code == 2
    assert "under 18" in said.err
