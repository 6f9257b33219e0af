"""People who are each within reach, and no way leads from one to the next: as many as can be are served."""

from __future__ import annotations

import json

import pytest

IN_THE_MIDST = """\
schema_version: 1
name: midst
place: {width_m: 8, height_m: 6}
robot: {at_m: [4, 3]}
people:
  ann: {at_m: [1, 1], facing_deg: 45}
  dora: {at_m: [7, 5], facing_deg: -135}
groups: {talk: [ann, dora]}
"""
"""The robot starts between two who talk across a room: ways lead to both, and none from one to the other."""


@pytest.fixture
def plan(comity, here):
    """The answer of `comity plan` for these goals."""

    def planned(goals: str, *, text: str = IN_THE_MIDST):
        (here / "midst.scenario.yaml").write_text(f"{text}goals: [{goals}]\n")
        said = comity("plan", "midst.scenario.yaml", "--json")
        answer = json.loads(said.out)
        assert answer["solved"]
        assert said.code == bool(answer["unreachable"])
        return answer

    return planned


def visited(answer) -> list[str]:
    return [step["arguments"][1] for step in answer["steps"] if step["action"] == "Reach_user"]


@pytest.mark.parametrize("first", ["ann", "dora"])
def test_of_two_who_are_cut_off_from_each_other_the_first_is_served_and_the_other_named(plan, first: str):
    other = {"ann": "dora", "dora": "ann"}[first]
    answer = plan(f"{{greet: {first}}}, {{greet: {other}}}")
    assert visited(answer) == [first]
    assert answer["unreachable"] == [
        {
            "person": other,
            "reason": f"no way leads to {other} from {first}: the space between ann and dora is in the way",
        }
    ]


def test_most_are_served_whoever_is_named_first(plan):
    text = IN_THE_MIDST.replace("groups:", "  eve: {at_m: [10, 3], facing_deg: 180}\ngroups:")
    text = text.replace("width_m: 8", "width_m: 12")
    answer = plan("{greet: ann}, {greet: dora}, {greet: eve}", text=text)
    assert sorted(visited(answer)) == ["dora", "eve"]
    assert [each["person"] for each in answer["unreachable"]] == ["ann"]


def test_who_may_be_left_out_at_a_price_is_skipped(plan):
    answer = plan("{greet: ann}, {greet: dora, skip: 5}")
    assert visited(answer) == ["ann"]
    assert answer["unreachable"] == []
    assert [step["arguments"] for step in answer["steps"] if step["action"] == "Skip_visit"] == [
        ["robot", "dora"]
    ]
    assert answer["cost"] >= 500


def test_the_run_greets_whom_it_can_and_names_who_bars_the_way_to_the_other(comity, here):
    (here / "midst.scenario.yaml").write_text(
        f"{IN_THE_MIDST}goals: [{{greet: ann}}, {{greet: dora}}]\nlimits: {{patience_s: 5}}\n"
    )
    said = comity("run", "midst.scenario.yaml", "--json")
    answer = json.loads(said.out)
    assert (said.code, answer["outcome"]) == (1, "partial")
    assert {visit["person"]: visit["outcome"] for visit in answer["visits"]} == {
        "ann": "greeted",
        "dora": "unreached",
    }
