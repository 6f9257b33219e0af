"""What the command line answers: the paper's numbers, the documented keys, the schemas, the reasons."""

from __future__ import annotations

import re
from pathlib import Path

import jsonschema
import pytest

from comity.commands.schema import Kind
from comity.people.consents import ConsentFile
from comity.people.learnt_file import LearntFile
from comity.people.profile import Profile
from comity.scenario import Scenario
from comity.specification.binding_file import BindingFile
from comity.study.collecting.collection_file import CollectionFile
from comity.study.population_file import PopulationFile
from comity.study.questionnaires.questionnaire_file import QuestionnaireFile
from comity.study.study_file import StudyFile
from comity.system.library import shipped
from comity_executor.speech.wordings_file import WordingsFile
from comity_fis import InputError
from comity_fis.rulebook.models import RulebookModel
from comity_fis.validation.yaml_file import parse_yaml, read_yaml
from comity_sim2d import shipped_maps
from comity_sim2d.maps.file import MapFile
from comity_sim2d.maps.ros_map import PlacesFile

PAPER_CM = {
    ("bruno2017-case1", 38, None): 69.9,
    ("bruno2017-case1", 67, None): 100.7,
    ("bruno2017-case2", 38, "female"): 63.63,
    ("bruno2017-case2", 67, "female"): 84.7,
    ("bruno2017-case2", 38, "male"): 87.51,
    ("bruno2017-case2", 67, "male"): 109.34,
}


@pytest.fixture
def distance_cm(comity):
    def ask(rulebook: str, individualism: float, gender: str | None, mode: str) -> float:
        words = ["infer", "--rulebook", rulebook, "--set", f"individualism={individualism}", "--mode", mode]
        said = comity(*words, *(["--set", f"gender={gender}"] if gender else []), "--json")
        assert said.code == 0, said.err
        return 100 * said.json["parameters"]["conversational_distance"]["value"]

    return ask


@pytest.mark.parametrize("case", PAPER_CM, ids=str)
def test_the_papers_six_numbers_come_out(distance_cm, case):
    """Within 0.2 cm as MATLAB computes, within 0.4 cm exactly; scikit-fuzzy agrees with the exact answer."""
    exact = distance_cm(*case, "exact")
    assert distance_cm(*case, "matlab") == pytest.approx(PAPER_CM[case], abs=0.2)
    assert exact == pytest.approx(PAPER_CM[case], abs=0.4)
    assert distance_cm(*case, "skfuzzy") == pytest.approx(exact, abs=0.05)


@pytest.mark.parametrize("individualism", [38, 67])
def test_somebody_who_keeps_their_gender_to_themselves_is_met_in_between(distance_cm, individualism):
    woman, man, undisclosed = (
        distance_cm("bruno2017-case2", individualism, gender, "exact")
        for gender in ("female", "male", "unknown")
    )
    assert woman < undisclosed < man


SHOWN = {
    "infer": ["infer", "german_woman"],
    "explain": ["explain", "greeting_gesture", "japanese_woman"],
    "plan": ["plan", "two-visits"],
    "run": ["run", "two-visits", "--out", "run", "--as", "guest=one_life", "--at", "2012"],
    "profile-show": ["profile", "show", "one_life", "--at", "2012"],
    "life": ["profile", "show", "one_life", "--years", "2003..2006"],
    "trace": ["trace", "run"],
    "draw": ["draw", "office"],
    "paper": ["paper"],
}


@pytest.mark.parametrize("kind", SHOWN)
def test_every_answer_keeps_to_its_schema(comity, kind):
    if kind == "trace":
        comity(*SHOWN["run"], "--json")
    answer, schema = comity(*SHOWN[kind], "--json").json, comity("schema", kind).json
    jsonschema.Draft202012Validator.check_schema(schema)
    jsonschema.validate(answer, schema)


@pytest.mark.parametrize("kind", Kind)
def test_every_kind_has_a_schema(comity, kind):
    said = comity("schema", kind)
    assert said.code == 0, said.err
    jsonschema.Draft202012Validator.check_schema(said.json)


FILES = {
    Kind.SCENARIO: Scenario,
    Kind.MAP: MapFile,
    Kind.PLACES: PlacesFile,
    Kind.PROFILE: Profile,
    Kind.RULEBOOK: RulebookModel,
    Kind.BINDING: BindingFile,
    Kind.LEARNT: LearntFile,
    Kind.CONSENT: ConsentFile,
    Kind.WORDINGS: WordingsFile,
    Kind.STUDY: StudyFile,
    Kind.POPULATION: PopulationFile,
    Kind.QUESTIONNAIRE: QuestionnaireFile,
    Kind.COLLECTION: CollectionFile,
}


@pytest.mark.parametrize("kind", Kind)
def test_an_empty_file_is_told_the_command_that_prints_what_it_may_hold(comity, kind):
    """Every kind of file, which are those whose schema has a version, and no answer."""
    schema = comity("schema", kind).json
    assert (kind in FILES) == ("schema_version" in schema.get("properties", {}))
    if kind in FILES:
        with pytest.raises(InputError) as refused:
            parse_yaml("", Path("a.yaml"), "a.yaml").check(FILES[kind])
        (named,) = re.findall(r"`comity schema (.*?)`", refused.value.remedy)
        assert comity("schema", named).json == schema


@pytest.mark.parametrize("kind", ["scenario", "profile"])
def test_every_shipped_file_keeps_to_its_schema(comity, kind):
    schema = _checked(comity("schema", kind).json)
    for path in shipped(kind).values():
        schema.validate(read_yaml(path).data)


def test_every_shipped_map_keeps_to_its_schema(comity):
    schema = _checked(comity("schema", "map").json)
    for path in shipped_maps().values():
        schema.validate(read_yaml(path).data)


def _checked(schema):
    """A validator of a schema that was looked at once: `jsonschema.validate` does so for every file."""
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


def test_the_run_folder_holds_what_the_reference_says(comity, here):
    answer = comity("run", "--out", "run", "--json").json
    assert answer["status"] == "done"
    assert set(answer["files"]) == {path.name for path in (here / "run").iterdir()} | {"run.json"}
    assert set(answer["files"]) == {
        "run.json",
        "scenario.yaml",
        "plan.json",
        "trace.jsonl",
        "frames.csv",
        "readings.csv",
        "blackboard.csv",
        "picture.png",
        "replay.html",
    }


def test_run_json_on_disk_is_the_answer(comity, here):
    import json

    answer = comity("run", "--out", "run", "--json").json
    assert json.loads((here / "run" / "run.json").read_text()) == answer


def test_an_episode_that_breaks_leaves_a_readable_folder(comity, here, monkeypatch):
    """What was written stays, and run.json says `crashed` and why."""
    import json

    from comity_sim2d import World

    def breaks(world):
        raise RuntimeError("a wheel came off")

    monkeypatch.setattr(World, "step", breaks)
    with pytest.raises(RuntimeError, match="a wheel came off"):
        comity("run", "--out", "run")
    account = json.loads((here / "run" / "run.json").read_text())
    assert account["status"] == "crashed"
    assert "a wheel came off" in account["error"]
    assert {"scenario.yaml", "plan.json"} <= set(account["files"])


def test_pddl_is_written_for_other_planners_and_never_over_something_else(comity, here):
    assert comity("plan", "two-visits", "--pddl", "pddl", "--json").code == 0
    assert "(define (domain" in (here / "pddl" / "domain.pddl").read_text()
    assert "(define (problem" in (here / "pddl" / "problem.pddl").read_text()
    (here / "mine").mkdir()
    (here / "mine" / "domain.pddl").write_text("(define (domain mine))")
    said = comity("plan", "two-visits", "--pddl", "mine")
    assert said.code == 2
    assert (here / "mine" / "domain.pddl").read_text() == "(define (domain mine))"
    assert [path.name for path in (here / "mine").iterdir()] == ["domain.pddl"]


def test_pddl_says_what_of_a_scenario_it_leaves_out(comity, here):
    """Whom no plan can serve, who was greeted before, what happens on the way, and deadlines."""
    said = {
        "comity-bench-1/ward-round": "no plan can serve 'shut in'",
        "comity-bench-1/greeted-already": "'host' was greeted already",
        "changes-her-mind": "what happens on the way, from 2 s on",
        "in-a-hurry": "'host' must be greeted within 23 s",
    }
    for scenario, words in said.items():
        comity("plan", scenario, "--pddl", words)
        assert f"; not stated below: {words}" in (here / words / "problem.pddl").read_text()


def test_every_list_names_what_ships(comity):
    for kind in ("profiles", "scenarios", "rulebooks"):
        rows = comity(kind, "--json").json[kind]
        assert all(row["name"] and row["about"] for row in rows)
        text = comity(kind).out
        assert all(row["name"] in text for row in rows)


def test_the_trace_can_be_asked_for_a_node_and_a_time(comity):
    comity("run", "--out", "run", "--json")
    events = comity("trace", "run", "--node", "docked?", "--between", 5, 100, "--json").json["events"]
    assert [(event["node"], event["status"]) for event in events] == [("docked?(johanna)", "success")]
    assert "□ say(johanna)  success" in comity("trace", "run").out
    before = comity("trace", "run", "--at", 1).out
    assert "□ Navigate_to_user(johanna)  running" in before
    assert "say(johanna)  " not in before


def test_halts_lead_from_the_reading_back_to_the_culture(comity):
    """`because` names the reading, the condition, the step, the parameter, the rule and the variables."""
    comity("run", "--out", "run", "--json")
    events = comity("trace", "run", "--json").json["events"]
    halted = next(event for event in events if event["node"] == "Dock_to_user(johanna)" and event["halt"])
    assert halted["halt"] == "achieved_early"
    kinds = [cause["kind"] for cause in halted["because"]]
    assert kinds[:2] == ["reading", "condition"]
    assert {"step", "parameter", "rule", "variable"} <= set(kinds)


def test_names_of_people_are_never_read_as_markup(comity, here):
    text = shipped("scenario")["johanna"].read_text().replace("johanna:\n", "'[red]<b>x':\n")
    text = text.replace("greet: johanna", "greet: '[red]<b>x'")
    (here / "odd.scenario.yaml").write_text(text)
    said = comity("run", "odd.scenario.yaml")
    assert said.code == 0, said.err
    assert "[red]<b>x" in said.out
