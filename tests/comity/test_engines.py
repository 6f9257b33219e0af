"""Another engine of unified-planning plans and runs what Comity's own does, with parameters and reasons."""

from __future__ import annotations

import pytest
import yaml
from downward import needs_fast_downward

OTHER = ("--engine", "fast-downward-opt")


@pytest.fixture
def own_rules(here, comity):
    """The evidence rulebook with two rules more: everybody is met farther away, and with a wave."""
    import comity_fis

    source = comity_fis.read_rulebook("evidence")
    data = dict(source.data)
    data["name"] = "own"
    data["rules"] = [
        *data["rules"],
        {
            "rule": "if posture is standing then conversational_distance is far",
            "sources": ["hall1966"],
            "evidence": "design",
        },
        {
            "rule": "if posture is standing then greeting_gesture is wave",
            "sources": ["hall1966"],
            "evidence": "design",
        },
    ]
    (here / "own.yaml").write_text(yaml.safe_dump(data, sort_keys=False, allow_unicode=True))
    return "own.yaml"


def reach_and_greet(answer):
    return {
        step["action"]: step for step in answer["steps"] if step["action"] in ("Reach_user", "Greet_person")
    }


@needs_fast_downward
@pytest.mark.parametrize("engine", [(), OTHER])
@pytest.mark.parametrize("profile", ["arab_woman", "german_woman", "arab_man", "german_man"])
def test_a_changed_rule_changes_plan_distance_and_cause(comity, own_rules, engine, profile):
    """In the parameters of both actions, in the distance that is reached, and in the trace."""
    as_ = ("--as", f"johanna={profile}", *engine)
    before = reach_and_greet(comity("plan", "johanna", *as_, "--rulebook", "evidence", "--json").json)
    after = reach_and_greet(comity("plan", "johanna", *as_, "--rulebook", own_rules, "--json").json)
    distance = "conversational_distance"
    far = after["Reach_user"]["parameters"][distance]
    assert far > before["Reach_user"]["parameters"][distance] + 0.1
    assert before["Greet_person"]["parameters"]["greeting_gesture"] == "nod"
    assert after["Greet_person"]["parameters"]["greeting_gesture"] == "wave"
    run = comity("run", "johanna", *as_, "--rulebook", own_rules, "--out", "run", "--no-pictures", "--json")
    (visit,) = run.json["visits"]
    assert visit["distance_reached_m"] == pytest.approx(far, abs=0.01)
    assert "wave" in visit["greeting"]
    why = comity("trace", "run", "--why", "6").out
    assert "if posture is standing then conversational_distance is far" in " ".join(why.split())


@needs_fast_downward
def test_steps_are_the_same_and_have_parameters_and_reasons(comity):
    ours = comity("plan", "two-visits", "--json").json
    theirs = comity("plan", "two-visits", *OTHER, "--validate", "--json").json
    assert (theirs["engine"], theirs["cost"], theirs["optimal"]) == ("fast-downward-opt", ours["cost"], True)
    for own, other in zip(ours["steps"], theirs["steps"], strict=True):
        assert {key: other[key] for key in ("action", "arguments", "parameters", "cost")} == {
            key: own[key] for key in ("action", "arguments", "parameters", "cost")
        }
        assert other["why"]["text"]
    assert theirs["validation"] == {"valid": True, "reason": "", "cost": ours["cost"]}


@needs_fast_downward
def test_a_run_names_its_engine_and_is_run_again_with_it(comity):
    run = comity("run", "two-visits", *OTHER, "--out", "run", "--no-pictures", "--json").json
    assert run["outcome"] == "success"
    assert run["reproduce"].endswith("--engine fast-downward-opt")
    own = comity("run", "two-visits", "--out", "own", "--no-pictures", "--json").json
    reached = [
        {visit["person"]: visit["distance_reached_m"] for visit in answer["visits"]} for answer in (run, own)
    ]
    assert reached[0] == pytest.approx(reached[1], abs=1e-6)


@pytest.mark.parametrize("command", [("plan",), ("run", "--no-pictures")])
def test_an_engine_that_there_is_not_is_refused(comity, command):
    said = comity(*command, "johanna", "--engine", "fast-upward")
    assert said.code == 2
    assert "--engine" in said.err
    assert "fast-upward" in said.err


def test_an_engine_that_breaks_off_says_what_it_does_not_take(comity):
    """And which installed one to name instead."""
    pytest.importorskip("up_aries")
    said = comity("plan", "johanna", "--engine", "aries")
    assert said.code == 1
    told = " ".join(said.err.split())
    assert "aries cannot plan this: it does not take conditional effects and forall effects" in told
    assert "Leave --engine out" in told


def test_a_scenario_with_deadlines_is_never_planned_without_them(comity):
    said = comity("plan", "in-a-hurry", *OTHER)
    assert said.code == 2
    assert "deadline" in said.err


@pytest.mark.parametrize("scenario", ["tea-visit", "reception", "skipped-guest", "comity-bench-1/ward-round"])
def test_the_validator_accepts_what_is_planned(comity, scenario):
    answer = comity("plan", scenario, "--validate", "--json").json
    assert answer["validation"] == {"valid": True, "reason": "", "cost": answer["cost"]}
