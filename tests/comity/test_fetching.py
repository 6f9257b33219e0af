"""Something is to be fetched, and somebody stands in the way to it."""

from __future__ import annotations

import copy

import pytest
import yaml

import comity as front_door
from comity.report.episodes.run import visit_answers

STANDS_AT_M = [5.0, 2.45]
"""In the middle of the only gap in the wall between the robot and the shelf."""
REASON = "dan was asked to let the robot pass, and the way was not free within 6 s"
ROOM = {
    "schema_version": 1,
    "name": "tea",
    "place": {
        "width_m": 10,
        "height_m": 5,
        "walls_m": [[[5, 5], [5, 3.0]], [[5, 1.9], [5, 0]]],
        "furniture": [{"name": "shelf", "box_m": [9.2, 2.0, 0.6, 1.2]}],
    },
    "robot": {"at_m": [1, 2.5]},
    "people": {
        "anna": {"profile": "arab_woman", "at_m": [2.5, 4.2], "facing_deg": -90},
        "dan": {"at_m": [2.0, 0.6], "facing_deg": 90},
    },
    "goals": [{"greet": "anna"}, {"offer": "tea", "to": "anna", "from": "shelf"}],
}
STEPS_IN = {"at_s": 0.5, "person": "dan", "moves_to_m": STANDS_AT_M, "speed_m_s": 2.0}


@pytest.fixture
def run(here):
    """Fetch tea while Dan stands in the gap, with these keys of the scenario otherwise."""

    def fetched(*, changes=(STEPS_IN,), **more):
        written = {**copy.deepcopy(ROOM), "changes": list(changes), **more}
        (here / "tea.scenario.yaml").write_text(yaml.safe_dump(written))
        return front_door.run("tea.scenario.yaml")

    return fetched


def asked(ran) -> list[float]:
    """When Dan was asked to let the robot pass."""
    return [act.t_start for act in ran.acts if (act.act, act.person) == ("ask_to_pass", "dan")]


def done(ran, act: str) -> list[float]:
    return [each.t_start for each in ran.acts if each.act == act and not each.stopped]


def test_whoever_stands_in_the_way_to_what_is_fetched_is_asked_and_the_run_ends_with_their_name(run):
    ran = run(limits={"replans": 0})
    (visit,) = ran.visits
    assert len(asked(ran)) == 2, "once in each attempt, and as often only from before Anna"
    assert (visit.outcome, visit.failure) == ("unfinished", REASON)
    assert done(ran, "say"), "what can be done without the tea is done"
    assert ran.outcome == "partial"
    assert ran.frames.time_s[-1] < 90.0


def test_whoever_stands_where_it_is_fetched_is_told_to_have_stood_there(run):
    """Not only that the way was not free: all of it was, but its end."""
    place = {**ROOM["place"], "walls_m": []}
    before_the_shelf = {"at_s": 0.5, "person": "dan", "moves_to_m": [8.6, 2.6], "speed_m_s": 2.0}
    (told,) = visit_answers(run(changes=[before_the_shelf], place=place, limits={"replans": 0}))
    assert told.reason == f"{REASON}; dan stood where the robot was to stand"
    (told,) = visit_answers(run(limits={"replans": 0}))
    assert told.reason == REASON


def test_whoever_stands_there_from_the_start_is_asked_too_and_it_is_fetched_once_they_have_gone(run):
    there = {**ROOM["people"], "dan": {"at_m": STANDS_AT_M, "facing_deg": 180}}
    ran = run(people=there, changes=[{"at_s": 40, "person": "dan", "moves_to_m": [2.0, 0.6]}])
    assert asked(ran), "the first plan knew no way to the shelf, a later one does"
    assert done(ran, "hand_over")
    assert ran.outcome == "success"


def test_it_is_taken_up_where_it_is_kept_and_not_where_the_robot_waited_for_the_way(run):
    """On two legs round a corner: what it came to rest for before is not what it is to come to now."""
    ran = run(
        place={
            "width_m": 6.0,
            "height_m": 4.5,
            "walls_m": [[[4.0, 0.0], [4.0, 1.8]], [[4.0, 2.9], [4.0, 4.5]]],
            "furniture": [{"name": "shelf", "box_m": [5.4, 1.6, 0.6, 1.4]}],
        },
        robot={"at_m": [2.4, 1.0]},
        people={
            "anna": {"profile": "arab_woman", "at_m": [1.0, 3.2], "facing_deg": -30},
            "dan": {"profile": "german_man", "at_m": [4.0, 2.35], "facing_deg": 180},
        },
        limits={"blocked_s": 1, "passing_s": 2},
        changes=[{"at_s": 22, "person": "dan", "moves_to_m": [3.2, 0.6], "facing_deg": 90}],
    )
    begun = [act.t_start for act in ran.acts if act.act == "pick_up"]
    assert begun
    assert all(ran.frames.of("robot")[round(t / 0.05), 0] > 5.0 for t in begun)


def test_no_new_plan_asks_again_whoever_was_asked_twice_in_vain(run):
    ran = run()
    assert ran.visits[0].failure == REASON
    assert len(asked(ran)) == 2
    assert ran.frames.time_s[-1] < 200.0


def test_who_is_left_is_still_visited_where_nothing_can_be_fetched(run):
    people = {**ROOM["people"], "eve": {"profile": "german_man", "at_m": [0.8, 4.3], "facing_deg": -60}}
    ran = run(people=people, goals=[*ROOM["goals"], {"greet": "eve"}])
    outcomes = {visit.person: visit.outcome for visit in ran.visits}
    assert outcomes == {"anna": "unfinished", "eve": "greeted"}


def test_the_robot_fetches_it_as_soon_as_they_leave(run):
    goes = {"at_s": 12, "person": "dan", "moves_to_m": [2.0, 0.6]}
    ran = run(changes=[STEPS_IN, goes])
    assert len(asked(ran)) == 1
    assert done(ran, "pick_up")[0] < done(ran, "say")[0]
    assert ran.outcome == "success"


def test_in_the_next_attempt_the_robot_goes_round_however_far_that_is(run):
    place = {
        **ROOM["place"],
        "height_m": 9,
        "walls_m": [[[5, 7.7], [5, 3.0]], [[5, 1.9], [5, 0]]],
    }
    ran = run(place=place)
    (taken_s,) = done(ran, "pick_up")
    assert len([t for t in asked(ran) if t < taken_s]) == 1
    assert ran.outcome == "success"


def test_a_passer_by_is_waited_for_and_not_asked(run):
    there = {**STEPS_IN, "at_s": 4.0}
    ran = run(changes=[there, {"at_s": 7.2, "person": "dan", "moves_to_m": [4.0, 0.6], "speed_m_s": 2.0}])
    assert asked(ran) == []
    assert ran.outcome == "success"


def test_the_trace_says_who_is_in_the_way_to_what(run):
    ran = run(limits={"replans": 0})
    (first, *_) = [
        event for event in ran.events if event.node == "way_free?(tea, anna)" and event.status == "failure"
    ]
    assert first.because[0].text == "dan is in the way"
    without = next(event for event in ran.events if event.node == "Go_without(tea, anna)")
    assert without.because[0].text == REASON
