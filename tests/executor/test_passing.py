"""Somebody is in the way: wait, ask, go round, give up."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from comity_executor import Execution, Limits
from comity_fis import load_rulebook

ASKED = "ask_to_pass bob: Excuse me, may I pass?"


def in_the_way(episode, *, for_s: float | None = None, from_s: float = 1.0, **limits: float):
    """Johanna's visit with Bob in the way from a time on, for so long."""
    visits = episode(limits=Limits(**limits))
    visits.run(for_s=from_s)
    visits.hall.in_the_way = "bob"
    if for_s is not None:
        visits.run(for_s=for_s)
        visits.hall.in_the_way = None
    return visits


def test_a_passer_by_is_waited_for_and_not_asked(episode) -> None:
    visits = in_the_way(episode, for_s=1.5)
    assert visits.run().execution.status == "success"
    assert visits.hall.asked_s == []
    assert visits.count("Navigate_to_user(johanna)", "running") == 1, "the motion was never given up"


def test_who_stays_is_asked_and_the_robot_goes_on_when_they_make_way(episode) -> None:
    visits = in_the_way(episode)
    visits.hall.gives_way_s = 3.0
    assert visits.run().execution.status == "success"
    assert visits.hall.calls.count(ASKED) == 1
    assert visits.hall.asked_s[0] == pytest.approx(3.0, abs=0.11), "1 s on the way and 2 s of patience"
    assert visits.count("Approach(johanna)", "failure") == 0


def test_who_does_not_make_way_is_gone_round_in_the_next_attempt(episode) -> None:
    visits = in_the_way(episode)
    visits.hall.way_round = True
    assert visits.run().execution.status == "success"
    assert visits.hall.calls.count(ASKED) == 1
    assert visits.hall.detours_m[0] == Limits().detour_m
    assert visits.hall.detours_m[-1] == math.inf


def test_where_no_way_leads_round_the_robot_asks_once_more_and_gives_up(episode) -> None:
    visits = in_the_way(episode)
    visits.run()
    assert visits.execution.visits[0].outcome == "unreached"
    assert visits.execution.visits[0].failure == (
        "bob was asked to let the robot pass, and the way was not free within 6 s"
    )
    assert visits.hall.calls.count(ASKED) == 2
    assert visits.hall.at_rest


def test_all_who_are_in_the_way_are_asked_one_after_the_other(episode) -> None:
    visits = in_the_way(episode)
    visits.hall.in_the_way = ("bob", "eve")
    visits.run()
    asked = [call.split(":")[0] for call in visits.hall.calls if call.startswith("ask_to_pass")]
    assert asked == ["ask_to_pass bob", "ask_to_pass eve"] * 2
    assert visits.execution.visits[0].failure == (
        "bob and eve were asked to let the robot pass, and the way was not free within 6 s"
    )
    assert visits.hall.at_rest


def test_the_cause_in_the_trace_is_the_person_in_the_way(episode) -> None:
    visits = in_the_way(episode)
    visits.run(for_s=9.0)
    (event,) = [
        e for e in visits.execution.events if e.node == "way_free?(johanna)" and e.status == "failure"
    ]
    assert event.because[0].text == "bob is in the way"
    (halt,) = [e for e in visits.execution.events if e.node == "Ask_way(johanna)" and e.halt] or [None]
    assert halt is None, "nobody made way yet"


def test_a_question_that_never_ends_fails_the_attempt(episode) -> None:
    visits = in_the_way(episode, act_timeout_s=0.5)
    visits.run()
    assert visits.execution.visits[0].outcome == "unreached"
    assert visits.hall.at_rest


@settings(max_examples=25)
@given(spans=st.lists(st.tuples(st.floats(0.0, 20.0), st.floats(0.05, 15.0)), max_size=4))
def test_whoever_comes_and_goes_the_visit_ends_and_nobody_is_asked_more_than_twice(episode, spans) -> None:
    """Whenever Bob and Eve stand in the way: an end, at rest, with a reason where it is not success."""
    visits = episode()
    while visits.hall.now_s() < 200.0 and visits.execution.tick() == "running":
        now_s = visits.hall.now_s()
        there = [i for i, (t, d) in enumerate(spans) if t <= now_s < t + d]
        visits.hall.in_the_way = ("bob", "eve")[there[0] % 2] if there else None
        visits.hall.step()
    (visit,) = visits.execution.visits
    assert visits.execution.status in ("success", "failure")
    assert (visit.outcome == "greeted") == (visit.failure is None)
    assert visits.hall.at_rest
    asked = [call.split(":")[0] for call in visits.hall.calls if call.startswith("ask_to_pass")]
    assert all(asked.count(call) <= 2 for call in asked)


def test_the_manner_and_the_words_suit_the_one_who_is_asked(episode) -> None:
    """Not the one who is visited: Bob likes a soft voice and wants to be spoken to in German."""
    visits = episode()
    wishes = {"greeting_language": "deu", "voice_volume": 0.2}
    bob = load_rulebook("evidence").infer({}, settings=wishes)
    visits.execution = Execution(visits.plan, visits.hall, {**visits.values, "bob": bob})
    visits.hall.in_the_way = "bob"
    visits.run(for_s=6.0)
    assert visits.hall.manners["ask_to_pass", "bob"].volume == 0.2
    assert any(call.startswith("ask_to_pass bob: Entschuldigung, Bob") for call in visits.hall.calls)


def test_things_in_the_way_are_not_spoken_to(episode) -> None:
    visits = episode()
    visits.hall.blocked_by["johanna"] = "a cart stands in the door"
    visits.run()
    assert visits.hall.asked_s == []
    assert visits.execution.visits[0].failure == "blocked: a cart stands in the door"
