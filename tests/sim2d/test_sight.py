"""What the sensors do not see is not read: too far away, behind the robot, behind a wall."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapely import LineString
from shapely.affinity import scale

from comity_sim2d import DockingPose, Person, RobotBody, Room, Scene, Sensor, Wall, World
from comity_sim2d.scene.obstacles import FloorPlan
from comity_sim2d.senses.sight import Sight


def world(sensor: Sensor, walls: tuple[Wall, ...] = (), heading: float = 0.0) -> World:
    people = (Person("ada", 4.0, 3.0, math.pi),)
    return World(Scene(Room.rectangle(8.0, 6.0), RobotBody(1.0, 3.0, heading, sensor=sensor), people, walls))


@pytest.mark.parametrize(
    ("sensor", "heading", "seen"),
    [
        (Sensor(range_m=2.9), 0.0, True),
        (Sensor(range_m=2.7), 0.0, False),
        (Sensor(field_of_view_deg=90.0), math.radians(44.0), True),
        (Sensor(field_of_view_deg=90.0), math.radians(46.0), False),
        (Sensor(field_of_view_deg=90.0), math.pi, False),
    ],
)
def test_range_and_field_of_view(sensor: Sensor, heading: float, seen: bool) -> None:
    """Ada's body begins 2.8 m away, straight ahead along x."""
    assert (world(sensor, heading=heading).robot.read("ada") is not None) == seen


def test_nobody_is_seen_through_a_wall_and_everybody_past_its_end() -> None:
    assert world(Sensor(hidden_by_walls=True), (Wall((2.5, 2.0), (2.5, 4.0)),)).robot.read("ada") is None
    assert world(Sensor(hidden_by_walls=True), (Wall((2.5, 3.2), (2.5, 4.0)),)).robot.read("ada") is not None


COORDINATES = st.floats(0.5, 7.5)
POINTS = st.tuples(COORDINATES, COORDINATES)


@given(POINTS, POINTS, POINTS, POINTS)
def test_a_wall_hides_whoever_a_straight_line_to_them_crosses_it(eye, person, start, end) -> None:
    ends = LineString([start, end])
    share = 0.05 / max(ends.length, 1e-9)  # its ends are round: half its thickness more
    wall = scale(ends, 1 + 2 * share, 1 + 2 * share)
    line = LineString([eye, person])
    if min(line.length, wall.length) < 0.6 or 0.0 < line.distance(wall) < 1e-6:
        return
    if min(line.boundary.distance(wall), wall.boundary.distance(line)) < 1e-6:
        return  # touching, which rounding decides
    plan = FloorPlan(Room.rectangle(8.0, 8.0), (Wall(start, end),), ())
    someone = Person("ada", *person, 0.0)
    assert Sight(Sensor(hidden_by_walls=True), plan).sees(RobotBody(*eye).pose, [someone]) == [
        not line.crosses(wall)
    ]


def test_who_is_out_of_sight_is_believed_where_they_were_seen_last() -> None:
    """The robot goes where Ada was, sees that she is elsewhere, and goes there."""
    here = world(Sensor(range_m=3.0))
    here.run(0.1)
    assert here.robot.read("ada") is not None
    here.move_person("ada", 5.0, 1.5, math.pi)
    here.run(0.1)
    assert here.robot.read("ada") is None
    here.robot.dock("ada", DockingPose(0.6, 0.0), speed_m_s=0.7)
    here.run(1.0)
    assert here.robot.pose.y_m == pytest.approx(3.0, abs=0.1)  # towards where she was
    for _ in range(600):
        here.step()
    reading = here.robot.read("ada")
    assert reading is not None
    assert reading.distance_m == pytest.approx(0.6, abs=0.01)
