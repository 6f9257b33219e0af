"""`after` and `not_from` in a scenario's goals: kept in plan and run, refused where wrong."""

from __future__ import annotations

import pytest
from downward import needs_fast_downward

SCENARIO = """
schema_version: 1
name: order
place: {width_m: 9.0, height_m: 6.0}
robot: {at_m: [1.0, 1.0]}
people:
  anna: {profile: german_woman, at_m: [2.6, 1.6], facing_deg: 180}
  omar: {profile: arab_man, at_m: [7.0, 4.6], facing_deg: 225}
  cy: {profile: unknown, at_m: [4.5, 4.4], facing_deg: 225}
goals:
"""


@pytest.fixture
def planned(comity, here):
    def call(goals: str, *more: str):
        (here / "order.scenario.yaml").write_text(SCENARIO + goals)
        return comity("plan", "order.scenario.yaml", *more)

    return call


def reached(answer):
    return [step["arguments"][1:3] for step in answer["steps"] if step["action"] == "Reach_user"]


def test_omar_is_greeted_before_anna_in_plan_and_run(comity, planned):
    free = planned("  - greet: anna\n  - greet: omar\n  - greet: cy\n", "--json").json
    assert reached(free)[0][0] == "anna"
    asked = planned("  - {greet: anna, after: omar}\n  - greet: omar\n  - greet: cy\n", "--json").json
    people = [person for person, _ in reached(asked)]
    assert people.index("omar") < people.index("anna")
    assert asked["cost"] > free["cost"]
    run = comity("run", "order.scenario.yaml", "--out", "run", "--no-pictures", "--json").json
    assert run["outcome"] == "success"
    assert [visit["person"] for visit in run["visits"]] == people


@needs_fast_downward
@pytest.mark.parametrize("side", ["front", "left", "right"])
def test_another_engine_keeps_a_side_ruled_out_at_our_cost(planned, side):
    """Of somebody alone, and beside an order."""
    for goals in (
        f"  - {{greet: anna, not_from: [{side}]}}\n",
        f"  - {{greet: anna, not_from: [{side}], after: omar}}\n  - greet: omar\n",
    ):
        ours = planned(goals, "--json").json
        theirs = planned(goals, "--engine", "fast-downward-opt", "--validate", "--json").json
        assert theirs["engine"] == "fast-downward-opt"
        assert reached(theirs) == reached(ours)
        assert side not in [taken for person, taken in reached(theirs) if person == "anna"]
        assert theirs["cost"] == ours["cost"]
        assert theirs["validation"]["valid"]


def test_who_walks_off_does_not_change_the_order(comity, here):
    goals = "  - {greet: anna, after: omar}\n  - greet: omar\n"
    changes = "changes:\n  - {at_s: 3, person: cy, moves_to_m: [4.0, 3.0]}\n"
    (here / "order.scenario.yaml").write_text(SCENARIO + goals + changes)
    run = comity("run", "order.scenario.yaml", "--out", "run", "--no-pictures", "--json")
    assert run.code == 0, run.err
    assert [visit["person"] for visit in run.json["visits"]] == ["omar", "anna"]


@pytest.mark.parametrize("side", ["front", "left", "right"])
def test_a_side_that_is_ruled_out_is_not_taken_and_says_so(planned, side):
    answer = planned(f"  - {{greet: anna, not_from: [{side}]}}\n", "--why", "1", "--json").json
    ((_, taken),) = reached(answer)
    assert taken != side
    assert [side, "the scenario rules it out"] in [
        [one["arguments"][-1], one["reason"]] for one in answer["why"]["step"]["why"]["ruled_out"]
    ]


def test_where_every_side_is_ruled_out_the_person_cannot_be_greeted(planned):
    said = planned("  - {greet: anna, not_from: [front, left, right]}\n", "--json")
    assert said.code == 1
    ((unmet),) = said.json["unmet"]
    assert "the scenario rules out every side" in unmet["reason"]


@pytest.mark.parametrize(
    ("goals", "got"),
    [
        ("  - {greet: anna, after: omar}\n", "'omar'"),
        ("  - {greet: anna, after: anna}\n", "anna"),
        ("  - {greet: anna, after: omar}\n  - {greet: omar, after: anna}\n", "anna after omar"),
        ("  - {greet: anna, not_from: [behind]}\n", "behind"),
        ("  - {greet: anna, not_from: []}\n", "not_from"),
        ("  - greet: anna\n  - {say: hello, to: anna, after: omar}\n", "`after`"),
    ],
)
def test_what_cannot_be_kept_is_refused_with_its_line(planned, goals, got):
    said = planned(goals)
    assert said.code == 2
    assert got in said.err
    assert "order.scenario.yaml:1" in said.err


@needs_fast_downward
def test_other_engines_keep_an_order(planned):
    goals = "  - {greet: anna, after: omar}\n  - greet: omar\n"
    steps = planned(goals, "--engine", "fast-downward-opt", "--json").json["steps"]
    assert [person for person, _ in reached({"steps": steps})] == ["omar", "anna"]
