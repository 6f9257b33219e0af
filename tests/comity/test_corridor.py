"""People across a corridor: the robot comes up to them, asks all of them once and once more, and waits."""

from __future__ import annotations

import pytest

import comity as front_door

CORRIDOR = """\
schema_version: 1
name: corridor
place: {width_m: 16, height_m: 2.6}
robot: {at_m: [0.8, 1.3]}
people:
  c: {at_m: [15, 1.3], facing_deg: 180}
"""
GREET = "goals: [{greet: c}]\n"
ACROSS = """\
  a: {at_m: [4.5, 0.5], facing_deg: 90}
  b: {at_m: [4.5, 2.1], facing_deg: -90}
"""
TALKING = ACROSS + "groups: {talk: [a, b]}\n"
ABREAST = """\
  a: {at_m: [4.5, 0.9], facing_deg: 180}
  b: {at_m: [4.5, 1.7], facing_deg: 180}
"""
REFUSED = "a and b were asked to let the robot pass, and the way was not free within 6 s"


@pytest.fixture
def run(here):
    """Run a scenario in the corridor."""

    def visit(people: str, more: str = "", goals: str = GREET):
        (here / "visit.scenario.yaml").write_text(CORRIDOR + people + goals + more)
        return front_door.run("visit.scenario.yaml")

    return visit


def asked(ran) -> list[str]:
    """Who was asked to let the robot pass, in order."""
    return [act.person for act in ran.acts if act.act == "ask_to_pass"]


@pytest.mark.parametrize("people", [TALKING, ABREAST], ids=["talking", "abreast"])
def test_both_who_bar_the_way_are_asked_once_and_once_more_in_all_and_named_in_the_end(run, people: str):
    ran = run(people)
    assert ran.outcome == "failed"
    assert asked(ran) == ["a", "b", "a", "b"]
    assert ran.visits[0].failure == REFUSED
    assert ran.metrics.path_length_m > 2.0


def test_who_talk_across_the_way_are_waited_for_until_one_of_them_goes(run):
    ran = run(TALKING, "changes: [{at_s: 45, person: a, moves_to_m: [8, 0.5], facing_deg: 90}]\n")
    assert ran.outcome == "success"
    assert asked(ran) == ["a", "b", "a", "b"]
    texts = [cause.text for event in ran.events for cause in event.because if event.status == "not_replanned"]
    assert any(text.endswith("at most: a or b may make way") for text in texts)


def test_who_moved_and_bars_the_way_still_is_asked_anew(run):
    """Both go on by 5.5 m, and stand there as they did before."""
    moves = "".join(
        f"  - {{at_s: 45, person: {name}, moves_to_m: [10, {y_m}], facing_deg: 180}}\n"
        for name, y_m in (("a", 0.9), ("b", 1.7))
    )
    ran = run(ABREAST, f"changes:\n{moves}")
    assert ran.outcome == "failed"
    assert sorted(asked(ran)) == ["a"] * 4 + ["b"] * 4


def test_two_visits_behind_the_same_people_do_not_ask_them_twice_as_often(run):
    people = "  d: {at_m: [12, 1.3], facing_deg: 180}\n" + ABREAST
    ran = run(people, "limits: {patience_s: 10}\n", "goals: [{greet: c}, {greet: d}]\n")
    assert ran.outcome == "failed"
    assert asked(ran) == ["a", "b", "a", "b"]
    assert {visit.failure for visit in ran.visits} == {REFUSED}


def test_nobody_waits_without_patience(run):
    ran = run(TALKING, "limits: {patience_s: 0}\n")
    assert ran.visits[0].failure == REFUSED
    assert ran.metrics.duration_s < 40.0
