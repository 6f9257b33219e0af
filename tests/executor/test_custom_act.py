"""A behaviour of the user's own as an act: in the tree like the robot's acts, and as exact in the trace."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal

import py_trees
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from py_trees.behaviour import Behaviour
from py_trees.common import ParallelPolicy, Status
from py_trees.composites import Parallel, Sequence

from comity_executor import Execution, Limits

Doing = Literal["runs", "succeeds", "fails", "raises", "says nothing"]
DOINGS: dict[Doing, Status | None] = {
    "runs": Status.RUNNING,
    "succeeds": Status.SUCCESS,
    "fails": Status.FAILURE,
    "says nothing": None,
}
scripts = st.lists(st.sampled_from((*DOINGS, "runs", "runs", "raises")), min_size=1, max_size=12)


class Juggle(Behaviour):
    """Follows a script, one word a tick, and counts its begins and its ends."""

    def __init__(self, name: str, script: list[Doing] = ["runs"] * 5 + ["succeeds"]) -> None:
        super().__init__(name)
        self.script = list(script)
        self.begins = self.halts = 0

    def initialise(self) -> None:
        self.begins += 1
        self.left = list(self.script)

    def update(self) -> Status:
        doing = self.left.pop(0) if self.left else "succeeds"
        if doing == "raises":
            raise ValueError("a ball fell")
        return DOINGS[doing]  # type: ignore[return-value]

    def terminate(self, new_status: Status) -> None:
        self.halts += self.status is Status.RUNNING and new_status is Status.INVALID
        raise RuntimeError("the balls are gone")  # nothing that it raises leaves the tick


def juggling(episode, make: Callable[[str, str], Behaviour], **limits: float):
    """Johanna is to be greeted with juggling alone."""
    visits = episode("johanna", modality="gestural", gesture="juggle")
    visits.execution = Execution(
        visits.plan, visits.hall, visits.values, Limits(**limits), acts={"juggle": make}
    )
    return visits


def events_of(execution: Execution, name: str) -> list[str]:
    return [event.status for event in execution.events if event.node == name]


def starts(statuses: list[str]) -> int:
    """How often a node began: it runs, or ends without having run before."""
    before = ["", *statuses]
    return sum(last != "running" for last, _ in zip(before, statuses, strict=False))


def test_it_is_done_once_and_the_robot_is_not_asked_for_it(episode) -> None:
    made: list[Juggle] = []

    def make(name: str, person: str) -> Juggle:
        assert person == "johanna"
        made.append(Juggle(name))
        return made[-1]

    visits = juggling(episode, make).run()
    assert visits.execution.status == "success"
    assert visits.execution.visits[0].greeting == ("juggle",)
    assert [each.begins for each in made] == [1]
    assert events_of(visits.execution, "juggle(johanna)") == ["running", "success"]
    assert not [call for call in visits.hall.calls if "juggle" in call]


def test_it_is_halted_with_the_chain_of_causes_and_tried_again(episode) -> None:
    visits = juggling(episode, lambda name, person: Juggle(name, ["runs"] * 40))
    visits.run(until=lambda: visits.is_running("juggle(johanna)"))
    visits.hall.emergency_stop = "pressed"
    visits.run(for_s=0.2)
    halt = next(event for event in visits.execution.events if event.node == "juggle(johanna)" and event.halt)
    assert halt.halt == "emergency"
    assert halt.because[0].text == "pressed"
    visits.hall.emergency_stop = False
    visits.run()
    assert events_of(visits.execution, "juggle(johanna)") == ["running", "halted", "running", "success"]


@pytest.mark.parametrize(
    ("script", "text"),
    [
        (["runs", "raises"], "ValueError: a ball fell"),
        (["says nothing"], "expected RUNNING, SUCCESS or FAILURE"),
    ],
)
def test_what_it_does_wrong_is_a_failure_with_a_text(episode, script, text: str) -> None:
    visits = juggling(episode, lambda name, person: Juggle(name, script), act_timeout_s=3.0)
    visits.run()
    failure = next(
        event
        for event in visits.execution.events
        if event.status == "failure" and event.node == "juggle(johanna)"
    )
    assert text in failure.because[0].text
    assert visits.execution.status == "failure"
    assert visits.execution.visits[0].outcome == "not_greeted"


@settings(max_examples=40)
@given(script=scripts, other=scripts, pressed=st.lists(st.floats(4.0, 12.0), max_size=3))
def test_each_begin_is_a_start_and_each_halt_a_halt(episode, script, other, pressed) -> None:
    """Of two behaviours in one act, side by side, however they end and whenever the stop is pressed."""
    made: list[tuple[Juggle, Juggle]] = []

    def make(name: str, person: str) -> Behaviour:
        both = Juggle("left", script), Juggle("right", other)
        made.append(both)
        one_by_one = Sequence("hands", memory=True, children=[both[1]])
        return Parallel(name, ParallelPolicy.SuccessOnOne(), [both[0], one_by_one])

    visits = juggling(episode, make, act_timeout_s=3.0)
    while visits.hall.now_s() < 60.0 and visits.execution.tick() == "running":
        visits.execution.resume()
        now_s = visits.hall.now_s()
        visits.hall.emergency_stop = "pressed" if any(t <= now_s < t + 0.5 for t in pressed) else False
        visits.hall.step()
    (one,) = made
    for juggle in one:
        statuses = events_of(visits.execution, juggle.name)
        assert starts(statuses) == juggle.begins
        assert statuses.count("halted") == juggle.halts


def test_a_behaviour_of_py_trees_will_do(episode) -> None:
    def ticks(name: str, person: str) -> Behaviour:
        return py_trees.behaviours.TickCounter(name, duration=4, completion_status=Status.SUCCESS)

    assert juggling(episode, ticks).run().execution.status == "success"


def test_what_is_no_behaviour_and_what_must_be_the_robots_is_refused(episode) -> None:
    with pytest.raises(TypeError, match=r"acts\['juggle'\].*juggle\(johanna\)"):
        juggling(episode, lambda name, person: "juggles")  # type: ignore[arg-type, return-value]
    visits = episode()
    with pytest.raises(ValueError, match="hand_over"):
        Execution(visits.plan, visits.hall, visits.values, acts={"hand_over": lambda name, _: Juggle(name)})
