"""A plan is bound to new numbers, or replaced, while it is under way; here the planner is scripted."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from comity_executor import (
    Cause,
    Execution,
    ExecutionState,
    FaultError,
    History,
    Limits,
    NoPlanUpdate,
    PlanUpdate,
    read_nodes,
    read_trace,
)
from comity_executor.tracing.file import TraceFile

WHY = (Cause("reading", "something changed", None), Cause("condition", "reckoned by hand", None))


@dataclass
class Script:
    """A planner that does as it is told at its times."""

    reviews: dict[float, Callable[[ExecutionState], PlanUpdate]] = field(default_factory=dict)
    """By time, what follows from the news of then."""
    again: Callable[[ExecutionState], PlanUpdate | NoPlanUpdate] = lambda course: NoPlanUpdate(WHY)
    permits: Callable[[ExecutionState], PlanUpdate | None] = lambda course: None
    courses: list[ExecutionState] = field(default_factory=list)

    def has_news(self, t: float) -> bool:
        return any(due <= t for due in self.reviews)

    def review(self, course: ExecutionState) -> PlanUpdate:
        self.courses.append(course)
        return self.reviews.pop(min(self.reviews))(course)

    def permitted(self, course: ExecutionState) -> PlanUpdate | None:
        return self.permits(course)

    def replan(self, course: ExecutionState) -> PlanUpdate | NoPlanUpdate:
        self.courses.append(course)
        return self.again(course)


def planned(visits, script: Script, **limits: float):
    """The same episode with a planner."""
    visits.execution = Execution(visits.plan, visits.hall, visits.values, Limits(**limits), planner=script)
    return visits


def with_number(name: str, number: float) -> Callable[[ExecutionState], PlanUpdate]:
    """The plan as it is, with another number in every step that has it."""

    def revise(course: ExecutionState) -> PlanUpdate:
        steps = tuple(
            replace(step, parameters={**step.parameters, name: number}) if name in step.parameters else step
            for step in course.plan.steps
        )
        return PlanUpdate(replace(course.plan, steps=steps), course.values, replanned=False, because=WHY)

    return revise


def anew(course: ExecutionState, *, unserved: dict[str, str] | None = None) -> PlanUpdate:
    """The steps of whoever is left, as a new plan, in the opposite order."""
    stops = [course.plan.steps[i : i + 2] for i in range(0, len(course.plan.steps), 2)]
    left = [step for stop in stops[::-1] if stop[0].person not in course.done for step in stop]
    kept = tuple(step for step in left if step.person not in (unserved or {}))
    plan = replace(course.plan, steps=kept)
    return PlanUpdate(plan, course.values, replanned=True, because=WHY, unserved=unserved or {})


def of_plans(execution: Execution) -> list[tuple[str, float]]:
    return [
        (event.status, event.t)
        for event in execution.events
        if event.status in ("rebound", "replanned", "not_replanned")
    ]


@pytest.mark.parametrize(("at_s", "approaches"), [(0.0, 1), (1.0, 1), (2.3, 1), (4.0, 2)])
def test_a_distance_that_is_bound_anew_is_where_the_robot_stops(episode, at_s, approaches) -> None:
    """Before it sets out, on the way, while it docks; and it docks again where it greets too near already."""
    visits = planned(episode(), Script({at_s: with_number("conversational_distance", 1.3)})).run()
    execution = visits.execution
    assert execution.visits[0].outcome == "greeted"
    assert visits.hall.read("johanna").distance_m == pytest.approx(1.3, abs=0.011)
    assert execution.visits[0].wanted.distance_m == 1.3
    assert visits.count("Reach_user(johanna)", "running") == approaches
    assert [status for status, _ in of_plans(execution)] == ["rebound"]


def test_a_small_change_while_it_greets_is_followed_without_docking_again(episode) -> None:
    script = Script({4.0: with_number("conversational_distance", 1.11)})
    visits = planned(episode(), script)
    visits.run(until=lambda: visits.is_running("say(johanna)"))
    assert visits.hall.now_s() < 4.0
    visits.run()
    assert visits.hall.read("johanna").distance_m == pytest.approx(1.11, abs=0.01)
    assert visits.count("Reach_user(johanna)", "running") == 1


def test_the_speed_is_a_behaviour_parameter_too(episode) -> None:
    times = []
    for speed in (0.1, 0.4):
        visits = planned(episode(), Script({0.0: with_number("approach_speed", speed)})).run()
        times.append(visits.execution.visits[0].docked_s)
    assert times[0] > times[1] + 2.0


def test_what_happened_before_a_rebinding_keeps_its_causes_and_what_comes_after_has_the_new_ones(
    episode,
) -> None:
    """A trace says what held when it happened."""
    script = Script({4.0: with_number("conversational_distance", 1.3)})
    visits = planned(episode(), script).run()
    told = {}
    for event in visits.execution.events:
        for cause in event.because:
            if cause.kind == "parameter" and cause.text.startswith("conversational_distance"):
                told.setdefault(event.t > 3.97, set()).add(cause.value)
    assert told == {False: {1.01}, True: {1.3}}


def test_another_plan_takes_over_at_once_from_where_the_robot_is(episode) -> None:
    """What ran is halted as the plan does not hold; the robot is on its way elsewhere in the same tick."""
    visits = planned(episode("johanna", "alice"), Script({1.0: anew}))
    visits.run(for_s=1.05)
    assert visits.hall.calls[-1] == "navigate alice"
    events = visits.execution.events
    halts = [event for event in events if event.halt]
    assert {event.node for event in halts} >= {"Navigate_to_user(johanna)", "visited(johanna)"}
    assert {event.halt for event in halts} == {"preempted"}
    assert halts[0].because[0].text == "something changed; reckoned by hand"
    (replanned,) = [event for event in events if event.status == "replanned"]
    assert replanned.because == WHY
    visits.run()
    assert visits.execution.status == "success"
    assert [visit.docked_s is not None for visit in visits.execution.visits] == [True, True]


def test_nobody_is_greeted_twice_and_no_gesture_is_repeated_by_a_new_plan(episode) -> None:
    """Johanna's nod is done and her sentence is not when the plan is replaced; then it is replaced again."""
    visits = planned(episode("johanna", "alice"), Script({6.5: anew, 12.0: anew}), replans=5)
    visits.run()
    assert visits.execution.status == "success"
    assert visits.hall.finished.count(("nod", "johanna")) == 1
    assert sorted(visits.hall.finished) == sorted(set(visits.hall.finished))


def test_a_tree_that_fails_is_followed_by_another_plan_and_those_who_were_served_stay_served(episode) -> None:
    visits = episode("johanna", "alice")
    script = Script(again=anew)
    visits = planned(visits, script)
    visits.hall.unreachable.add("johanna")
    visits.run(until=lambda: visits.is_running("say(alice)"))
    visits.hall.unreachable.clear()
    visits.run()
    assert visits.execution.status == "success"
    assert script.courses[-1].done == ("alice",)
    assert script.courses[-1].failures == {"johanna": "no free and reachable place to stand near johanna"}
    assert visits.hall.finished.count(("say", "alice")) == 1


@pytest.mark.parametrize("replans", [0, 1, 3])
def test_the_cap_ends_it_with_who_was_not_served_and_why(episode, replans: int) -> None:
    visits = planned(episode(), Script(again=anew), replans=replans)
    visits.hall.unreachable.add("johanna")
    visits.run()
    execution = visits.execution
    assert execution.status == "failure"
    assert execution.visits[0].outcome == "unreached"
    assert execution.visits[0].failure == "no free and reachable place to stand near johanna"
    plans = [event for event in execution.events if event.status in ("replanned", "not_replanned")]
    told = [(event.status, event.because[-1].text) for event in plans]
    again = [f"another plan is asked for in {pause} s" for pause in (2, 4)]
    cap = f"the limit of {replans} new plans without anything being done is reached"
    assert [status for status, _ in told] == (["replanned", "not_replanned"] * replans or ["not_replanned"])
    assert [text for status, text in told if status == "not_replanned"] == [
        *again[: max(0, replans - 1)],
        cap,
    ]
    assert visits.hall.at_rest


def test_the_cap_counts_anew_once_somebody_was_served(episode) -> None:
    """Two people who cannot be reached at first: each may cost a new plan."""
    visits = planned(episode("johanna", "alice"), Script(again=anew), replans=1)
    visits.hall.unreachable |= {"johanna", "alice"}
    visits.run(until=lambda: len(of_plans(visits.execution)) == 1)
    visits.hall.unreachable.discard("alice")
    visits.run(until=lambda: len(of_plans(visits.execution)) == 2)
    visits.hall.unreachable.clear()
    visits.run()
    assert visits.execution.status == "success"


def test_without_a_planner_a_tree_that_fails_has_failed(episode) -> None:
    visits = episode()
    visits.hall.unreachable.add("johanna")
    assert visits.run().execution.status == "failure"
    assert of_plans(visits.execution) == []


def test_a_planner_that_breaks_down_leaves_the_plan_as_it_is_or_ends_it_with_its_words(episode) -> None:
    """Neither a review nor a tree that failed brings the run down."""

    def broken(course: ExecutionState) -> PlanUpdate:
        raise OSError("the engine is gone")

    visits = planned(episode(), Script({2.0: broken})).run()
    assert visits.execution.status == "success"
    (event,) = [event for event in visits.execution.events if event.status == "not_replanned"]
    assert event.because[0].text.startswith(
        "the planner broke down: OSError: the engine is gone (test_revision.py:"
    )
    visits = planned(episode(), Script(again=broken))
    visits.hall.unreachable.add("johanna")
    visits.run()
    assert visits.execution.status == "failure"
    assert [status for status, _ in of_plans(visits.execution)] == ["not_replanned"] * 4
    assert visits.hall.at_rest


def gone(course: ExecutionState) -> PlanUpdate:
    raise OSError("the engine is gone")


def test_what_is_not_permitted_any_more_is_dropped_where_the_planner_breaks_down(episode) -> None:
    """Johanna said no in that very moment: the robot does not go on to her, and greets Alice."""
    script = Script({2.0: gone}, permits=lambda course: anew(course, unserved={"johanna": "she said no"}))
    visits = planned(episode("johanna", "alice"), script).run()
    johanna, alice = visits.execution.visits
    assert (johanna.outcome, johanna.failure, johanna.greeting) == ("unreached", "she said no", ())
    assert alice.outcome == "greeted"
    assert visits.hall.at_rest


def test_a_planner_that_cannot_even_tell_what_is_permitted_ends_the_run_at_rest(episode) -> None:
    script = Script({2.0: gone}, permits=gone, again=gone)
    visits = planned(episode(), script).run()
    assert visits.execution.status == "failure"
    assert visits.execution.visits[0].greeting == ()
    assert visits.hall.at_rest


@pytest.mark.parametrize(("asked_for", "left"), [(True, True), (False, False)])
def test_only_new_plans_that_nobody_asked_for_use_up_the_cap(episode, asked_for: bool, left: bool) -> None:
    """Two in a row, the cap being one; the third review is told whether another would be within it."""

    def asked(course: ExecutionState) -> PlanUpdate:
        return replace(anew(course), was_asked_for=asked_for)

    script = Script(dict.fromkeys((0.5, 1.0), asked) | {1.5: with_number("approach_speed", 0.3)})
    planned(episode("johanna", "alice"), script, replans=2).run()
    assert [course.may_replan for course in script.courses] == [True, True, left]


def test_new_plans_for_changes_leave_all_attempts_for_when_the_tree_fails(episode) -> None:
    """A door flaps twice, and then somebody cannot be reached: the robot tries again all the same."""
    script = Script({0.5: anew, 1.0: anew}, again=anew)
    visits = planned(episode("johanna", "alice"), script, replans=2)
    visits.hall.unreachable.add("alice")
    visits.run(until=lambda: len(of_plans(visits.execution)) == 3)
    visits.hall.unreachable.clear()
    assert visits.run().execution.status == "success"


def test_whom_a_new_plan_cannot_serve_is_said_to_be_left_with_the_reason(episode) -> None:
    script = Script({2.0: lambda course: anew(course, unserved={"johanna": "the door is shut"})})
    visits = planned(episode("johanna", "alice"), script).run()
    johanna, alice = visits.execution.visits
    assert (johanna.outcome, johanna.failure) == ("unreached", "the door is shut")
    assert alice.outcome == "greeted"
    assert visits.execution.status == "failure"


def test_an_emergency_comes_before_a_new_plan(episode) -> None:
    visits = planned(episode("johanna", "alice"), Script({2.0: anew}))
    visits.run(for_s=1.9)
    visits.hall.emergency_stop = "the button"
    visits.run(for_s=1.0)
    assert of_plans(visits.execution) == []
    assert visits.hall.at_rest
    visits.hall.emergency_stop = False
    visits.run()
    assert [status for status, _ in of_plans(visits.execution)] == ["replanned"]
    assert visits.execution.status == "success"


@settings(max_examples=20)
@given(
    times=st.lists(st.floats(0.0, 14.0), min_size=1, max_size=4, unique=True),
    kinds=st.lists(st.booleans(), min_size=4, max_size=4),
)
def test_whenever_it_is_revised_the_trace_is_one_story_that_reads_back(
    episode, tmp_path_factory, times, kinds
):
    """Paths are those of the nodes, times never run back, and the file has the bytes of the encoding."""
    number = with_number("conversational_distance", 1.2)
    script = Script({t: anew if new else number for t, new in zip(times, kinds, strict=False)})
    visits = planned(episode("johanna", "alice"), script, replans=9)
    path = tmp_path_factory.mktemp("trace") / "trace.jsonl"
    execution = visits.execution
    with TraceFile(path, execution.nodes) as file:
        while visits.hall.now_s() < 60.0 and execution.tick() == "running":
            visits.hall.step()
            if visits.hall.ticks % 7 == 0:
                file.keep(execution.events, execution.nodes)
        file.keep(execution.events, execution.nodes)
    assert execution.status == "success"
    assert sorted(visits.hall.finished) == sorted(set(visits.hall.finished)), "nothing twice"
    assert path.read_text().splitlines() == list(execution.trace_lines())
    assert read_nodes(path) == execution.nodes
    assert [node.path for node in execution.nodes] == list(range(len(execution.nodes)))
    for event, read in zip(execution.events, read_trace(path), strict=True):
        assert (event.node, event.path, event.status) == (read.node, read.path, read.status)
        assert execution.nodes[event.path].name == event.node
    ts = [event.t for event in execution.events]
    assert ts == sorted(ts)
    assert len(list(History(execution.nodes, execution.events).whys())) == len(ts)


@settings(max_examples=30)
@given(
    shut=st.lists(st.booleans(), min_size=1, max_size=40),
    patience_s=st.sampled_from((0.0, 1.0, 5.0, 20.0)),
)
def test_waiting_for_a_way_uses_up_patience_and_no_attempts_and_has_an_end(episode, shut, patience_s):
    """However often the way opens and shuts: every plan fails at once here, and a wait costs at least 2 s."""

    def again(course: ExecutionState) -> PlanUpdate | NoPlanUpdate:
        is_shut = shut[round(course.t * 20) % len(shut)]
        nobody = replace(anew(course, unserved={"johanna": "shut"}), plan=replace(course.plan, steps=()))
        return NoPlanUpdate(WHY, awaits="a door may be opened") if is_shut else nobody

    script = Script({0.0: lambda course: anew(course, unserved={"johanna": "shut"})}, again=again)
    visits = planned(episode(), script, patience_s=patience_s)
    visits.run(until=lambda: visits.hall.now_s() > 300.0)
    assert visits.execution.status == "failure"
    waits, pauses_s = 1.0 + patience_s / 2.0, 2.0 + 4.0 + 8.0
    assert visits.hall.now_s() <= patience_s + (1.0 + waits) * pauses_s + 1.0
    if all(shut):
        assert visits.hall.now_s() == pytest.approx(patience_s, abs=0.06)


def test_while_it_waits_the_robot_looks_to_where_somebody_should_be_whom_it_does_not_see(episode):
    look = NoPlanUpdate(WHY, awaits="johanna may stand otherwise", look_for="johanna")
    script = Script(
        {0.0: lambda course: anew(course, unserved={"johanna": "no place"})}, again=lambda _: look
    )
    visits = planned(episode(), script, patience_s=5.0)
    visits.run(until=lambda: visits.hall.now_s() >= 4.0)
    assert visits.execution.status == "running"
    assert visits.hall.calls[-1] == "face johanna"


def test_a_robot_that_cannot_turn_waits_all_the_same(episode):
    look = NoPlanUpdate(WHY, awaits="johanna may stand otherwise", look_for="johanna")
    script = Script(
        {0.0: lambda course: anew(course, unserved={"johanna": "no place"})}, again=lambda _: look
    )
    visits = planned(episode(), script, patience_s=5.0)
    visits.hall.faults["face"] = FaultError("fault: it cannot")
    visits.run()
    assert visits.execution.status == "failure"
    assert visits.hall.now_s() == pytest.approx(5.0, abs=0.06)


def test_without_a_planner_a_visit_that_never_began_ends_with_the_reason(episode):
    visits = episode("johanna", "alice")
    visits.execution.raise_in("plan_holds?", FaultError("fault: it raises"))
    visits.run()
    assert visits.execution.status == "failure"
    ends = [(visit.outcome, visit.failure) for visit in visits.execution.visits]
    assert ends == [("unreached", "an exception: fault: it raises")] * 2
