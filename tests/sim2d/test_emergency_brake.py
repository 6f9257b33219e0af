"""The emergency stop brakes as hard as the body may, whatever its jerk limit, and holds it at rest."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from comity_sim2d import DockingPose, Person, RobotBody, Room, Scene, SceneError, World

STEP_S = 0.05


def under_way(for_s: float, **body: object) -> World:
    """On the way through a hall, which bends round a bystander."""
    people = (Person("p0", 10.0, 3.0, 3.1), Person("bo", 5.0, 3.1, 0.0))
    world = World(Scene(Room.rectangle(12.0, 6.0), RobotBody(1.0, 3.0, **body), people))
    world.robot.navigate("p0", DockingPose(0.8, 0.0), speed_m_s=0.7)
    world.run(for_s)
    return world


def moved_m(world: World, ticks: int) -> np.ndarray:
    """The way in each of the last ticks."""
    poses = world.frames.poses[-ticks - 1 :, 0, :2]
    return np.hypot(*np.diff(poses, axis=0).T)


@given(
    st.sampled_from(["omnidirectional", "differential"]),
    st.floats(0.1, 8.0),
    st.floats(0.5, 100.0),
    st.sampled_from([0.6, 2.0, 5.0]),
)
@settings(max_examples=20, deadline=None)
def test_a_pressed_stop_brakes_at_the_stated_deceleration_and_holds_the_robot_at_rest(
    drive: str, for_s: float, jerk: float, hardest: float
) -> None:
    world = under_way(for_s, drive=drive, max_jerk_m_s3=jerk, emergency_deceleration_m_s2=hardest)
    speed = float(moved_m(world, 1)[0]) / STEP_S
    world.robot.emergency_stop.press()
    world.run(2.0)
    way = moved_m(world, 40)
    # The bodies take a command up a tick later, in steps of their own.
    assert way.sum() <= speed**2 / (2 * hardest) + 1.1 * STEP_S * speed + 1e-6
    assert (-np.diff(way)).max() <= hardest * STEP_S**2 * 1.01 + 1e-9
    assert way[-1] < 1e-9
    still = world.robot.pose
    world.run(3.0)
    assert world.robot.pose == still


def test_from_full_speed_the_robot_stands_within_12_cm_and_goes_on_when_released() -> None:
    world = under_way(3.0)
    assert moved_m(world, 1)[0] / STEP_S == pytest.approx(0.7, abs=0.01)
    at = world.robot.pose.xy
    world.robot.emergency_stop.press()
    world.run(1.0)
    assert math.dist(at, world.robot.pose.xy) < 0.12
    world.robot.emergency_stop.release()
    world.robot.dock("p0", DockingPose(0.8, 0.0), speed_m_s=0.7)
    world.run(30.0)
    assert world.robot.motion().state == "succeeded"


def test_an_emergency_never_brakes_more_softly_than_usual() -> None:
    world = under_way(3.0, max_acceleration_m_s2=3.0, emergency_deceleration_m_s2=0.1)
    world.robot.emergency_stop.press()
    world.run(0.5)
    assert moved_m(world, 1)[0] < 1e-9


def test_a_brake_that_never_stops_anything_is_refused() -> None:
    with pytest.raises(SceneError, match="emergency_deceleration_m_s2"):
        RobotBody(1.0, 1.0, emergency_deceleration_m_s2=0.0)
