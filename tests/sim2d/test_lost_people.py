"""An empty place in plain view is evidence; the edge of the view, the end of the range and walls are none."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_sim2d import DockingPose, Person, RobotBody, Room, Scene, Sensor, Wall, World
from comity_sim2d.pose import Pose
from comity_sim2d.scene.obstacles import FloorPlan
from comity_sim2d.senses import active_faults
from comity_sim2d.senses.sight import Sight

BEHIND = (0.6, 3.0)
DRIVES = st.sampled_from(["omnidirectional", "differential"])


def world(sensor: Sensor, drive: str = "omnidirectional", walls: tuple[Wall, ...] = ()) -> World:
    """The robot looks along x at ada, 2 m away."""
    robot = RobotBody(2.0, 3.0, 0.0, drive=drive, sensor=sensor)
    return World(Scene(Room.rectangle(8.0, 6.0), robot, (Person("ada", 4.0, 3.0, math.pi),), walls))


def put_away(here: World, xy: tuple[float, float] = BEHIND) -> World:
    """Have her seen, and then elsewhere at once."""
    here.run(0.5)
    here.move_person("ada", *xy, 0.0)
    return here


@pytest.mark.parametrize("delay_s", [0.0, 0.2])
def test_an_empty_place_is_believed_empty_after_several_looks(delay_s: float) -> None:
    here = put_away(world(Sensor(delay_s=delay_s, field_of_view_deg=60.0)))
    here.run(delay_s + 0.15)
    assert here.robot.missing == frozenset()
    here.run(0.15)
    assert here.robot.missing == {"ada"}


def test_who_is_seen_again_is_lost_no_more() -> None:
    here = put_away(world(Sensor(field_of_view_deg=60.0)))
    here.run(1.0)
    here.move_person("ada", 4.0, 3.5, 0.0)
    here.run(0.1)
    assert here.robot.missing == frozenset()
    assert here.robot.people[0].y_m == pytest.approx(3.5)


def test_a_robot_without_sight_learns_nothing_from_seeing_nobody() -> None:
    here = put_away(world(Sensor(field_of_view_deg=60.0)))
    here.faults.begin(active_faults.SENSORS, "dark")
    here.run(2.0)
    assert here.robot.missing == frozenset()


@pytest.mark.parametrize(
    ("sensor", "walls"),
    [
        (Sensor(range_m=1.85, field_of_view_deg=60.0), ()),
        (Sensor(sigma_m=0.1, range_m=2.0, field_of_view_deg=60.0), ()),
        (Sensor(field_of_view_deg=60.0, hidden_by_walls=True), (Wall((3.0, 3.0), (3.0, 4.0)),)),
    ],
)
def test_the_end_of_the_range_and_half_a_wall_are_no_evidence(
    sensor: Sensor, walls: tuple[Wall, ...]
) -> None:
    here = put_away(world(sensor, walls=walls))
    here.run(2.0)
    assert here.robot.missing == frozenset()


PLACES = st.tuples(st.floats(0.0, 10.0), st.floats(0.0, 10.0))
WALLS = st.tuples(PLACES, PLACES).filter(lambda ends: ends[0] != ends[1]).map(lambda ends: Wall(*ends))
SENSORS = st.builds(
    Sensor,
    range_m=st.floats(0.3, 12.0),
    field_of_view_deg=st.floats(5.0, 360.0),
    hidden_by_walls=st.booleans(),
)


@given(SENSORS, st.floats(-math.pi, math.pi), PLACES, WALLS)
def test_whoever_is_in_plain_view_is_seen(
    sensor: Sensor, heading: float, place: tuple[float, float], wall: Wall
) -> None:
    sight = Sight(sensor, FloorPlan(Room.rectangle(10.0, 10.0), (wall,), ()))
    robot, person = Pose(5.0, 5.0, heading), Person("ada", *place, 0.0)
    assert sight.sees(robot, [person]) == [True] or not sight.is_plain(robot, person, 0.0)


@given(drive=DRIVES, view_deg=st.floats(5.0, 350.0), bearing=st.floats(-math.pi, math.pi))
def test_one_turn_finds_whoever_is_in_range(drive: str, view_deg: float, bearing: float) -> None:
    """However narrow the view, the turn leaves out nobody, and the robot stays on its place meanwhile."""
    here = world(Sensor(field_of_view_deg=view_deg), drive)
    put_away(here, (2.0 + 1.6 * math.cos(bearing), 3.0 + 1.6 * math.sin(bearing)))
    here.robot.face("ada")
    for _ in range(800):
        here.step()
        if here.robot.motion().state == "succeeded":
            break
    assert here.robot.missing == frozenset()
    assert here.robot.motion()[:3] == ("succeeded", "facing ada", ())
    assert math.dist(here.robot.pose.xy, (2.0, 3.0)) < 0.01


@given(DRIVES)
def test_who_is_nowhere_is_looked_for_once_and_told_as_lost(drive: str) -> None:
    here = put_away(world(Sensor(field_of_view_deg=90.0, range_m=2.5), drive), (7.5, 5.5))
    here.robot.dock("ada", DockingPose(1.0, 0.0), speed_m_s=0.5)
    turned, heading, words = 0.0, here.robot.pose.heading_rad, set()
    for _ in range(400):
        here.step()
        turned += abs(math.remainder(here.robot.pose.heading_rad - heading, math.tau))
        heading = here.robot.pose.heading_rad
        words.add(here.robot.motion().text)
        if here.robot.motion().is_blocked:
            break
    assert here.robot.motion().text == "ada was lost from sight at t=0.50 s, and not found by looking round"
    assert here.robot.lost() == {"ada": here.robot.motion().text}
    assert math.tau <= turned < 1.2 * math.tau
    assert "docked to ada" not in words
