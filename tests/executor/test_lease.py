"""A goal holds only while ticks renew it: a base whose controller is silent or held up stops by itself."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from comity_executor import CapabilityValues, Execution, RobotError, ScriptedRobot
from tests.executor.conftest import CONTROL_S, LEASE_S, Hall, Stander, infer, plan_for, visits_with


class HeldUp(Hall):
    """A robot one of whose calls once takes its time; the world goes on meanwhile."""

    def __init__(self, call: str, at_s: float, takes_s: float) -> None:
        super().__init__({"johanna": Stander(3.0, 0.0), "alice": Stander(3.0, 2.0)})
        self._call, self._at_s, self._takes_s = call, at_s, takes_s
        self.held_up_from: int | None = None
        """How many commands there were when the call took its time."""

    def _fail(self, call: str) -> None:
        super()._fail(call)
        if call == self._call and self.held_up_from is None and self.now_s() >= self._at_s:
            self.held_up_from = len(self.calls)
            for _ in range(round(self._takes_s / CONTROL_S)):
                self.step()


@settings(max_examples=20)
@given(frozen_s=st.floats(0.0, 9.0), for_s=st.floats(0.4, 20.0))
def test_a_base_that_is_not_ticked_stops_within_its_lease_and_sets_out_again_by_a_new_goal_only(
    episode, frozen_s: float, for_s: float
) -> None:
    """As after SIGSTOP and SIGCONT: what was under way is over, and the next goal is sensed and commanded."""
    visits = episode("johanna", "alice")
    hall, execution = visits.hall, visits.execution
    visits.run(for_s=frozen_s)
    goals, moved = hall.goals, []
    for tick in range(round(for_s / CONTROL_S)):
        hall.step()
        if tick * CONTROL_S > LEASE_S + CONTROL_S:
            moved.append(hall.speed)
    assert not any(moved)
    execution.tick()
    hall.step()
    assert hall.goals > goals or hall.speed == 0.0
    assert visits.run().execution.status == "success"


@settings(max_examples=20)
@given(
    call=st.sampled_from(("read", "motion", "choose_pose", "performance")),
    at_s=st.floats(0.0, 9.0),
    takes_s=st.floats(0.4, 8.0),
)
def test_nothing_begins_in_a_tick_that_was_held_up(call: str, at_s: float, takes_s: float) -> None:
    hall = HeldUp(call, at_s, takes_s)
    execution = visits_with(hall)
    status = "running"
    while status == "running" and hall.held_up_from is None and hall.now_s() < 60.0:
        status = execution.tick()
        if hall.held_up_from is None:
            hall.step()
    if hall.held_up_from is not None:
        assert len(hall.calls) == hall.held_up_from
    while execution.tick() == "running" and hall.now_s() < 160.0:
        hall.step()
    assert execution.status == "success"


def test_a_goal_that_cannot_be_renewed_is_lost_and_the_next_attempt_has_a_new_one(episode) -> None:
    visits = episode("johanna")
    visits.run(for_s=1.0)
    visits.hall.faults["renew"] = ConnectionError("the base does not answer")
    visits.run(for_s=1.0)
    assert visits.hall.speed == 0.0
    goals = visits.hall.goals
    del visits.hall.faults["renew"]
    assert visits.run().execution.status == "success"
    assert visits.hall.goals > goals


@pytest.mark.parametrize("lease_s", [0.0, -0.1, 0.31, float("inf"), float("nan"), None, "0.3", True])
def test_a_base_that_does_not_stop_by_itself_in_time_is_refused(episode, lease_s: object) -> None:
    visits = episode()
    visits.hall.can = CapabilityValues(lease_s=lease_s)
    with pytest.raises(RobotError, match=r"capabilities\.lease_s: expected a time above 0"):
        Execution(visits.plan, visits.hall, visits.values)


def test_the_scripted_robot_stops_when_its_goal_is_not_renewed() -> None:
    robot = ScriptedRobot({"johanna": 3.0})
    execution = Execution(plan_for("johanna"), robot, {"johanna": infer()})
    for _ in range(5):
        execution.tick()
        robot.step()
    assert robot.read("johanna").speed_m_s > 0.0
    for _ in range(5):
        robot.step()
    assert robot.read("johanna").speed_m_s == 0.0
    while execution.tick() == "running":
        robot.step()
    assert execution.status == "success"
