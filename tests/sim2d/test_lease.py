"""The simulated base stops by itself when its goal is not renewed, as a real one should."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from comity_executor import MotionGoal
from comity_sim2d import DockingPose, Person, RobotBody, Room, Scene, World
from comity_sim2d.robot.lease import LEASE_S

BRAKING_S = 3.0
"""From full speed, with the usual limits of acceleration and jerk."""


def hall(drive: str) -> tuple[World, MotionGoal]:
    scene = Scene(
        Room.rectangle(20.0, 6.0), RobotBody(1.0, 3.0, drive=drive), (Person("p0", 18.0, 3.0, 3.1),)
    )
    return World(scene), MotionGoal("navigate", "p0", DockingPose(0.8, 0.0), speed_m_s=0.7)


@settings(max_examples=20, deadline=None)
@given(
    drive=st.sampled_from(("omnidirectional", "differential")),
    ticks=st.integers(0, 80),
    every=st.integers(1, 5),
)
def test_a_goal_holds_while_it_is_renewed_and_no_longer(drive: str, ticks: int, every: int) -> None:
    """However often within the lease; and what has run out is not revived."""
    world, goal = hall(drive)
    robot = world.robot
    given_id = robot.go(goal)
    for tick in range(ticks):
        if tick % every == 0:
            robot.renew(given_id)
        world.step()
        assert robot.motion().state == "running"
    world.run(LEASE_S + 0.1)
    assert robot.motion().state == "aborted"
    world.run(BRAKING_S)
    at = robot.pose
    assert robot.motion().is_at_rest
    robot.renew(given_id)
    world.run(1.0)
    assert (robot.pose, robot.motion().state) == (at, "aborted")
    robot.go(goal)
    world.run(LEASE_S)
    assert robot.motion().state == "running"


@pytest.mark.parametrize("drive", ["omnidirectional", "differential"])
def test_a_goal_given_by_hand_holds_until_the_next_one(drive: str) -> None:
    world, goal = hall(drive)
    world.robot.navigate(goal.to, goal.pose, speed_m_s=goal.speed_m_s)
    world.run(10.0)
    assert world.robot.motion().state == "running"
