"""After a bump the robot knows whom it touched and where, and draws straight back from them."""

import math

from hypothesis import given
from hypothesis import strategies as st

from comity_sim2d import DockingPose, Person, RobotBody, Room, Scene, Sensor, World

DRIVES = st.sampled_from(["omnidirectional", "differential"])
START = (4.0, 3.0)


def bumped(drive: str, bearing: float, view_deg: float = 60.0) -> World:
    """Ben is suddenly at the robot's body, while it sets out to ada."""
    robot = RobotBody(*START, 0.0, drive=drive, sensor=Sensor(field_of_view_deg=view_deg))
    people = (Person("ada", 7.0, 3.0, math.pi), Person("ben", 4.0, 0.6, 0.0))
    here = World(Scene(Room.rectangle(8.0, 6.0), robot, people))
    here.robot.dock("ada", DockingPose(0.8, 0.0), speed_m_s=0.5)
    reach_m = robot.radius_m + people[1].radius_m - 0.002
    here.move_person("ben", 4.0 + reach_m * math.cos(bearing), 3.0 + reach_m * math.sin(bearing), 0.0)
    here.step()
    return here


def gap_m(here: World) -> float:
    return math.dist(here.robot.pose.xy, here.people[1].xy) - here.people[1].radius_m - 0.25


@given(DRIVES, st.floats(-math.pi, math.pi))
def test_who_was_touched_is_known_to_be_there(drive: str, bearing: float) -> None:
    """Out of view as well as ahead."""
    here = bumped(drive, bearing)
    assert [touch.entity for touch in here.robot_touches] == ["ben"]
    assert here.robot.people[1].xy == here.people[1].xy


@given(DRIVES, st.floats(-math.pi, math.pi))
def test_the_robot_draws_straight_back_from_whom_it_touched(drive: str, bearing: float) -> None:
    """It moves no step along their body, touches nobody again, and stops once it is off them."""
    here = bumped(drive, bearing)
    here.run(1.0)
    aside_m = 0.0
    for _ in range(120):
        here.step()
        to_m = (here.people[1].x_m - here.robot.pose.x_m, here.people[1].y_m - here.robot.pose.y_m)
        way = math.atan2(to_m[1], to_m[0]) - bearing
        aside_m = max(aside_m, abs(math.sin(way)) * math.hypot(*to_m))
    assert 0.15 <= gap_m(here) < 0.22  # and what it takes to brake
    assert aside_m < 0.02
    assert len(here.robot_touches) == 1


@given(DRIVES)
def test_it_does_not_draw_back_into_a_wall(drive: str) -> None:
    robot = RobotBody(0.26, 3.0, 0.0, drive=drive, sensor=Sensor(field_of_view_deg=60.0))
    here = World(Scene(Room.rectangle(8.0, 6.0), robot, (Person("ben", 4.0, 3.0, 0.0),)))
    here.move_person("ben", 0.26 + 0.25 + here.people[0].radius_m - 0.002, 3.0, 0.0)
    here.run(3.0)
    assert [touch.entity for touch in here.robot_touches] == ["ben"]
