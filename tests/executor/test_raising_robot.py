"""Whatever the calls of a robot raise, and whenever: everything ends, and every episode has an outcome."""

from __future__ import annotations

import math

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from py_trees.blackboard import Blackboard

from comity_executor import Execution
from tests.executor.conftest import Hall, Stander, infer, plan_for

CALLS = (
    *("now_s", "read", "heard", "choose_pose", "go", "renew", "motion", "stop", "emergency"),
    *("perform", "performance"),
)
OUTAGES = st.lists(
    st.tuples(st.sampled_from(CALLS), st.floats(0.0, 20.0), st.sampled_from((0.0, 0.3, 2.0, 60.0))),
    max_size=5,
)
"""Which call raises, from when on, and for how long [s]."""
PRESSES = st.lists(st.tuples(st.floats(0.0, 20.0), st.floats(0.05, 3.0)), max_size=2)


class Unreliable:
    """A robot some of whose calls raise for some time."""

    def __init__(self, hall: Hall, outages: list[tuple[str, float, float]]) -> None:
        self.hall = hall
        self.outages = outages

    def __getattr__(self, name: str) -> object:
        now_s = self.hall.now_s()
        out = any(call == name and start <= now_s <= start + for_s for call, start, for_s in self.outages)
        return _raise if out else getattr(self.hall, name)


def _raise(*_: object, **__: object) -> None:
    raise ConnectionError("the robot does not answer")


@settings(max_examples=60)
@example(outages=[("performance", 7.0, 0.3), ("stop", 7.0, 0.3)], presses=[(7.0, 0.3)])
@example(outages=[("now_s", 3.0, 0.3)], presses=[])
@example(outages=[("stop", 0.0, 60.0), ("performance", 0.0, 60.0)], presses=[])
@given(outages=OUTAGES, presses=PRESSES)
def test_no_exception_leaves_the_tick_and_every_episode_ends_at_rest(outages, presses) -> None:
    """While the stop is pressed the robot rests, as soon as it hears that it is to."""
    hall = Hall({"johanna": Stander(3.0, 0.0), "alice": Stander(3.0, 2.0)})
    robot = Unreliable(hall, [])
    execution = Execution(plan_for(*hall.people), robot, {person: infer() for person in hall.people})
    robot.outages = outages
    is_deaf = "stop" in {call for call, _, _ in outages}
    for _ in range(8000):
        hall.emergency_stop = any(t <= hall.now_s() < t + d for t, d in presses)
        execution.resume()
        if execution.tick() != "running":
            break
        assert is_deaf or not hall.emergency_stop or hall.at_rest
        hall.step()
    assert execution.status in ("success", "failure", "stopped", "stop_unconfirmed")
    robot.outages = []
    execution.tick()  # what could not be stopped is, as soon as it can be
    assert hall.at_rest
    for visit in execution.visits:
        assert visit.outcome != "pending"
        assert visit.failure or visit.outcome == "greeted"


@pytest.mark.parametrize("said", [math.nan, math.inf, 0.5, "noon", None, True])
def test_a_clock_that_goes_back_or_gives_no_time_ends_the_episode_and_is_named(episode, said: object) -> None:
    visits = episode("johanna").run(for_s=1.5)
    visits.hall.now_s = lambda: said
    assert visits.execution.tick() == "stopped"
    assert visits.hall.at_rest
    assert "ClockError: now_s: expected" in visits.execution.visits[0].failure


def test_a_robot_whose_act_cannot_be_asked_for_still_has_it_ended(episode) -> None:
    visits = episode()
    visits.run(until=lambda: visits.is_running("say(johanna)"))
    visits.run(for_s=0.3)
    visits.hall.faults["stop_act"] = ConnectionError("the voice does not answer")
    visits.execution.stop("by the test")
    assert visits.hall.acts_under_way
    del visits.hall.faults["stop_act"]
    visits.execution.tick()
    assert visits.hall.at_rest


def test_a_blackboard_that_is_cleared_in_mid_run_changes_nothing(episode) -> None:
    alone = episode("johanna", "alice").run().execution
    visits = episode("johanna", "alice")
    for cleared_s in (1.0, 3.0, 8.0):
        visits.run(for_s=cleared_s - visits.hall.now_s())
        Blackboard.clear()
    visits.run()
    assert visits.execution.trace_sha256() == alone.trace_sha256()
    assert visits.execution.visits == alone.visits
    assert not [key for key in Blackboard.storage if key.startswith("/comity/")]


def _speaks_of(act: object) -> object:
    return {}[f"{act}?"]


def test_an_exception_says_which_call_and_line_of_the_users_code_raised_it(episode) -> None:
    visits = episode()
    visits.hall.performance = performance
    visits.run(for_s=20.0)
    texts = {cause.text for event in visits.execution.events for cause in event.because}
    line = _speaks_of.__code__.co_firstlineno + 1
    assert f"KeyError: 'say 0?' (test_raising_robot.py:{line}, in performance)" in texts


def performance(act: object) -> object:
    return _speaks_of(act)


@pytest.mark.parametrize(
    ("call", "answer", "missing"),
    [("motion", ("running", 1), "goal, state, text"), ("performance", None, "goal, state, text")],
)
def test_an_answer_of_another_form_is_refused_with_the_calls_name(episode, call, answer, missing) -> None:
    visits = episode()
    visits.run(until=lambda: visits.hall.now_s() > 1.0)
    setattr(visits.hall, call, lambda *_: answer)
    visits.run(for_s=30.0)
    texts = [cause.text for event in visits.execution.events for cause in event.because]
    refused = [text for text in texts if text.startswith(f"StateError: {call}: ")]
    assert refused
    assert all(missing in text and text.endswith(f"got {answer!r}") for text in refused)
