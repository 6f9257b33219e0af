"""The paper's heterogeneity challenge: a variable of each level of measurement reaches an action."""

from __future__ import annotations

import pytest

import comity as chain
from comity.people.profile import load_profile
from comity_fis import load_rulebook

FACTS = {"gender": "female", "education": 6, "latitude": 44.4, "age": 72}
OTHERS = {"gender": "male", "education": 2, "latitude": 5.0, "age": 24}


@pytest.fixture(scope="module")
def visits(tmp_path_factory):
    """One episode with all facts, and one for each fact that is another."""

    def visit(facts):
        profile = tmp_path_factory.mktemp("profile") / "someone.yaml"
        lines = "".join(f"{name}: {fact}\n" for name, fact in facts.items())
        profile.write_text(f"schema_version: 1\nname: someone\n{lines}")
        return chain.run("johanna", profiles={"johanna": str(profile)}, rulebook="illustrative-levels")

    changed = {name: visit({**FACTS, name: other}) for name, other in OTHERS.items()}
    return {"as stated": visit(FACTS), **changed}


def test_the_shipped_profile_states_one_fact_at_each_level():
    facts = load_profile("four_levels").profile.facts()
    variables = load_rulebook("illustrative-levels").variables
    assert facts == FACTS
    assert {name: str(variables[name].level) for name in facts} == {
        "gender": "nominal",
        "education": "ordinal",
        "latitude": "interval",
        "age": "ratio",
    }


def test_changing_any_one_variable_changes_the_episode(visits):
    assert {episode.outcome for episode in visits.values()} == {"success"}
    assert len({episode.trace_sha256 for episode in visits.values()}) == 5


def test_each_variable_changes_what_its_rules_decide(visits):
    met = {name: episode.visits[0] for name, episode in visits.items()}
    stated = met["as stated"]
    assert stated.greeting == ("say", "nod")
    assert met["gender"].greeting == ("say", "wave")
    assert met["age"].greeting == ("say",)
    assert abs(stated.docked_at.bearing_deg) == pytest.approx(78.3, abs=1)
    assert abs(met["education"].docked_at.bearing_deg) < 15
    assert stated.docked_at.distance_m == pytest.approx(0.85, abs=0.01)
    assert met["latitude"].docked_at.distance_m == pytest.approx(0.577, abs=0.01)


def test_the_shipped_profile_runs_from_the_command_line(comity, here):
    said = comity(
        "run", "johanna", "--rulebook", "illustrative-levels", "--as", "johanna=four_levels", "--json"
    )
    assert said.code == 0
    assert said.json["rulebook"] == "illustrative-levels"


@pytest.mark.parametrize(
    ("facts", "expected"),
    [
        ({"gender": "female", "education": 1, "latitude": 3, "age": 7}, "gestural"),
        ({"gender": "female", "education": 1, "latitude": 3, "age": 72}, "both"),
        ({"gender": "male", "education": 1, "latitude": 3, "age": 7}, "both"),
        ({"gender": "female", "education": 5, "latitude": 3, "age": 7}, "both"),
        ({"gender": "female", "education": 1, "latitude": 50, "age": 7}, "both"),
    ],
)
def test_one_rule_reads_all_four_levels(facts, expected):
    assert load_rulebook("illustrative-levels").infer(facts)["greeting_modality"].value == expected


def test_the_rulebook_says_loudly_that_it_claims_nothing():
    rulebook = load_rulebook("illustrative-levels")
    assert rulebook.description.startswith("ILLUSTRATIVE, NO CLAIM ABOUT PEOPLE")
    assert {rule.evidence for rule in rulebook.rules} == {"design"}
    assert all("Arbitrary on purpose" in rule.source for rule in rulebook.rules)


def test_other_rulebooks_leave_the_new_facts_aside(comity):
    said = comity("infer", "four_levels", "--json")
    assert said.code == 0
    assert "education" not in said.json["inputs"]


@pytest.mark.parametrize(
    ("word", "expected"),
    [
        ("education=9", "0 to 8"),
        ("education=bachelr", "Did you mean 'bachelor'?"),
        ("latitude=95", "-90..90"),
    ],
)
def test_a_fact_outside_its_scale_is_refused(comity, word, expected):
    said = comity("infer", "--rulebook", "illustrative-levels", "--set", word)
    assert said.code == 2
    assert expected in said.err


@pytest.mark.parametrize("line", ["education: 9", "education: six", "latitude: 100"])
def test_a_profile_outside_the_scale_is_refused_with_its_line(comity, here, line):
    (here / "x.yaml").write_text(f"schema_version: 1\nname: x\n{line}\n")
    said = comity("infer", "x.yaml")
    assert said.code == 2
    assert "x.yaml:3" in said.err


def test_a_coercion_is_shown_with_the_value(comity):
    said = comity("infer", "german_woman")
    assert "individualism 67 (treated as interval level)" in said.out
    coercions = comity("infer", "german_woman", "--json").json["coercions"]
    assert coercions["individualism"]["to"] == "interval"
    assert coercions["individualism"]["reason"]


def test_desirability_is_in_the_answer_as_points(comity):
    parameters = comity("infer", "german_woman", "--json").json["parameters"]
    curve = parameters["conversational_distance"]["curve"]
    assert (curve[0][0], curve[-1][0]) == (0.45, 1.2)
    assert max(degree for _, degree in curve) == pytest.approx(0.9945, abs=1e-4)
    assert parameters["greeting_gesture"]["curve"] is None
