"""The stop that is read in a thread of its own: silence is a stop that is pressed."""

from __future__ import annotations

import threading

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_executor import Execution, Heartbeat
from tests.executor.conftest import Hall, Stander, infer, plan_for


@given(silent_s=st.floats(0.0, 10.0))
def test_what_was_said_holds_for_half_a_second_and_is_pressed_after_it(silent_s: float) -> None:
    now_s = [0.0]
    heartbeat = Heartbeat(lambda: False, clock=lambda: now_s[0])
    assert heartbeat.read() is not False, "nothing was heard yet"
    heartbeat.look()
    now_s[0] += silent_s
    assert (heartbeat.read() is False) == (silent_s <= 0.5)


@pytest.mark.parametrize("said", [False, None, True, "the button"])
def test_it_says_what_the_robot_says(said: object) -> None:
    heartbeat = Heartbeat(lambda: said)
    heartbeat.look()
    assert heartbeat.read() is said


def test_a_call_that_raises_is_pressed() -> None:
    def ask() -> bool:
        raise OSError("no such device")

    heartbeat = Heartbeat(ask)
    heartbeat.look()
    assert "no such device" in heartbeat.read()


def test_a_call_that_does_not_return_stops_the_robot_in_mid_motion() -> None:
    """Until it returns and says that nothing is pressed, and somebody resumes."""
    hall = Hall({"johanna": Stander(3.0, 0.0)})
    hangs, may_return = threading.Event(), threading.Event()

    def ask() -> bool:
        if hangs.is_set():
            may_return.wait(60.0)
        return False

    with Heartbeat(ask, clock=hall.now_s) as heartbeat:
        execution = Execution(plan_for("johanna"), hall, {"johanna": infer()}, emergency=heartbeat.read)
        while hall.speed == 0.0:
            heartbeat.look()
            execution.tick()
            hall.step()
        hangs.set()
        for _ in range(12):
            execution.tick()
            hall.step()
        assert hall.at_rest
        assert "nothing was heard of the emergency stop" in execution.stopped_by
        may_return.set()
        hangs.clear()
        while not execution.resume():
            heartbeat.look()
        while execution.tick() == "running":
            heartbeat.look()
            hall.step()
    assert execution.status == "success"
