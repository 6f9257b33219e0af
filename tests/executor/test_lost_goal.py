"""A base that loses its command, says what it may not, or does not answer for a moment."""

from __future__ import annotations

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from comity_executor import Limits
from comity_executor.robots.scripted import ScriptedMotion


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
    assert "idle" in " ".join(cause.text for cause in failed.because)


@pytest.mark.parametrize("word", ["driving", "", None, 3])
def test_an_unknown_word_of_the_motion_is_an_error_that_names_the_known_ones(episode, word) -> None:
    visits = episode()
    visits.hall.motion = lambda: ScriptedMotion(word)
    visits.run()
    assert visits.execution.status == "failure"
    assert visits.hall.now_s() < 5.0
    failure = visits.execution.visits[0].failure
    assert f"expected one of idle, moving, arrived, blocked, got {word!r}" in failure


@settings(max_examples=15)
@given(accept_s=st.floats(0.0, 0.4))
def test_a_base_may_be_idle_until_it_has_accepted_its_command(episode, accept_s: float) -> None:
    visits = episode("johanna", "alice")
    told = visits.hall.motion
    began = {"calls": 0, "t": 0.0}

    def motion() -> ScriptedMotion:
        if len(visits.hall.calls) != began["calls"]:
            began["calls"], began["t"] = len(visits.hall.calls), visits.hall.now_s()
        return told() if visits.hall.now_s() - began["t"] >= accept_s else ScriptedMotion("idle")

    visits.hall.motion = motion
    visits.run()
    assert visits.execution.status == "success"
    assert visits.count("Retry 2(johanna)", "failure") == 0


@settings(max_examples=15)
@given(at_s=st.floats(0.1, 12.0), call=st.sampled_from(("motion", "read", "choose_pose", "dock", "face")))
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
