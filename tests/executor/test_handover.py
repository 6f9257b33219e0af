"""From one leaf that moves the base to the next: one command, so that no late stop can hit the new goal."""

from __future__ import annotations

from hypothesis import example, given, settings
from hypothesis import strategies as st
from py_trees.common import Status

from comity_executor import GoalId, MotionGoal
from tests.executor.conftest import CONTROL_S, Hall, Stander, visits_with, within

SPANS = st.lists(st.tuples(st.floats(0.0, 20.0), st.floats(0.05, 4.0)), max_size=3)
"""From when on, and for how long [s]."""


class Logged(Hall):
    """A hall that writes down what the base is commanded in each tick."""

    def __init__(self) -> None:
        super().__init__({"johanna": Stander(3.0, 0.0), "alice": Stander(3.0, 2.0)})
        self.commands: list[tuple[int, str]] = []
        self.stops: list[tuple[int, GoalId | None]] = []

    def go(self, goal: MotionGoal) -> int:
        self.commands.append((self.ticks, goal.kind))
        return super().go(goal)

    def stop(self, goal: GoalId | None = None) -> None:
        if not isinstance(goal, str):
            self.commands.append((self.ticks, "stop"))
            self.stops.append((self.ticks, goal))
        super().stop(goal)


class Late(Logged):
    """A base that cancels some time after it was told to, the goal that it was told to cancel or any."""

    def __init__(self, cancel_s: float) -> None:
        super().__init__()
        self._delay_ticks = round(cancel_s / CONTROL_S)
        self._due: list[tuple[int, GoalId | None]] = []

    def stop(self, goal: GoalId | None = None) -> None:
        self._due.append((self.ticks + self._delay_ticks, goal))

    def step(self) -> None:
        for _, goal in [each for each in self._due if each[0] <= self.ticks]:
            super().stop(goal)
        self._due = [each for each in self._due if each[0] > self.ticks]
        super().step()


@settings(max_examples=15)
@given(cancel_s=st.floats(0.0, 0.5))
def test_however_long_a_cancel_takes_everybody_is_reached_as_soon(cancel_s: float) -> None:
    ends_s = []
    for hall in (Logged(), Late(cancel_s)):
        execution = visits_with(hall)
        while execution.tick() == "running" and hall.now_s() < 60.0:
            hall.step()
        assert execution.status == "success"
        ends_s.append(hall.now_s())
    assert ends_s[0] == ends_s[1]


@settings(max_examples=20)
@example(pressed=[(2.0, 0.5)], blocked=[], silent=[])
@example(pressed=[], blocked=[(1.0, 4.0)], silent=[(3.0, 0.3)])
@given(pressed=SPANS, blocked=SPANS, silent=SPANS)
def test_no_stop_comes_before_another_command_in_one_tick_and_the_base_rests_at_the_end(
    pressed, blocked, silent
) -> None:
    """Whatever is pressed, in the way, or raises in between."""
    hall = Logged()
    execution = visits_with(hall)
    while hall.now_s() < 200.0:
        now_s = hall.now_s()
        hall.emergency_stop = within(pressed, now_s)
        hall.blocked_by = dict.fromkeys(hall.people, "a table") if within(blocked, now_s) else {}
        hall.faults = {"read": ConnectionError("the tracker is silent")} if within(silent, now_s) else {}
        execution.resume()
        if execution.tick() != "running":
            break
        in_this_tick = [verb for tick, verb in hall.commands if tick == hall.ticks]
        assert "stop" not in in_this_tick[:-1], in_this_tick
        assert not hall.emergency_stop or hall.at_rest
        hall.step()
    assert execution.status in ("success", "failure")
    assert hall.at_rest


@settings(max_examples=20)
@example(silent=[(2.0, 0.3)], blocked=[])
@given(silent=SPANS, blocked=SPANS)
def test_a_stop_before_the_end_names_its_goal_where_no_stop_is_pressed(silent, blocked) -> None:
    hall = Logged()
    execution = visits_with(hall)
    while hall.now_s() < 200.0:
        now_s = hall.now_s()
        hall.blocked_by = dict.fromkeys(hall.people, "a table") if within(blocked, now_s) else {}
        hall.faults = {"read": ConnectionError("the tracker is silent")} if within(silent, now_s) else {}
        execution.resume()
        if execution.tick() != "running":
            break
        hall.step()
    assert all(goal is not None for tick, goal in hall.stops if tick < hall.ticks)


def test_a_tree_that_is_halted_from_outside_leaves_the_base_at_rest(episode) -> None:
    visits = episode().run(for_s=2.0)
    assert visits.hall.speed > 0.0
    visits.execution.tree.root.stop(Status.INVALID)
    assert visits.hall.at_rest
