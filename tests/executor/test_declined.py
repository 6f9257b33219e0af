"""A person may decline: the visit ends, the others are visited, and nobody asks again."""

from __future__ import annotations

from dataclasses import replace
from math import inf

from hypothesis import given, settings
from hypothesis import strategies as st

from tests.executor.test_revision import Script, anew, planned

HOW = "walked by the robot, 0.9 m from it"


def declines(visits, person: str, *, from_s: float = 1.0):
    """Have the base say of every motion towards a person that they decline, from a time on."""
    told, go, to = visits.hall.motion, visits.hall.go, [""]

    def note(goal):
        to[0] = goal.to
        return go(goal)

    def motion():
        is_over = to[0] == person and visits.hall.now_s() >= from_s
        return replace(told(), state="declined", text=HOW) if is_over else told()

    visits.hall.go, visits.hall.motion = note, motion
    return visits


@settings(max_examples=10)
@given(from_s=st.floats(0.5, 6.0))
def test_a_visit_that_is_declined_is_over_and_the_others_are_made(episode, from_s) -> None:
    visits = declines(episode("johanna", "alice"), "johanna", from_s=from_s).run()
    johanna, alice = visits.execution.visits
    if "say" not in johanna.greeting:
        assert (johanna.outcome, johanna.failure) == ("declined", f"declined: {HOW}")
    assert alice.outcome == "greeted"
    assert visits.execution.status == "success"


def test_a_person_who_was_greeted_and_then_walks_on_has_not_declined(episode) -> None:
    visits = declines(episode("johanna", "alice"), "johanna", from_s=inf)
    visits.run(until=lambda: visits.execution.visits[0].outcome == "greeted")
    declines(visits, "johanna", from_s=0.0).run()
    johanna = visits.execution.visits[0]
    assert (johanna.outcome, johanna.failure) == ("greeted", None)
    texts = [cause.text for event in visits.execution.events for cause in event.because]
    assert [text for text in texts if text.startswith("declined")] == []


def test_the_robot_is_not_told_to_go_to_a_person_who_declined(episode) -> None:
    visits = declines(episode("johanna", "alice"), "johanna")
    goals, go = [], visits.hall.go
    visits.hall.go = lambda goal: (goals.append((visits.hall.now_s(), goal.to)), go(goal))[1]
    visits.run()
    assert [t for t, to in goals if to == "johanna" and t > 1.2] == []


def test_the_trace_says_how_the_person_declined(episode) -> None:
    visits = declines(episode("johanna"), "johanna").run()
    because = [
        cause.text
        for event in visits.execution.events
        if event.node == "given_up?(johanna)" and event.status == "success"
        for cause in event.because
    ]
    assert because == [f"declined: {HOW}"]


def test_a_planner_is_told_that_nothing_is_left_to_do_for_a_person_who_declined(episode) -> None:
    script = Script()
    visits = declines(planned(episode("johanna", "alice"), script, replans=1), "johanna")
    visits.hall.unreachable.add("alice")
    visits.run()
    assert [course.done for course in script.courses] == [("johanna",)]
    assert "johanna" not in script.courses[0].failures
    assert visits.execution.status == "failure"


def test_another_plan_for_the_others_leaves_a_person_who_declined_alone(episode) -> None:
    script = Script(again=anew)
    visits = declines(planned(episode("johanna", "alice"), script), "johanna")
    visits.hall.unreachable.add("alice")
    visits.run(until=lambda: bool(script.courses))
    visits.hall.unreachable.clear()
    visits.run()
    assert [visit.outcome for visit in visits.execution.visits] == ["declined", "greeted"]
    assert visits.execution.status == "success"


def test_where_all_declined_no_other_plan_is_asked_for(episode) -> None:
    script = Script()
    visits = declines(planned(episode("johanna"), script), "johanna").run()
    assert visits.execution.status == "success"
    assert script.courses == []
