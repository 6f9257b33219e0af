"""What a base states of itself: its tolerance widens the bands outwards, and keeps people's distances."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from comity_executor import CapabilityValues, Execution, Limits, RobotError, check_robot
from comity_executor.leaves.docking_band import enter_band, leave_band, lost_band
from comity_executor.robots.goals import PlannedPose
from tests.executor.conftest import Hall, Stander, infer, plan_for

FLOOR_M = Limits().safety_floor_m


class Inexact(Hall):
    """A base that comes to rest some way off where it was told to, and says that it is there."""

    def __init__(self, *, off_m: float, tolerance_m: float) -> None:
        super().__init__({"johanna": Stander(3.0, 0.0)})
        self.can = CapabilityValues(tolerance_m=tolerance_m, lease_s=0.3)
        self._off_m = off_m

    def _way(self) -> tuple[float, float, float]:
        verb, person, pose, speed = self._goal
        if verb != "dock":
            return super()._way()
        self._goal = (verb, person, replace(pose, distance_m=pose.distance_m + self._off_m), speed)
        try:
            return super()._way()
        finally:
            self._goal = (verb, person, pose, speed)


def visit(hall: Hall, distance_m: float = 1.01) -> Execution:
    execution = Execution(plan_for("johanna", distance_m=distance_m), hall, {"johanna": infer(distance_m)})
    while execution.tick() == "running" and hall.now_s() < 300.0:
        hall.step()
    return execution


@given(tolerance_m=st.floats(0.0, 0.5), distance_m=st.floats(FLOOR_M, 3.0))
def test_tolerance_widens_every_band_outwards_and_never_inwards(tolerance_m, distance_m) -> None:
    pose = PlannedPose(distance_m, 0.0)
    for band in (enter_band, lost_band, leave_band):
        exact, wide = band(pose, Limits()), band(pose, Limits(tolerance_m=tolerance_m))
        assert wide.nearest_m == exact.nearest_m
        assert wide.farthest_m == pytest.approx(exact.farthest_m + tolerance_m)


@settings(max_examples=20)
@example(share=1.0, tolerance_m=0.03)
@given(share=st.floats(0.0, 1.0), tolerance_m=st.floats(0.0, 0.2))
def test_a_base_that_stops_farther_off_by_its_tolerance_docks(share: float, tolerance_m: float) -> None:
    execution = visit(Inexact(off_m=share * tolerance_m, tolerance_m=tolerance_m))
    assert execution.status == "success"


@settings(max_examples=20)
@given(share=st.floats(-1.0, 1.0), tolerance_m=st.floats(0.0, 0.2), distance_m=st.floats(FLOOR_M, 0.6))
def test_no_base_comes_nearer_than_the_safety_floor_by_its_tolerance(share, tolerance_m, distance_m) -> None:
    hall = Inexact(off_m=share * tolerance_m, tolerance_m=tolerance_m)
    execution = Execution(plan_for("johanna", distance_m=distance_m), hall, {"johanna": infer(distance_m)})
    while execution.tick() == "running" and hall.now_s() < 120.0:
        hall.step()
        assert hall.read("johanna").distance_m >= FLOOR_M - 1e-9


def test_a_base_that_stops_too_far_off_is_told_by_the_reading_against_the_band() -> None:
    """And soon: not when the time for the attempt is over."""
    hall = Inexact(off_m=0.03, tolerance_m=0.0)
    execution = visit(hall)
    assert execution.visits[0].outcome == "unreached"
    assert "distance 1.04 m is not in 1.00..1.02 around 1.01" in execution.visits[0].failure
    assert hall.now_s() < 30.0


def test_an_exact_robot_fits_and_hears_from_which_tolerance_on_distances_are_the_same(episode) -> None:
    values = {"johanna": infer(0.64), "alice": infer(0.85), "bob": infer(0.90)}
    check = check_robot(episode().hall, ["johanna"], values)
    assert check.problems == ()
    assert check.distinct_below_m == pytest.approx(0.05)
    assert check.indistinct == ()
    rough = episode().hall
    rough.can = CapabilityValues(tolerance_m=0.06, lease_s=0.3)
    assert check_robot(rough, (), values).indistinct == (("alice", "bob"),)


WRONG = {
    "emergency": [None, lambda: None, lambda: 0, lambda why: False],
    "go": [None, lambda: 1],
    "read": [None, lambda person: {"distance_m": 3.0}, lambda: None],
    "motion": [None, lambda: "moving", lambda: {"state": "running"}],
    "perform": [None],
    "renew": [None, lambda: None],
    "performance": [None, lambda: None],
    "stop": [None, lambda: None],
    "choose_pose": [None, lambda person: None],
    "now_s": [None, 3.0],
    "can": [None, CapabilityValues(tolerance_m=-0.1), CapabilityValues(braking_m_s2=0.0)],
}


@pytest.mark.parametrize(
    ("name", "wrong"), [(name, each) for name, several in WRONG.items() for each in several]
)
def test_a_robot_that_lacks_something_is_refused_before_the_first_tick_and_told_what(
    episode, name: str, wrong: object
) -> None:
    visits = episode()
    hall = Hall({"johanna": Stander(3.0, 0.0)})
    setattr(hall, name, wrong)
    with pytest.raises(RobotError, match="capabilities" if name == "can" else name):
        Execution(visits.plan, hall, visits.values)
    assert hall.calls == []


def test_all_that_is_wrong_is_told_at_once(episode) -> None:
    visits = episode()
    with pytest.raises(RobotError) as refused:
        Execution(visits.plan, object(), visits.values)
    assert all(name in str(refused.value) for name in (*WRONG.keys() - {"can"}, "tolerance_m"))
