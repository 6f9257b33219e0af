"""A behaviour parameter that no action reads is noted, wherever its value is shown."""

from __future__ import annotations

from importlib.resources import files

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import comity as front_door
from comity_fis import load_rulebook, shipped_rulebooks

ONCE = settings(max_examples=8, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
PARAMETER = """
  {name}:
    kind: {kind}
    level: ratio
    unit: "1"
    rules: [0.0, 1.0]
    ask: [0.0, 1.0]
    terms:
      little: {{trapezoid: [0, 0, 0.2, 0.5]}}
      much: {{trapezoid: [0.2, 0.5, 1, 1]}}
    shapes: design
    neutral: 0.3
    spread: 0.2
    reasons: {{ranges: Our choice., terms: Our choice., neutral: Our choice., spread: Our choice.}}
"""
NAMES = st.lists(st.from_regex(r"[a-z]{3,8}_x", fullmatch=True), min_size=1, max_size=2, unique=True)


@ONCE
@given(names=NAMES, kind=st.sampled_from(["behaviour", "action"]))
def test_every_door_notes_the_behaviour_parameters_that_no_action_reads(names, kind, here, comity):
    added = "".join(PARAMETER.format(name=name, kind=kind) for name in names)
    written = files("comity_fis").joinpath("rulebooks/bruno2017.yaml").read_text(encoding="utf-8")
    (here / "own.yaml").write_text(written.replace("\nparameters:\n", f"\nparameters:\n{added}", 1))
    noted = dict.fromkeys(names, kind == "behaviour")
    answers = [
        comity("infer", "arab_woman", "--rulebook", "own.yaml", "--json").json["notes"],
        comity("plan", "johanna", "--rulebook", "own.yaml", "--json").json["notes"],
        front_door.infer("arab_woman", rulebook="own.yaml").notes,
    ]
    for notes in answers:
        assert {name: any(note.startswith(f"{name}:") for note in notes) for name in names} == noted


def test_the_steps_of_a_plan_have_the_values_that_a_robot_receives(comity):
    values = comity("infer", "german_woman", "--rulebook", "evidence", "--json").json["parameters"]
    plan = comity("plan", "johanna", "--as", "johanna=german_woman", "--rulebook", "evidence", "--json").json
    assert plan["steps"]
    for step in plan["steps"]:
        assert step["other_parameters"]["mutual_gaze"] == values["mutual_gaze"]["value"]
        assert "approach_speed" not in step["other_parameters"]


def test_a_run_notes_it_too(here, comity):
    values = comity("run", "johanna", "--rulebook", "evidence", "--json").json["values"]
    assert [note.split(":")[0] for note in values["johanna"]["notes"][:2]] == ["bow_extent", "mutual_gaze"]


def test_a_rulebook_that_is_not_for_visits_gets_no_note():
    for name in shipped_rulebooks():
        if "conversational_distance" not in load_rulebook(name).parameters:
            assert not front_door.infer(rulebook=name).notes
