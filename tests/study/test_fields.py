"""The fields to report: what is on disk is filled in and right, and nothing else is made up."""

from __future__ import annotations

import io
import sys

import pandas as pd
import pytest

from comity.study.fields.reported_field import BLANKS, SECTIONS
from comity.study.fields.telling import TO_FILL

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
