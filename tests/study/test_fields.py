"""The fields to report: what is on disk is filled in and right, and nothing else is made up."""

from __future__ import annotations

import io
import sys

import pandas as pd
import pytest
from study.writing import population, study

from comity.study import Study
from comity.study.fields.reported_field import BLANKS, SECTIONS
from comity.study.fields.telling import TO_FILL
from comity.study.report.telling import number_text

COLLECTION = """schema_version: 1
name: near and far
medium: clip
consent: |
  You may stop at any time.
  Answers are kept under your code.
facts: [gender, age]
conditions: {near: Show the first film}
trials: 1
stop_says: asked_farther
questionnaires: [rosas]
"""


@pytest.fixture
def told(comity, here, monkeypatch):
    """The fields by name, as the command answers; sessions of some participants before that."""
    (here / "c.yaml").write_text(COLLECTION)
    sessions = ["--participants", 8, "--conditions", "near,far", "--groups", "x,y", "--out", "sessions"]
    comity("study", "sessions", *sessions)

    def hold(participant, *lines):
        monkeypatch.setattr(sys, "stdin", io.StringIO("".join(f"{line}\n" for line in lines)))
        words = ["c.yaml", "sessions", "--participant", participant, "--by", "Kim", "--at", "2026-11-02"]
        return comity("study", "collect", *words)

    def fields(*words):
        answer = comity("study", "fields", "c.yaml", "sessions", *words, "--json").json
        return answer, {one["field"]: one for one in answer["fields"]}

    return hold, fields


def sheet(first=3):
    """A stop distance and the 18 items under one condition."""
    return ["0.8", *[str(first + i % 3) for i in range(18)]]


def test_before_anyone_came_only_the_plan_is_known(told):
    _, fields = told
    answer, found = fields()
    assert found["Allocated"]["value"] == "8 (x 4, y 4)"
    assert found["Took part"]["value"] == "0; 0 answered all"
    assert "Reliability of rosas" not in found
    assert answer["blank"] == len(BLANKS) + 1  # and the confounds, without films


def test_what_was_collected_is_counted(told, here):
    hold, fields = told
    assert hold("P01", "yes", "female", "30", *sheet(), *sheet(5)).code == 0
    assert hold("P02", "yes", "male", "50", *sheet(2), *sheet(6)).code == 0
    assert hold("P03", "yes", "-", "-", "0.9").code == 1
    assert hold("P04", "no").code == 1
    answer, found = fields()
    groups = pd.read_csv(here / "sessions/allocation.csv").head(3)["group"].value_counts().sort_index()
    assert (
        found["Took part"]["value"]
        == "3 (" + ", ".join(f"{g} {n}" for g, n in groups.items()) + "); 2 answered all"
    )
    assert found["Gender"]["value"] == "female 1, male 1, undisclosed 1"
    assert found["Age"]["value"] == "2 from 30 to 50, mean 40.0, SD 14.1, undisclosed 1"
    assert found["Dates"]["value"] == "2026-11-02"
    assert found["Collected"]["value"] == "5 stop distances, 72 items asked, 0 of them left open"
    assert found["Stop distance"]["value"].endswith("read 5 by the experimenter")
    assert "> Answers are kept under your code." in found["Consent"]["value"]
    alphas = found["Reliability of rosas"]["value"]
    assert all(f"{name} " in alphas for name in ("warmth", "competence", "discomfort"))
    assert "P01" not in str(answer)


def test_what_only_the_lab_can_know_is_left_blank(told, comity, here):
    _, fields = told
    answer, found = fields()
    for one in BLANKS:
        assert found[one.name]["value"] is None
        assert found[one.name]["asks"] == one.asks
    assert all((one["value"] is None) <= bool(one["asks"]) for one in answer["fields"])
    assert [*dict.fromkeys(one["section"] for one in answer["fields"])] == list(SECTIONS)
    text = comity("study", "fields", "c.yaml", "sessions").out
    assert text.count(TO_FILL) == answer["blank"] + 1  # and the sentence that explains the mark


def test_films_that_were_shown_bring_their_confounds_along(told, comity):
    _, fields = told
    varied = "people.visited.profile=german_woman,arab_woman"
    made = comity("study", "clips", "johanna", "--vary", varied, "--out", "clips", "--json").json
    _, found = fields("--clips", "clips")
    listed = found["Possible confounds"]["value"].strip().splitlines()
    assert len(listed) == len(made["confounds"])
    assert listed[0].startswith("- episode_duration_s differs by ")


def test_a_file_that_the_lab_completes_is_never_written_again(told, comity, here):
    words = ["study", "fields", "c.yaml", "sessions", "--out", "reporting.md"]
    assert comity(*words).code == 0
    (here / "reporting.md").write_text("ours")
    assert comity(*words).code == 2
    assert (here / "reporting.md").read_text() == "ours"


@pytest.mark.parametrize(
    "words",
    [["c.yaml", "nowhere"], ["nobody.yaml", "sessions"], ["c.yaml", "sessions", "--clips", "nowhere"]],
)
@pytest.mark.usefixtures("told")
def test_what_is_not_there_is_refused(comity, words):
    said = comity("study", "fields", *words)
    assert said.code == 2
    assert "expected" in said.err


@pytest.fixture
def simulated(comity, here):
    """The fields of a small study of simulated visits, by section and name, as the command answers."""
    population(here / "people.yaml", wishes={"share": 1.0})
    factors = {"rulebook": ["bruno2017", "evidence"], "robot.sensor.noise_m": [0.02]}
    study(here / "s.yaml", population="people.yaml", factors=factors, seeds=2, about="A trial.")
    assert comity("study", "run", "s.yaml", "--out", "out").code == 0
    return fields_of_visits(comity)


def fields_of_visits(comity, *words):
    answer = comity("study", "fields", "out", *words, "--json").json
    found = {(one["section"], one["field"]): one for one in answer["fields"]}
    assert len(found) == len(answer["fields"])
    return answer, found


def test_a_simulated_study_has_every_field_filled_inapplicable_or_for_the_lab(simulated):
    answer, found = simulated
    states = [(one["value"] is None, bool(one["asks"]), one["applies"]) for one in answer["fields"]]
    counts = [states.count(one) for one in ((False, False, True), (True, True, True), (False, False, False))]
    assert counts == [answer["filled"], answer["blank"], answer["inapplicable"]]
    assert sum(counts) == len(states)
    assert {(one.section, one.name) for one in BLANKS} <= set(found)
    lab = {name for (_, name), one in found.items() if one["value"] is None}
    assert lab == {"Question and hypotheses", "Registration", "Reason for the number", "Availability"}
    assert not found["Participants", "Recruitment"]["applies"]


def test_what_a_simulated_study_is_said_to_be_is_what_its_folder_holds(simulated, comity):
    _, found = simulated
    said = {name: one["value"] for (_, name), one in found.items()}
    assert said["About"] == "A trial."
    assert said["Individuals"].startswith("4 simulated individuals, drawn with the seed 0; 4 of them")
    assert "swedish_women, 2: culture SWE, gender female; comfort: middle_m 0.8" in said["Individuals"]
    assert said["Conditions"].splitlines()[2:] == [
        "- 1: rulebook bruno2017, robot_sensor_noise_m 0.02",
        "- 2: rulebook evidence, robot_sensor_noise_m 0.02",
    ]
    assert said["Collected"] == "16 rows of 16 episodes; the study is done"
    rows = Study.load("out").rows
    assert said["Deviations"].startswith(f"outcomes of the visits: greeted {len(rows)};")
    lengths = [float(row["episode_duration_s"]) for row in rows]
    assert said["Duration"].startswith(f"{sum(lengths) / len(lengths):.1f} s ")
    compared = comity(
        "study", "compare", "out", "--factor", "rulebook", "bruno2017", "evidence", "--json"
    ).json
    overall = [one for one in compared["differences"] if one["group"] is None]
    lines = [line for line in said["Results"].splitlines() if "difference" in line and line[:1] == "-"]
    assert len(lines) == len(overall) > 0
    for line, one in zip(lines, overall, strict=True):
        assert f"difference {number_text(one['difference']['mean'], signed=True)} [" in line


def test_of_individuals_from_a_table_the_lab_says_how_they_were_found(here, comity):
    (here / "people.csv").write_text("individual,culture\nAnna,SWE\n", "utf-8")
    population(here / "people.yaml", groups={}, table="people.csv")
    study(here / "s.yaml", population="people.yaml")
    assert comity("study", "run", "s.yaml", "--out", "out").code == 0
    answer, found = fields_of_visits(comity)
    assert found["Participants", "Recruitment"]["value"] is None
    assert not found["Procedure", "Instructions"]["applies"]
    assert "Anna" not in str(answer)


def test_a_study_without_individuals_has_its_fields(here, comity):
    study(here / "s.yaml", seeds=1)
    assert comity("study", "run", "s.yaml", "--out", "out").code == 0
    _, found = fields_of_visits(comity)
    assert found["Participants", "Individuals"]["value"].startswith("none")
    assert found["Data and analysis", "Collected"]["value"].startswith("1 row of 1 episode")


OTHER_THINGS = (
    ["out", "out"],
    ["out", "--clips", "out"],
    ["."],
    ["s.yaml"],
    ["out", "--study", "other.yaml"],
    ["out", "--study", "nowhere.yaml"],
)


@pytest.mark.usefixtures("simulated")
def test_fields_of_what_is_no_simulated_study_or_of_a_changed_one_are_refused(here, comity):
    study(here / "other.yaml", population="people.yaml", seeds=5)
    for words in OTHER_THINGS:
        said = comity("study", "fields", *words)
        assert (said.code, "expected" in said.err) == (2, True)
    study(here / "s.yaml", population="people.yaml", seeds=3)
    said = comity("study", "fields", "out")
    assert said.code == 2
    assert said.err.startswith(f"comity: {here / 's.yaml'}: ")
