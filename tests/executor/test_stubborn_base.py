"""Bases that do not do at once what they are told: stops that are lost, two controllers on the same base."""

from __future__ import annotations

from collections import deque

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from comity_executor import Execution, GoalId, MotionGoal
from tests.executor.conftest import CONTROL_S, Hall, Stander, infer, plan_for


class LosesStops(Hall):
    """A base that does not hear the first few of the stops that follow one another."""

    def __init__(self, lost: int) -> None:
        super().__init__({"johanna": Stander(3.0, 0.0)})
        self._lost = self._left = lost

    def go(self, goal: MotionGoal) -> int:
        self._left = self._lost
        return super().go(goal)

    def stop(self, goal: GoalId | None = None) -> None:
        if not isinstance(goal, str) and self._left > 0:
            self._left -= 1
        else:
            super().stop(goal)


class TwoControllers(Hall):
    """One controller navigates, another one docks and turns; each takes its time to acknowledge its end.

    The adapter holds a goal back until the controller of the goal before has acknowledged.
    """

    def __init__(self, cancel_s: float) -> None:
        super().__init__({"johanna": Stander(3.0, 0.0), "alice": Stander(3.0, 2.0)})
        self._delay_ticks = round(cancel_s / CONTROL_S)
        self._controller = ""
        self._acknowledged_tick = 0
        self._held_back: deque[MotionGoal] = deque(maxlen=1)

    def go(self, goal: MotionGoal) -> int:
        controller = "navigation" if goal.kind == "navigate" else "docking"
        if self._goal is not None and controller != self._controller:
            self._goal, self.speed = None, 0.0
            self._acknowledged_tick = self.ticks + self._delay_ticks
        self._controller = controller
        self._held_back.append(goal)
        self.goals += 1
        self._release()
        return self.goals

    def step(self) -> None:
        self._release()
        super().step()

    def motion(self):
        if not self._held_back:
            return super().motion()
        return type(super().motion())(self.goals, "accepted", stamp_s=self.now_s())

    def stop(self, goal: GoalId | None = None) -> None:
        if not isinstance(goal, str):
            self._held_back.clear()
        super().stop(goal)

    def _release(self) -> None:
        if self._held_back and self.ticks >= self._acknowledged_tick:
            goal = self._held_back.pop()
            self.goals -= 1  # it has its number already
            super().go(goal)


@settings(max_examples=15)
@given(lost=st.integers(0, 20), at_s=st.floats(0.5, 4.0))
def test_a_stop_is_repeated_until_the_base_rests(lost: int, at_s: float) -> None:
    hall = LosesStops(lost)
    execution = Execution(plan_for("johanna"), hall, {"johanna": infer()})
    while hall.now_s() < at_s:
        execution.tick()
        hall.step()
    hall.emergency_stop = "the button"
    for _ in range(lost + 1):
        execution.tick()
    assert hall.at_rest
    hall.emergency_stop = False
    execution.resume()
    while execution.tick() == "running" and hall.now_s() < 60.0:
        hall.step()
    assert execution.status == "success"
    for _ in range(lost + 1):
        execution.tick()
    assert hall.at_rest


@pytest.mark.parametrize("cancel_s", [0.0, 0.05, 0.3, 1.5])
def test_two_controllers_are_handed_over_to_whatever_a_cancel_takes(cancel_s: float) -> None:
    hall = TwoControllers(cancel_s)
    execution = Execution(plan_for(*hall.people), hall, {person: infer() for person in hall.people})
    while execution.tick() == "running" and hall.now_s() < 120.0:
        hall.step()
    assert execution.status == "success"
    assert hall.at_rest
