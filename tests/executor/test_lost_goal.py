"""A base that loses its goal, says what it may not, falls silent, or does not answer for a moment."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from comity_executor import STATES, Limits, MotionStatus
from comity_executor.robots.goals import LOST


@settings(max_examples=15)
@example(at_s=1.0)
@example(at_s=7.5)
@given(at_s=st.floats(0.1, 10.0))
def test_a_goal_that_the_base_drops_costs_a_moment(episode, at_s: float) -> None:
    """It is noticed at once, and commanded again after the pause, on the way as well as while it greets."""
    alone = episode("johanna", "alice").run()
    visits = episode("johanna", "alice").run(for_s=at_s)
    visits.hall._goal = None  # what an operator's tablet cancels
    visits.run()
    assert visits.execution.status == "success"
    lost_s = visits.hall.now_s() - alone.hall.now_s()
    assert lost_s <= Limits().reach_pause_s + Limits().accept_s + 0.5


def test_a_lost_goal_is_named(episode) -> None:
    visits = episode().run(for_s=1.0)
    visits.hall._goal = None
    visits.run(for_s=0.1)
    failed = next(
        event
        for event in visits.execution.events
        if event.node == "Navigate_to_user(johanna)" and event.status == "failure"
    )
    assert "stopped" in " ".join(cause.text for cause in failed.because)


@pytest.mark.parametrize("word", ["driving", "", None, 3])
def test_an_unknown_word_of_the_motion_is_an_error_that_names_the_known_ones(episode, word) -> None:
    visits = episode()
    visits.hall.motion = lambda: MotionStatus(visits.hall.goals, word)
    visits.run()
    assert visits.execution.status == "failure"
    assert visits.hall.now_s() < 5.0
    failure = visits.execution.visits[0].failure
    assert f"expected one of {', '.join(STATES)}, got {word!r}" in failure


@pytest.mark.parametrize("state", LOST)
def test_a_goal_that_is_refused_or_given_up_is_tried_again_after_a_pause_and_told(episode, state) -> None:
    visits = episode("johanna")
    told = visits.hall.motion
    visits.hall.motion = lambda: replace(told(), state=state, text="of its own accord")
    visits.run(for_s=0.5)
    visits.hall.motion = told
    visits.run()
    assert visits.execution.status == "success"
    because = [cause.text for event in visits.execution.events for cause in event.because]
    assert any(f"{state} of its goal: of its own accord" in text for text in because)


def test_what_a_base_says_of_an_older_goal_is_not_taken_for_the_new_one(episode) -> None:
    """It says for ever that the first goal is reached; nobody is taken to be reached by that."""
    visits = episode("johanna")
    told = visits.hall.motion
    visits.hall.motion = lambda: replace(told(), state="succeeded", goal=0)
    visits.run(for_s=20.0)
    assert visits.execution.visits[0].outcome == "unreached"
    assert "not taken its goal up" in visits.execution.visits[0].failure


def test_a_base_that_has_fallen_silent_about_its_goal_has_lost_it(episode) -> None:
    visits = episode("johanna").run(for_s=1.0)
    last = visits.hall.motion()
    visits.hall.motion = lambda: replace(last, goal=visits.hall.goals)
    visits.run(for_s=Limits().feedback_s + 0.2)
    assert visits.count("Navigate_to_user(johanna)", "failure") == 1


@settings(max_examples=15)
@given(accept_s=st.floats(0.0, 0.4))
def test_a_base_may_speak_of_the_goal_before_until_it_has_taken_up_the_new_one(
    episode, accept_s: float
) -> None:
    visits = episode("johanna", "alice")
    told = visits.hall.motion
    began: dict[int, float] = {}

    def motion() -> MotionStatus:
        newest, now_s = visits.hall.goals, visits.hall.now_s()
        is_late = now_s - began.setdefault(newest, now_s) < accept_s
        return replace(told(), goal=newest - 1, state="succeeded") if is_late else told()

    visits.hall.motion = motion
    visits.run()
    assert visits.execution.status == "success"
    assert visits.count("Retry 2(johanna)", "failure") == 0


@settings(max_examples=15)
@given(at_s=st.floats(0.1, 12.0), call=st.sampled_from(("motion", "read", "choose_pose", "go")))
def test_a_call_that_raises_for_a_moment_costs_no_visit(episode, at_s: float, call: str) -> None:
    """Two attempts, with a pause between them that is longer than the moment."""
    visits = episode("johanna", "alice").run(for_s=at_s)
    whole = getattr(visits.hall, call)

    def raising(*_: object, **__: object) -> None:
        raise ConnectionError("the base does not answer")

    setattr(visits.hall, call, raising)
    visits.run(for_s=0.3)
    setattr(visits.hall, call, whole)
    visits.run()
    assert visits.execution.status == "success"
