"""`comity plan --domain`: one JSON object, files of ours only, and the documented exit codes."""

from __future__ import annotations

import re
from itertools import pairwise
from pathlib import Path

import jsonschema
import pytest
import yaml

from comity.people.learnt_file import LearntFile
from comity.people.profile import Profile
from comity.scenario import Scenario
from comity.specification.binding_file import BindingFile
from comity_fis import InputError
from comity_fis.validation.yaml_file import parse_yaml
from comity_sim2d.maps.file import MapFile

PAGE = Path(__file__).parents[2] / "docs" / "how-to" / "use-a-custom-domain.md"
WAITER = ("plan", "--domain", "waiter.pddl", "--problem", "evening.pddl")


@pytest.fixture
def waiter(here):
    """The files of the how-to page."""
    text = PAGE.read_text(encoding="utf-8")
    for name, content in re.findall(r"^```\w+ (\S+)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL):
        (here / name).write_text(content)
    return here


def test_the_answer_and_both_bindings_keep_to_their_schemas(comity, waiter):
    said = comity(*WAITER, "--bind", "waiter.yaml", "--pddl", "out", "--json")
    assert (said.code, said.err) == (0, "")
    jsonschema.validate(said.json, comity("schema", "plan").json)
    assert all(Path(file).is_file() for file in said.json["own"]["files"])
    schema = comity("schema", "binding").json
    jsonschema.Draft202012Validator.check_schema(schema)
    for name in ("waiter.yaml", "museum.yaml"):
        jsonschema.validate(yaml.safe_load((waiter / name).read_text()), schema)


def test_the_text_says_every_step_and_what_it_costs(comity, waiter):
    answer = comity(*WAITER, "--bind", "waiter.yaml", "--json").json
    text = comity(*WAITER, "--bind", "waiter.yaml").out
    for step in answer["steps"]:
        assert f"{step['action']}({', '.join(step['arguments'])})   cost {step['cost']}" in text


def test_people_whose_facts_have_dates_are_taken_on_the_bindings_day(comity, waiter):
    """A day in the binding; without one today, where somebody's facts need it."""
    text = (waiter / "waiter.yaml").read_text().replace("profile: british_elder", "profile: one_life")

    def speed(at):
        (waiter / "dated.yaml").write_text(f"{at}{text}")
        said = comity(*WAITER, "--bind", "dated.yaml", "--json")
        assert said.code == 0, said.err
        (speed,) = (
            step["parameters"]["approach_speed"]
            for step in said.json["steps"]
            if step["action"] == "approach" and "emma" in step["arguments"]
        )
        return speed

    assert speed("at: 2009-01-01\n") > speed("at: 2022-01-01\n") == speed("")


def test_what_somebody_else_wrote_is_never_overwritten(comity, waiter):
    (waiter / "mine").mkdir()
    (waiter / "mine" / "domain.pddl").write_text("(define (domain mine))")
    said = comity(*WAITER, "--pddl", "mine")
    assert said.code == 2
    assert (waiter / "mine" / "domain.pddl").read_text() == "(define (domain mine))"


@pytest.mark.parametrize(
    ("words", "code", "said"),
    [
        (("plan",), 2, "SCENARIO: expected a scenario"),
        (("plan", "--domain", "waiter.pddl"), 2, "Add --problem FILE.pddl"),
        (("plan", "--bind", "waiter.yaml"), 2, "Add --domain FILE.pddl"),
        (("plan", "johanna", *WAITER[1:]), 2, "SCENARIO: expected either a scenario or --domain"),
        ((*WAITER, "--as", "aiko=unknown"), 2, "Add --bind FILE.yaml"),
        ((*WAITER, "--rulebook", "bruno2017"), 2, "Add --bind FILE.yaml"),
        (("plan", "--domain", "evening.pddl", "--problem", "waiter.pddl"), 2, "seem to be swapped"),
        (("plan", "--domain", "no.pddl", "--problem", "evening.pddl"), 2, "no such file"),
        ((*WAITER, "--bind", "no.yaml"), 2, "no such file"),
        ((*WAITER, "--bind", "evening.pddl"), 2, "evening.pddl"),
        ((*WAITER, "--limit", "0"), 2, "from 0.1 to 86400 seconds"),
        ((*WAITER, "--limit", "nan"), 2, "from 0.1 to 86400 seconds"),
        (("plan", "--domain", "waiter.pddl", "--problem", "stuck.pddl"), 1, "no plan reaches the goal"),
    ],
)
def test_it_ends_as_documented_and_writes_nothing(comity, waiter, words, code, said):
    stuck = (waiter / "evening.pddl").read_text().replace("(hands-are empty)", "")
    (waiter / "stuck.pddl").write_text(stuck)
    before = sorted(waiter.iterdir())
    answer = comity(*words)
    assert answer.code == code
    assert answer.out == ""
    assert said in answer.err
    assert sorted(waiter.iterdir()) == before


ASKED = {
    "why": ("--why", "greet(aiko)"),
    "stability": ("--stability",),
    "diff": ("--as", "aiko=arab_man", "--diff"),
}


@pytest.mark.parametrize("asked", ASKED)
def test_what_can_be_asked_of_a_scenario_can_be_asked_of_a_custom_domain(comity, waiter, asked):
    said = comity(*WAITER, "--bind", "waiter.yaml", *ASKED[asked], "--json")
    assert (said.code, said.err) == (0, "")
    jsonschema.validate(said.json, comity("schema", "plan").json)
    assert said.json[asked]
    text = comity(*WAITER, "--bind", "waiter.yaml", *ASKED[asked])
    assert (text.code, text.err) == (0, "")
    heading = {"why": "If that were forbidden", "stability": "Stability: ", "diff": "What costs more or less"}
    assert heading[asked] in text.out


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (("--why", "bow(aiko)"), "is for them: "),
        (("--why", "greet"), "Say which: "),
        (("--diff",), "Add --as OBJECT=PROFILE"),
        (("--as", "ako=german_man"), "Did you mean 'aiko'?"),
        (("--as", "nobody=german_man"), "got 'nobody'. Known are: aiko, emma."),
        (("--as", "counter=german_man"), "--as: expected an object that a `person` of the binding may be"),
        (("--as", "aiko=germn_man"), "Did you mean 'german_man'?"),
        (("--rulebook", "brno2017"), "Did you mean 'bruno2017'?"),
        (("--seed", "3"), "nothing in PDDL is left to chance"),
        (("--validate",), "only the plan of a scenario is validated"),
        (("--at", "yesterday"), "--at"),
    ],
)
def test_what_cannot_be_answered_is_refused_for_its_own_reason(comity, waiter, words, complaint):
    said = comity(*WAITER, "--bind", "waiter.yaml", *words)
    assert said.code == 2
    assert complaint in said.err
    assert "Traceback" not in said.err


@pytest.mark.parametrize("words", [("--stability",), ("--as", "aiko=german_man"), ("--rulebook", "evidence")])
def test_without_a_binding_the_refusal_asks_for_one(comity, waiter, words):
    said = comity(*WAITER, *words)
    assert said.code == 2
    assert f"comity: {words[0]}: expected a binding, got none. Add --bind FILE.yaml" in said.err


def test_where_there_is_no_plan_json_says_so_in_one_object(comity, waiter):
    """As for a scenario: exit code 1, the documented keys, and why."""
    text = (waiter / "evening.pddl").read_text().replace("(hands-are empty)", "")
    (waiter / "evening.pddl").write_text(text)
    said = comity(*WAITER, "--bind", "waiter.yaml", "--json")
    assert (said.code, said.err) == (1, "")
    jsonschema.validate(said.json, comity("schema", "plan").json)
    assert (said.json["solved"], said.json["engine"], said.json["steps"]) == (False, "none", [])
    assert said.json["own"]["people"] == ["aiko", "emma"]
    assert [said.json[key] for key in ("cost", "bound", "gap")] == [None, None, None]
    plain = comity(*WAITER, "--bind", "waiter.yaml")
    assert plain.code == 1
    assert f"{said.json['failure']['reason']}. {said.json['failure']['remedy']}" in plain.err


@pytest.fixture
def hanoi(here):
    """Fourteen discs, whose only plan has 16,383 steps: no engine has it in a tenth of a second."""
    discs = [f"d{i}" for i in range(14)]
    (here / "hanoi.pddl").write_text(
        """(define (domain hanoi) (:requirements :strips)
  (:predicates (clear ?x) (on ?x ?y) (smaller ?x ?y))
  (:action move :parameters (?disc ?from ?to)
    :precondition (and (smaller ?disc ?to) (on ?disc ?from) (clear ?disc) (clear ?to))
    :effect (and (clear ?from) (on ?disc ?to) (not (on ?disc ?from)) (not (clear ?to)))))"""
    )
    sizes = [f"(smaller {disc} {peg})" for disc in discs for peg in ("p1", "p2", "p3")]
    sizes += [f"(smaller {small} {large})" for i, large in enumerate(discs) for small in discs[:i]]

    def tower(peg: str) -> str:
        return " ".join(f"(on {disc} {below})" for disc, below in pairwise([*discs, peg]))

    (here / "tower.pddl").write_text(
        f"(define (problem tower) (:domain hanoi) (:objects {' '.join(discs)} p1 p2 p3)"
        f" (:init {' '.join(sizes)} {tower('p1')} (clear d0) (clear p2) (clear p3))"
        f" (:goal (and {tower('p3')})))"
    )


def test_an_answer_that_a_limit_ended_names_the_option_that_gives_more(comity, hanoi):
    """And claims nothing that another machine may not find."""
    said = comity("plan", "--domain", "hanoi.pddl", "--problem", "tower.pddl", "--limit", "0.1", "--json")
    assert "add `--limit 0.4`: it is 0.1 now, in seconds" in said.json["failure"]["remedy"]
    assert not said.json["reproducible"]


MUGS = ("plan", "--domain", "mugs.pddl", "--problem", "three.pddl")


@pytest.fixture
def mugs(here):
    """A numeric domain, one of whose arguments is a person."""
    pytest.importorskip("up_aries")
    (here / "mugs.pddl").write_text(
        """(define (domain mugs) (:requirements :strips :numeric-fluents)
  (:predicates (done) (for ?p)) (:functions (mugs))
  (:action wash :parameters (?p) :precondition (for ?p) :effect (increase (mugs) 1))
  (:action stop :parameters () :precondition (>= (mugs) 3) :effect (done)))"""
    )
    (here / "three.pddl").write_text(
        "(define (problem p) (:domain mugs) (:objects ann) (:init (for ann) (= (mugs) 0)) (:goal (done)))"
    )
    (here / "mugs.yaml").write_text(
        "schema_version: 1\npeople: {ann: german_woman}\n"
        "actions: {wash: {person: p, parameters: [conversational_distance]}}\n"
    )
    return here


ASKED_OF_MUGS = ((), ("--why", "1"), ("--as", "ann=arab_man", "--diff"))


@pytest.mark.parametrize("asked", ASKED_OF_MUGS)
def test_costs_that_an_engine_does_not_tell_are_not_claimed(comity, mugs, asked):
    said = comity(*MUGS, "--bind", "mugs.yaml", *asked)
    assert (said.code, said.err) == (0, "")
    assert "cost 0" not in said.out
    if "--why" not in asked:
        assert "4 steps, found by aries, which tells no costs" in " ".join(said.out.split())


@pytest.mark.parametrize("asked", ASKED_OF_MUGS)
def test_costs_that_an_engine_does_not_tell_are_null_in_json(comity, mugs, asked):
    said = comity(*MUGS, "--bind", "mugs.yaml", *asked, "--json")
    assert (said.code, said.err) == (0, "")
    jsonschema.validate(said.json, comity("schema", "plan").json)
    assert [said.json[key] for key in ("cost", "bound", "gap")] == [None, None, None]
    assert {step["cost"] for step in said.json["steps"]} == {None}
    if "--diff" in asked:
        assert said.json["diff"]["cost"] is None


def test_a_limit_beside_a_scenario_is_refused_and_has_its_place_named(comity):
    said = comity("plan", "two-visits", "--limit", "3")
    assert said.code == 2
    assert "limits: {planning_s: 10}" in " ".join(said.err.split())


@pytest.mark.parametrize(
    ("option", "file"),
    [("--domain", "waiter.pddl"), ("--problem", "evening.pddl"), ("--bind", "waiter.yaml")],
)
def test_beside_a_scenario_the_option_that_was_given_is_named(comity, waiter, option, file):
    said = comity("plan", "two-visits", option, file)
    assert said.code == 2
    assert f"expected either a scenario or {option}, got both" in said.err


@pytest.mark.parametrize("model", [BindingFile, LearntFile, MapFile, Profile, Scenario])
def test_a_file_that_holds_nothing_names_the_command_that_prints_what_it_may_hold(comity, model):
    with pytest.raises(InputError) as refused:
        parse_yaml("", Path("empty.yaml"), "empty.yaml").check(model)
    (words,) = re.findall(r"`comity (schema \w+)`", refused.value.remedy)
    assert set(model.model_fields) <= set(comity(*words.split()).json["properties"])
