"""A deadline that the way broke is told wherever the visit is, and nobody is left out for it."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from math import inf

import pytest
from saved import saved

import comity as package
from comity.monitoring.lateness import without_missed
from comity.preparation import prepare
from comity.replay.pictures import rings_of
from comity.scenario import load_scenario

MAP = """\
schema_version: 1
name: two rooms
rooms: {left: {box_m: [0, 0, 5, 5]}, right: {box_m: [5, 0, 5, 5]}}
doors: {gate: {at_m: [5, 2.5], width_m: 0.9, open: false}}
locations: {start: {at_m: [1, 2.5], facing_deg: 0}, desk: {at_m: [9, 2.5], facing_deg: 180}}
"""
SCENARIO = """\
schema_version: 1
name: late
place: {{map: rooms.map.yaml}}
robot: {{at: start}}
people:
  far: {{at: desk}}
  near: {{at_m: [2, 4.2], facing_deg: -90}}
goals: [{{greet: far, by_s: {by_s}}}, {{greet: near, by_s: 60}}]
faults: [{{at_s: {opens_s}, fault: door opens, door: gate}}]
"""
TWO = """\
schema_version: 1
name: two
place: {width_m: 12, height_m: 5}
robot: {at_m: [6, 1]}
people:
  west: {at_m: [2, 2.5], facing_deg: 0}
  east: {at_m: [10, 2.5], facing_deg: 180}
goals: [{greet: west, by_s: 300}, {greet: east, by_s: 300}]
"""


@pytest.fixture
def scenario(here):
    """A scenario's file: who is behind a gate that opens at a time is to be greeted by another."""

    def write(*, opens_s: float, by_s: float = 40, more: str = "") -> str:
        (here / "rooms.map.yaml").write_text(MAP)
        path = here / "late.scenario.yaml"
        path.write_text(SCENARIO.format(by_s=by_s, opens_s=opens_s) + more)
        return str(path)

    return write


def test_a_greeting_after_its_deadline_is_told_in_text_json_and_picture(comity, scenario, here):
    said = comity("run", scenario(opens_s=50), "--out", "run")
    account = json.loads((here / "run" / "run.json").read_text())
    far = next(visit for visit in account["visits"] if visit["person"] == "far")
    assert (far["outcome"], far["by_s"]) == ("greeted", 40)
    assert far["greeted_s"] == max(act["end_s"] for act in far["acts"])
    assert far["late_s"] == pytest.approx(far["greeted_s"] - 40)
    told = f"{far['late_s']:.1f} s late"
    assert "partial, 2 of 2 greeted (1 late)" in said.out
    assert f"far: greeted at {far['greeted_s']:.1f} s, {told} (by_s: 40)" in said.out
    rings = rings_of(saved(scenario(opens_s=50), here / "again"))
    ring = next(ring for ring in rings if ring.person == "far")
    assert told in ring.label
    assert said.code == 1


def test_a_greeting_in_time_is_no_lateness(comity, scenario):
    answer = comity("run", scenario(opens_s=15), "--json").json
    assert answer["outcome"] == "success"
    assert {visit["person"]: visit["late_s"] for visit in answer["visits"]} == {"far": 0.0, "near": 0.0}


def test_without_a_deadline_nothing_is_said_of_one(comity):
    (visit,) = comity("run", "johanna", "--json").json["visits"]
    assert visit["greeted_s"] > visit["docked_at_s"]
    assert (visit["by_s"], visit["late_s"]) == (None, None)


@pytest.mark.parametrize("opens_s", [25, 35, 39, 45])
def test_whoever_can_only_be_late_is_greeted_whenever_the_way_opens(scenario, opens_s):
    """A gate that opens earlier serves no fewer people, also while the deadline is still ahead."""
    episode = package.run(scenario(opens_s=opens_s))
    assert {visit.outcome for visit in episode.visits} == {"greeted"}


def test_a_plan_without_a_deadline_that_was_asked_for_says_so(scenario):
    episode = package.run(scenario(opens_s=35))
    because = [cause.text for revision in episode.revisions for cause in revision.because]
    assert "that far is greeted by 40 s cannot be promised any more: late is better than never" in because


def test_a_test_that_fails_for_lateness_names_who_was_late_and_by_how_much(comity, scenario):
    said = comity("test", scenario(opens_s=50, more="expect: [same for all: safety]\n"))
    assert said.code == 1
    assert "s later than its by_s" in said.out
    assert "near" not in said.out.split("later than")[0]


def test_of_several_deadlines_only_those_that_are_out_of_reach_are_dropped(here):
    path = here / "two.scenario.yaml"
    path.write_text(TWO)
    request = prepare(load_scenario(str(path))).asked.request

    def kept(**by_s: float) -> dict[str, float | None]:
        hurried = tuple(replace(each, by_s=by_s[each.name]) for each in request.visitees)
        left = without_missed(replace(request, visitees=hurried), ends_s=inf)
        return {each.name: each.by_s for each in left.visitees}

    assert kept(west=100, east=100) == {"west": 100, "east": 100}
    assert kept(west=2, east=100) == {"west": None, "east": 100}
    assert kept(west=25, east=25) == {"west": 25, "east": None}


def test_a_plan_that_changes_for_a_deadline_names_it_and_not_its_price(here):
    """Who has to leave walks farther off: to greet them second would be cheaper, and too late."""
    goes = "changes: [{at_s: 1, person: east, moves_to_m: [11.5, 4.5], facing_deg: 180}]\n"
    room = TWO.replace("at_m: [6, 1]", "at_m: [4, 1]").replace("east, by_s: 300", "east, by_s: 38")
    (here / "two.scenario.yaml").write_text(room.replace("[10, 2.5]", "[8, 2.5]") + goes)
    episode = package.run("two.scenario.yaml")
    (event,) = [event for event in episode.events if event.status == "replanned"]
    told = "; ".join(cause.text for cause in event.because)
    found = re.search(
        r"as planned, east would be greeted at ([\d.]+) s, later than 38 s; "
        r"what keeps every deadline costs (\d+) cm now instead of (\d+) cm; in the order east, west",
        told,
    )
    assert found, told
    greeted_s, new, kept = map(float, found.groups())
    assert greeted_s > 38
    assert new > kept
    assert episode.outcome == "success"
