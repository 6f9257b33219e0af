"""A robot that is told how far somebody wants it to pass keeps to that from then on."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from comity_sim2d import DockingPose, Person, RobotBody, Room, Scene, SceneError, Sensor, World

POSE = DockingPose(1.0, 0.0)


def scene(*, likes_m: float = 0.6, sigma_m: float = 0.0) -> Scene:
    """Bob beside the straight way to Anna, in a room that is wide on the other side."""
    people = (Person("anna", 12.0, 3.0, math.pi), Person("bob", 6.0, 2.0, 0.0, personal_distance_m=likes_m))
    return Scene(Room.rectangle(14.0, 9.0), RobotBody(1.0, 3.0, sensor=Sensor(sigma_m=sigma_m)), people)


def passes_at_m(world: World, *, told_m: float | None = None, at_s: float = 0.0) -> float:
    """How near the robot comes to Bob on its way to Anna, between the surfaces."""
    world.robot.navigate("anna", POSE, speed_m_s=0.7)
    nearest_m = math.inf
    while world.robot.motion().state != "succeeded":
        assert world.time_s < 60.0
        if told_m is not None and abs(world.time_s - at_s) < world.step_s / 2:
            world.robot.learn("bob", distance_m=told_m)
        world.step()
        nearest_m = min(nearest_m, math.dist(world.robot.pose.xy, (6.0, 2.0)) - 0.45)
    return nearest_m


@settings(max_examples=6, deadline=None)
@given(st.floats(1.0, 2.5), st.sampled_from([0.0, 1.0, 2.0]))
def test_whoever_asks_for_more_room_on_the_way_is_passed_at_that(told_m: float, at_s: float) -> None:
    assert passes_at_m(World(scene()), told_m=told_m, at_s=at_s) > told_m - 0.01


def test_whoever_asks_for_less_room_is_passed_as_if_they_had_liked_that_all_along() -> None:
    told = passes_at_m(World(scene(likes_m=2.5)), told_m=0.6, at_s=0.0)
    assert told == pytest.approx(passes_at_m(World(scene(likes_m=0.6))), abs=0.05)


def test_noise_and_a_later_look_do_not_make_the_robot_forget_it() -> None:
    assert passes_at_m(World(scene(sigma_m=0.03)), told_m=2.0, at_s=1.0) > 1.8


def test_being_told_what_it_knows_changes_nothing() -> None:
    told, untold = World(scene()), World(scene())
    assert passes_at_m(told, told_m=0.6, at_s=2.0) == passes_at_m(untold)
    assert (told.frames.poses == untold.frames.poses).all()


def test_a_distance_that_is_none_and_somebody_who_is_not_there_are_refused() -> None:
    robot = World(scene()).robot
    with pytest.raises(SceneError, match="personal_distance_m"):
        robot.learn("bob", distance_m=-1.0)
    with pytest.raises(ValueError, match="bob"):
        robot.learn("bbo", distance_m=1.0)
