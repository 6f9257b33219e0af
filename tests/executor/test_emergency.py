"""The emergency stop: everything stops at once, and goes on where it was when somebody resumes."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from comity_executor import CapabilityValues, FaultError, Limits
from tests.executor.conftest import Episode, Hall, Stander, plan_for

PRESSES = st.lists(st.tuples(st.floats(0.0, 9.0), st.floats(0.05, 3.0)), max_size=3)
"""When it is pressed, and for how long [s]."""


def run_with(visits, presses) -> None:
    """Carry the plan out; the robot must be at rest in every tick in which the stop is pressed."""
    hall, execution = visits.hall, visits.execution
    while hall.now_s() < 120.0:
        now_s = hall.now_s()
        hall.emergency_stop = "the button" if any(t <= now_s < t + d for t, d in presses) else False
        execution.resume()
        if execution.tick() != "running":
            return
        assert hall.at_rest or hall.emergency_stop is False, f"moves or acts at {now_s} s"
        hall.step()


@settings(max_examples=25)
@example(presses=[(0.0, 1.3125), (5.78125, 1.0)])  # in the tick in which the nod comes to its end
@given(presses=PRESSES)
def test_the_robot_rests_while_it_is_pressed_and_greets_everybody_once_afterwards(episode, presses) -> None:
    """Whenever and as often as it is pressed: no motion, no act, nothing twice, and the same end."""
    visits = episode("johanna", "alice")
    run_with(visits, presses)
    assert visits.execution.status == "success"
    for person in ("johanna", "alice"):
        assert visits.hall.finished.count(("say", person)) == 1
        assert visits.hall.finished.count(("nod", person)) == 1


def test_what_it_halts_is_halted_by_the_emergency_with_its_reason(episode) -> None:
    visits = episode()
    visits.run(until=lambda: visits.is_running("say(johanna)"))
    visits.run(for_s=0.1)
    visits.hall.emergency_stop = "the bumper touched a chair"
    visits.run(for_s=0.0)
    now_s = visits.hall.now_s()
    halts = [event for event in visits.execution.events if event.t == now_s and event.halt]
    assert {"Goal", "Keep_distance(johanna)", "say(johanna)", "nod(johanna)"} <= {e.node for e in halts}
    assert {event.halt for event in halts} == {"emergency"}
    for event in halts:
        texts = [cause.text for cause in event.because]
        assert texts == ["the bumper touched a chair", "emergency? -> success"]


def test_a_gesture_that_was_done_before_is_not_repeated(episode) -> None:
    visits = episode()
    visits.run(until=lambda: ("nod", "johanna") in visits.hall.finished)
    visits.run(for_s=0.1)
    visits.hall.emergency_stop = "the button"
    visits.run(for_s=2.0)
    visits.hall.emergency_stop = False
    visits.run()
    assert visits.execution.visits[0].greeting == ("say", "nod")
    assert visits.hall.calls.count("nod johanna") == 1
    assert visits.hall.calls.count("say johanna: Hello, Johanna.") == 2, "it was broken off"


def test_a_stop_that_cannot_be_read_counts_as_pressed(episode) -> None:
    visits = episode()
    visits.run(for_s=1.0)
    visits.hall.faults["emergency"] = OSError("no such device")
    visits.run(for_s=1.0)
    assert visits.hall.at_rest
    assert visits.is_running("Stand_still")
    visits.execution.stop("the end")
    assert visits.execution.status == "stopped"


@settings(max_examples=25)
@given(
    pressed_s=st.floats(0.0, 9.0),
    times=st.integers(1, 200),
    broken=st.sampled_from(("Stand_still", "emergency?")),
)
def test_nothing_of_the_goal_goes_on_whatever_the_leaves_of_the_stop_raise(
    episode, pressed_s, times, broken
) -> None:
    """Neither does anything begin: the robot rests from the tick of the press on, and gets no command."""
    visits = episode("johanna", "alice")
    hall, execution = visits.hall, visits.execution
    visits.run(for_s=pressed_s)
    hall.emergency_stop = "the button"
    execution.raise_in(broken, FaultError("a driver that raises"), times=times)
    begun = list(hall.calls)
    for _ in range(60):
        if execution.tick() != "running":
            break
        assert hall.at_rest
        assert hall.calls == begun
        hall.step()


def test_a_stop_that_raises_is_commanded_again_until_it_is_heard(episode) -> None:
    visits = episode()
    visits.run(for_s=2.0)
    assert not visits.hall.at_rest
    visits.hall.emergency_stop = "the button"
    visits.hall.faults["stop"] = ConnectionError("the base does not answer")
    visits.run(for_s=0.5)
    assert visits.is_running("Stand_still")
    assert "Goal" in {event.node for event in visits.execution.events if event.halt == "emergency"}
    del visits.hall.faults["stop"]
    visits.execution.tick()
    assert visits.hall.at_rest


@settings(max_examples=25)
@given(pressed_s=st.floats(0.0, 9.0), for_s=st.floats(0.05, 3.0), waits_s=st.floats(0.05, 30.0))
def test_a_stop_that_was_released_waits_for_resume(episode, pressed_s, for_s, waits_s) -> None:
    visits = episode("johanna", "alice")
    hall, execution = visits.hall, visits.execution
    visits.run(for_s=pressed_s)
    hall.emergency_stop = "the button"
    visits.run(for_s=for_s)
    assert not execution.resume(), "it is still pressed"
    hall.emergency_stop = False
    begun = list(hall.calls)
    visits.run(for_s=waits_s, resumes=False)
    assert (execution.status, execution.stopped_by, execution.is_at_rest) == ("running", "the button", True)
    assert hall.calls == begun
    assert execution.resume()
    assert visits.run(resumes=False).execution.status == "success"
    assert execution.stopped_by is None


def test_nothing_happens_when_a_robot_is_told_to_resume_that_was_not_stopped(episode) -> None:
    alone, resumed = episode("johanna"), episode("johanna")
    assert alone.run(resumes=False).execution.trace_sha256() == resumed.run().execution.trace_sha256()


@settings(max_examples=25)
@given(
    pressed_s=st.floats(0.0, 4.0),
    braking_m_s2=st.floats(0.05, 2.0),
    latency_s=st.floats(0.0, 3.0),
    moves_s=st.floats(0.0, 40.0),
)
def test_a_stop_is_unconfirmed_after_twice_the_stated_braking_time_and_commanded_still(
    episode, pressed_s, braking_m_s2, latency_s, moves_s
) -> None:
    """But not before 2 s; a base that says in time that it rests has confirmed it."""
    limits = Limits()
    visits = Episode(
        Hall({"johanna": Stander(9.0, 0.0)}, CapabilityValues(0.0, latency_s, braking_m_s2, lease_s=0.3)),
        plan_for("johanna"),
    )
    hall, execution = visits.hall, visits.execution
    visits.run(for_s=pressed_s)
    hall.emergency_stop = "the button"
    hall.goes_on_until_s = hall.now_s() + moves_s
    began_s, patience_s = hall.now_s(), max(2.0, 2 * (latency_s + limits.cruise_speed_m_s / braking_m_s2))
    visits.run(until=lambda: execution.is_at_rest)
    waited_s = hall.now_s() - began_s
    if execution.status == "running":
        assert waited_s <= patience_s + 0.05
        return
    assert execution.status == "stop_unconfirmed"
    assert moves_s > patience_s - 0.05
    assert waited_s == pytest.approx(patience_s, abs=0.06)
    told = hall.stops_told
    execution.tick()
    assert hall.stops_told > told


@pytest.mark.parametrize("said", [False, np.False_])
def test_only_an_explicit_false_is_not_pressed(episode, said: object) -> None:
    visits = episode()
    visits.hall.emergency_stop = said
    visits.run()
    assert visits.execution.status == "success"


@pytest.mark.parametrize("said", [None, True, np.True_, 0, 0.0, "", "the button", (), b"no"], ids=repr)
def test_all_else_is_pressed(episode, said: object) -> None:
    visits = episode()
    visits.hall.emergency_stop = said
    visits.run(for_s=0.5)
    assert visits.is_running("Stand_still")
    assert visits.hall.at_rest
    assert visits.hall.calls == []


@pytest.mark.parametrize("press", [True, False])
def test_a_robot_that_cannot_say_how_an_act_goes_is_told_to_break_it_off(episode, press: bool) -> None:
    """Pressed or not, nothing that it raises leaves the tick, and the episode goes on to its end."""
    visits = episode()
    visits.run(until=lambda: visits.is_running("say(johanna)"))
    visits.run(for_s=0.2)
    visits.hall.faults["performance"] = ConnectionError("the voice does not answer")
    visits.hall.emergency_stop = "the button" if press else False
    visits.run(for_s=0.1)
    assert visits.hall.acts_under_way == set()
    visits.hall.faults.clear()
    visits.hall.emergency_stop = False
    visits.run()
    assert visits.execution.status == "success"


def test_a_robot_without_the_call_is_refused(episode) -> None:
    """A guard that can read nothing would hold the robot for ever."""
    from comity_executor import Execution, RobotError

    visits = episode()
    with pytest.raises(RobotError, match="emergency"):
        Execution(visits.plan, object(), visits.values)
