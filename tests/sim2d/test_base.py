"""Bases: limits of speed, acceleration and jerk; two wheels cannot shift sideways; no spinning; bumps."""

import math

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from comity_executor.robots.rest import Rest
from comity_sim2d import DockingPose, Person, RobotBody, Room, Scene, SceneError, World, docked
from comity_sim2d.base.base import VelocityCommand
from comity_sim2d.base.differential import Differential
from comity_sim2d.base.omnidirectional import Omnidirectional
from comity_sim2d.base.smoothing import Smoothing, acceleration_within, window_ticks
from comity_sim2d.pose import Pose, Twist, wrap_angle

COMMANDS = st.lists(st.floats(-1.0, 1.0), min_size=1, max_size=40)
STARTS = (st.floats(1.0, 11.0), st.floats(1.0, 11.0), st.floats(-math.pi, math.pi))
LIMITS = st.tuples(st.floats(0.1, 25.0), st.floats(0.1, 1.0))
"""Of jerk [m/s^3] and of acceleration [m/s^2]."""
FEW = settings(max_examples=12, deadline=None)
DT_S = 0.05


@given(COMMANDS, st.integers(1, 8))
def test_what_was_commanded_is_driven_to_the_end_and_no_farther(speeds: list[float], ticks: int) -> None:
    base = Smoothing(ticks)
    driven = sum(base.take(Twist(speed)).x_m_s for speed in speeds)
    assert driven + sum(twist.x_m_s for twist in base.to_come()) == pytest.approx(sum(speeds))
    assert base.sum_to_come().x_m_s == pytest.approx(sum(twist.x_m_s for twist in base.to_come()))


@given(st.floats(0.1, 2.0), st.floats(1.0, 50.0))
def test_the_window_keeps_the_jerk_at_the_worst_change_of_acceleration(a: float, jerk: float) -> None:
    dt = 0.05
    base = Smoothing(window_ticks(a, jerk, dt))
    speeds = [a * dt * k for k in range(20)] + [a * dt * k for k in range(20, -1, -1)] + [0.0] * 20
    done = np.array([0.0, 0.0, *(base.take(Twist(speed)).x_m_s for speed in speeds)])
    assert np.abs(np.diff(done, 2)).max() / dt**2 <= jerk * (1 + 1e-9)


@given(st.floats(0.1, 1.5), st.floats(0.1, 5.0), st.floats(0.2, 2.0), st.floats(0.005, 0.05))
def test_a_base_that_takes_up_commands_slowly_cuts_its_bends_by_little(
    acceleration: float, jerk: float, radius_m: float, cut_m: float
) -> None:
    body = RobotBody(0.0, 0.0, max_acceleration_m_s2=acceleration, max_jerk_m_s3=jerk)
    control = Omnidirectional(body, DT_S)
    cutting = control.base(Pose(0.0, 0.0, 0.0)).cutting_m_s2(cut_m)
    smoothing = Smoothing(window_ticks(acceleration_within(acceleration, jerk), jerk, DT_S))
    speed = min(0.7, math.sqrt(cutting * radius_m))
    angle = np.arange(200) * speed * DT_S / radius_m
    steps = np.diff(radius_m * np.column_stack([np.cos(angle), np.sin(angle)]), axis=0)
    done = [smoothing.take(Twist(x / DT_S, y / DT_S)).xy for x, y in steps.tolist()]
    way = np.array([radius_m, 0.0]) + DT_S * np.cumsum(done, axis=0)
    assert (radius_m - np.hypot(*way[smoothing.ticks :].T)).max() <= cut_m + 0.001


def visit(drive: str, x: float, y: float, heading: float, **limits: float) -> World:
    """Dock to somebody in the middle of a hall."""
    person = Person("p0", 6.0, 6.0, 0.5)
    if math.dist((x, y), person.xy) < 0.8:
        x += 2.0
    world = World(
        Scene(Room.rectangle(12.0, 12.0), RobotBody(x, y, heading, drive=drive, **limits), (person,))
    )
    world.robot.dock("p0", DockingPose(0.8, 0.0), speed_m_s=0.7)
    while world.robot.motion().state != "succeeded":
        assert world.time_s < 60.0, world.robot.motion()
        world.step()
    return world


@given(st.sampled_from(["omnidirectional", "differential"]), *STARTS, st.sampled_from([3.0, 8.0, 20.0]))
@FEW
def test_a_base_docks_within_its_limits(drive: str, x: float, y: float, heading: float, jerk: float) -> None:
    world = visit(drive, x, y, heading, max_jerk_m_s3=jerk)
    poses = world.frames.poses[:, 0]
    velocity = np.diff(poses[:, :2], axis=0) * 20.0
    assert np.hypot(*velocity.T).max() <= 0.7 + 1e-6
    assert np.hypot(*np.diff(velocity, axis=0).T).max() * 20.0 <= 0.5 * 1.02
    turning = np.diff(np.unwrap(poses[:, 2])) * 20.0
    forwards = velocity @ [1.0, 0.0] * np.cos(poses[:-1, 2]) + velocity @ [0.0, 1.0] * np.sin(poses[:-1, 2])
    speeds = np.hypot(*velocity.T) if drive == "omnidirectional" else forwards
    assert np.abs(turning).max() <= 1.5 + 1e-6
    assert np.abs(np.diff(speeds, 2)).max() * 400.0 <= 2.2 * max(jerk, 6.0)  # both axes, and the bends
    assert docked(world.robot.pose, 0.25, world.people[0]).distance_m == pytest.approx(0.8, abs=0.01)


@given(
    st.sampled_from(["omnidirectional", "differential"]),
    st.tuples(*STARTS),
    st.tuples(st.floats(0.1, 25.0), st.floats(0.1, 3.0)),
    st.floats(0.3, 8.0),
)
@example("differential", (1.0, 1.0, -2.0), (0.3, 1.5), 4.0)
@example("omnidirectional", (1.0, 1.0, 0.0), (1.5, 1.5), 3.0)
@FEW
def test_a_base_that_is_told_to_stop_is_at_rest_within_twice_the_time_that_it_states(
    drive: str, start: tuple[float, float, float], limits: tuple[float, float], told_s: float
) -> None:
    """With little jerk commands take hold up to 2 s later."""
    jerk, acceleration = limits
    body = RobotBody(*start, drive=drive, max_jerk_m_s3=jerk, max_acceleration_m_s2=acceleration)
    assume(math.dist(start[:2], (6.0, 6.0)) > 2.0)
    world = World(Scene(Room.rectangle(12.0, 12.0), body, (Person("ada", 6.0, 6.0, 0.5),)))
    world.robot.dock("ada", DockingPose(0.8, 0.0), speed_m_s=0.8)
    world.run(told_s)
    world.robot.stop()
    patience_s = Rest(world.robot, 0.8).patience_s
    world.run(patience_s - 2 * DT_S)
    assert world.robot.motion().is_at_rest


@given(st.sampled_from(["omnidirectional", "differential"]), *STARTS, LIMITS)
@example("differential", 9.3, 5.5, 2.2, (0.2, 0.5))
@example("differential", 6.9, 5.9, 2.6, (0.5, 1.0))
@example("omnidirectional", 7.0, 11.0, 0.0, (1.0, 0.1))
@FEW
def test_a_base_keeps_its_jerk_on_the_way_and_in_its_bends(
    drive: str, x: float, y: float, heading: float, limits: tuple[float, float]
) -> None:
    """The change of the acceleration as a vector, from the frames, as the figures of a run have it.

    It is sent elsewhere while it drives, and both whom it is sent to look its way: nothing brakes it hard.
    """
    jerk, acceleration = limits
    body = RobotBody(x, y, heading, drive=drive, max_jerk_m_s3=jerk, max_acceleration_m_s2=acceleration)
    ada, ben = Person("ada", 10.0, 10.0, math.atan2(y - 10.0, x - 10.0)), Person("ben", 10.0, 2.0, math.pi)
    assume(min(math.dist((x, y), person.xy) for person in (ada, ben)) > 3.0)
    world = World(Scene(Room.rectangle(12.0, 12.0), body, (ada, ben)))
    for person, for_s in (("ada", 8.0), ("ben", 25.0)):
        world.robot.dock(person, DockingPose(0.8, 0.0), speed_m_s=0.7)
        world.run(for_s)
    reached = np.diff(world.frames.poses[:, 0, :2], n=3, axis=0) * 20.0**3
    assert np.hypot(*reached.T).max() <= jerk * (1 + 1e-6)


@pytest.mark.parametrize("drive", ["omnidirectional", "differential"])
@pytest.mark.parametrize("jerk", [0.1, 0.2, 0.45])
@pytest.mark.parametrize(("x", "y", "heading"), [(1.0, 5.0, 2.0), (10.0, 8.0, -1.0)])
def test_a_base_of_the_smallest_jerk_docks_too(
    drive: str, x: float, y: float, heading: float, jerk: float
) -> None:
    """It takes seconds to build its acceleration up, so that it makes use of less."""
    world = visit(drive, x, y, heading, max_jerk_m_s3=jerk)
    assert docked(world.robot.pose, 0.25, world.people[0]).distance_m == pytest.approx(0.8, abs=0.02)


@given(*STARTS)
@FEW
def test_two_wheels_never_shift_sideways(x: float, y: float, heading: float) -> None:
    poses = visit("differential", x, y, heading).frames.poses[:, 0]
    middle = (np.unwrap(poses[:, 2])[1:] + np.unwrap(poses[:, 2])[:-1]) / 2
    moved = np.diff(poses[:, :2], axis=0)
    sideways = np.abs(-np.sin(middle) * moved[:, 0] + np.cos(middle) * moved[:, 1])
    assert sideways.max() < 0.001


@given(
    st.lists(
        st.tuples(st.floats(-math.pi, math.pi), st.sampled_from([0.0, 0.1, 0.3, 0.7]), st.integers(1, 25)),
        min_size=2,
        max_size=20,
    ),
    st.sampled_from([0.3, 0.5, 1.0]),
    st.sampled_from([1.0, 3.0, 8.0, 20.0]),
)
@example([(0.0, 0.7, 25), (0.6, 0.7, 2), (0.6, 0.1, 20)], 0.5, 20.0)  # it brakes while it turns
@settings(deadline=None)
def test_two_wheels_keep_their_acceleration_whatever_they_are_told(
    wishes: list[tuple[float, float, int]], acceleration: float, jerk: float
) -> None:
    """Each wish is a direction off the present one, a speed, and for how many ticks it lasts."""
    body = RobotBody(0.0, 0.0, 0.0, "differential", max_acceleration_m_s2=acceleration, max_jerk_m_s3=jerk)
    base, pose, velocities = Differential(body, DT_S), body.pose, [(0.0, 0.0)]
    for off, speed, ticks in wishes:
        way = pose.heading_rad + off
        wanted = VelocityCommand((speed * math.cos(way), speed * math.sin(way)), way)
        for _ in range(ticks):
            twist = base.command(base.base(pose), wanted, 0.7)
            velocities.append(twist.xy)
            x, y = pose.x_m + twist.x_m_s * DT_S, pose.y_m + twist.y_m_s * DT_S
            pose = Pose(x, y, wrap_angle(pose.heading_rad + twist.turn_rad_s * DT_S))
    change = np.hypot(*np.diff(velocities, axis=0).T)
    assert change.max() <= 1.01 * acceleration * DT_S


@pytest.mark.parametrize("drive", ["omnidirectional", "differential"])
@pytest.mark.parametrize("heading_deg", [180.0, 179.0, -175.0, 150.0])
def test_nobody_spins_when_the_goal_is_behind(drive: str, heading_deg: float) -> None:
    """It turns round once: at most half a turn there, and as much to look where it should."""
    world = visit(drive, 10.0, 8.1, math.radians(heading_deg) + math.atan2(-2.1, -4.0))
    turned = np.abs(np.diff(np.unwrap(world.frames.poses[:, 0, 2]))).sum()
    assert turned <= math.radians(180.0 + 60.0)


def test_a_bump_stops_the_robot_at_once_and_says_what_it_was() -> None:
    """Somebody steps into the robot at full speed; it stands from the next tick on, for a second."""
    world = World(
        Scene(
            Room.rectangle(12.0, 6.0),
            RobotBody(1.0, 3.0),
            (Person("p0", 9.0, 3.0, 3.1), Person("bo", 5.0, 5.0, 0.0)),
        )
    )
    world.robot.dock("p0", DockingPose(0.8, 0.0), speed_m_s=0.7)
    world.run(4.0)
    assert world.robot.emergency() is False
    x, y = world.robot.pose.xy
    world.move_person("bo", x + 0.44, y, 0.0)
    world.run(0.05)
    assert world.robot.emergency() == "bumped into bo"
    world.run(0.1)
    still = world.robot.pose.xy
    world.run(0.5)
    assert world.robot.pose.xy == pytest.approx(still, abs=0.005)
    assert world.robot.motion().is_blocked
    assert "bo" in world.robot.motion().text
    world.run(1.0)
    assert world.robot.emergency() is False


def test_a_drive_that_there_is_none_of_is_refused() -> None:
    with pytest.raises(SceneError, match="omnidirectional, differential"):
        RobotBody(1.0, 1.0, drive="differentail")
