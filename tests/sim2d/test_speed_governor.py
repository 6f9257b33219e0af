"""What gets in the robot's way at the last moment is not driven into, as far as its brakes allow."""

from __future__ import annotations

import math

from hypothesis import given, settings
from hypothesis import strategies as st

from comity_sim2d import DockingPose, Door, Person, RobotBody, Room, Scene, Wall, World
from comity_sim2d.scene.robot_body import Sensor

TOUCHING_M = 0.45
"""Between the centres of the robot and a person who touch."""


@given(
    st.sampled_from(["omnidirectional", "differential"]),
    st.floats(0.5, 6.0),
    st.floats(0.13, 0.6),
    st.floats(-0.3, 0.3),
)
@settings(max_examples=25, deadline=None)
def test_somebody_who_stops_right_before_the_robot_is_not_touched(
    drive: str, after_s: float, gap_m: float, aside: float
) -> None:
    """13 cm are enough to brake in from 0.5 m/s at 2 m/s^2, a tick late: 9 cm."""
    people = (Person("anna", 10.0, 3.0, math.pi), Person("omar", 1.0, 5.5, 0.0))
    world = World(Scene(Room.rectangle(12.0, 6.0), RobotBody(1.0, 3.0, drive=drive), people))
    world.robot.navigate("anna", DockingPose(0.8, 0.0), speed_m_s=0.5)
    world.run(after_s)
    robot, apart_m = world.robot.pose, 0.3 + 0.2 + gap_m
    bearing = robot.heading_rad + aside
    world.move_person(
        "omar", robot.x_m + apart_m * math.cos(bearing), robot.y_m + apart_m * math.sin(bearing), 0.0
    )
    world.run(4.0)
    assert not world.robot_touches


@given(
    st.sampled_from(["omnidirectional", "differential"]),
    st.floats(0.3, 0.7),
    st.floats(0.2, 1.2),
)
@settings(max_examples=25, deadline=None)
def test_a_door_that_falls_shut_right_before_the_robot_is_not_touched(
    drive: str, speed: float, left_m: float
) -> None:
    """20 cm are enough to brake in from 0.7 m/s at 2 m/s^2, a tick late: 16 cm."""
    hall, room = ((0.0, 0.0), (8.0, 0.0), (8.0, 5.0), (0.0, 5.0)), Door("door", (3.5, 2.5), (4.5, 2.5))
    walls = (Wall((0.0, 2.5), room.start), Wall(room.end, (8.0, 2.5)))
    body = RobotBody(4.0, 0.6, math.pi / 2, drive=drive)
    anna = Person("anna", 4.0, 4.5, -math.pi / 2)
    world = World(Scene(Room(hall), body, (anna,), walls=walls, doors=(room,)))
    world.robot.dock("anna", DockingPose(0.6, 0.0), speed_m_s=speed)
    while 2.5 - room.thickness_m / 2 - world.robot.pose.y_m - body.radius_m > left_m:
        world.step()
    world.set_door("door", open=False)
    world.run(4.0)
    assert not world.robot_touches
    assert world.robot.motion().is_blocked


def test_the_robot_brakes_hard_for_a_person_who_overtakes_it_at_5_cm_and_turns_in() -> None:
    """It takes up commands slowly, and sees people late and 5 cm off: its usual braking comes too late.

    Where such a person turns in more sharply than tracking follows, the robot may still touch them.
    """
    gap_m, pace_m_s, ahead_m, turn_deg, walks_s = 0.046, 0.939, 0.095, 75.5, 0.45
    body = RobotBody(
        3.0, 3.0, drive="differential", max_jerk_m_s3=1.0, sensor=Sensor(sigma_m=0.05, delay_s=0.2)
    )
    x_m, y_m, turned_s = 0.5, 3.0 + TOUCHING_M + gap_m, 0.0
    people = (Person("anna", 12.5, 3.0, math.pi), Person("omar", x_m, y_m, 0.0))
    world = World(Scene(Room.rectangle(14.0, 6.0), body, people), seed=0)
    world.robot.navigate("anna", DockingPose(0.8, 0.0), speed_m_s=0.5)
    while world.time_s < 10.0:
        if turned_s or x_m > world.robot.pose.x_m + ahead_m:
            turned_s += world.step_s
        course = -math.radians(min(turn_deg, 120.0 * turned_s))
        step_m = pace_m_s * world.step_s if turned_s < walks_s else 0.0
        x_m, y_m = x_m + step_m * math.cos(course), y_m + step_m * math.sin(course)
        world.move_person("omar", x_m, y_m, course)
        world.step()
        assert math.dist(world.robot.pose.xy, (x_m, y_m)) > TOUCHING_M
