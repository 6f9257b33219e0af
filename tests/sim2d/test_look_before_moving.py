"""A robot that does not see all round touches nobody who stands where it does not look."""

import math
from typing import NamedTuple

import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st
from sampling import sampled

from comity_sim2d import DockingPose, Person, RobotBody, Room, Scene, SceneError, Sensor, World
from comity_sim2d.avoidance.look_before_moving import SHIFT_M
from comity_sim2d.base.drive import speed_within_sight
from comity_sim2d.pose import Pose
from comity_sim2d.senses.visibility_memory import CELL_M, VisibilityMemory

DRIVES = st.sampled_from(["omnidirectional", "differential"])
ROUND = st.floats(-math.pi, math.pi)
START = (4.0, 3.0)


def beside(bearing: float, apart_m: float) -> tuple[float, float]:
    return START[0] + apart_m * math.cos(bearing), START[1] + apart_m * math.sin(bearing)


SENSORS = st.builds(Sensor, field_of_view_deg=st.floats(20.0, 300.0), delay_s=st.sampled_from([0.0, 0.2]))
LEAST_M = CELL_M + SHIFT_M
"""The floor is known by cells, and so far it goes without looking: nearer, somebody may be touched."""


class Walk(NamedTuple):
    """Of somebody who is in view at first: at a share of the view to its left, so far from the robot."""

    from_share: float
    from_m: float
    to: float
    to_m: float
    speed_m_s: float


WALKS = st.builds(
    Walk, st.floats(-0.45, 0.45), st.floats(0.8, 2.2), ROUND, st.floats(0.7, 1.5), st.floats(0.3, 1.2)
)
STANDS = st.builds(lambda bearing, gap_m: beside(bearing, 0.45 + gap_m), ROUND, st.floats(LEAST_M, 1.0))


@sampled(20)
@given(DRIVES, SENSORS, ROUND, STANDS)
@example("omnidirectional", Sensor(field_of_view_deg=20.0), math.pi, beside(2.6, 0.59))
@example("differential", Sensor(field_of_view_deg=60.0), math.pi, beside(math.pi, 1.05))
def test_who_stands_beside_it_unseen_is_not_touched(
    drive: str, sensor: Sensor, ada: float, ben: tuple[float, float]
) -> None:
    """Ben came there while it looked elsewhere; ada is where it is to go."""
    robot = RobotBody(*START, 0.0, drive=drive, sensor=sensor)
    people = (Person("ada", *beside(ada, 2.4), 0.0), Person("ben", 0.4, 0.4, 0.0))
    here = World(Scene(Room.rectangle(8.0, 6.0), robot, people))
    here.move_person("ben", *ben, 0.0)
    here.robot.dock("ada", DockingPose(0.8, 0.0), speed_m_s=0.5)
    here.run(6.0)
    assert here.robot_touches == ()


@given(DRIVES, st.sampled_from([20.0, 60.0, 180.0]))
def test_it_backs_off_before_who_comes_only_where_it_has_looked(drive: str, view_deg: float) -> None:
    """Ada comes at it from ahead, and ben stands behind it, where it believes nobody."""
    robot = RobotBody(*START, 0.0, drive=drive, sensor=Sensor(field_of_view_deg=view_deg))
    people = (Person("ada", 7.0, 3.0, math.pi), Person("ben", 0.4, 0.4, 0.0))
    here = World(Scene(Room.rectangle(8.0, 6.0), robot, people))
    here.move_person("ben", START[0] - 0.9, START[1], 0.0)
    here.robot.dock("ada", DockingPose(1.0, 0.0), speed_m_s=0.5)
    for tick in range(200):
        here.move_person("ada", max(7.0 - 0.4 * tick / 20, here.robot.pose.x_m + 0.5), 3.0, math.pi)
        here.step()
        assert "ben" not in [touch.entity for touch in here.robot_touches]


@sampled(20)
@given(SENSORS, DRIVES, ROUND, WALKS)
@example(Sensor(field_of_view_deg=20.0), "differential", -2.354, Walk(0.308, 2.021, -1.599, 0.907, 0.329))
def test_who_walks_out_of_its_view_and_stops_is_not_touched(
    sensor: Sensor, drive: str, ada: float, walk: Walk
) -> None:
    """Ben goes straight on, not at the robot; ada is where it is to go."""
    start = beside(walk.from_share * math.radians(sensor.field_of_view_deg), walk.from_m)
    stop, hers = beside(walk.to, walk.to_m), beside(ada, 2.4)
    way_m = math.dist(start, stop)
    assume(math.dist(hers, start) > 0.6 and math.dist(hers, stop) > 1.4 and way_m > 0.1)
    robot = RobotBody(*START, 0.0, drive=drive, sensor=sensor)
    people = (Person("ada", *hers, 0.0), Person("ben", *start, 0.0))
    here = World(Scene(Room.rectangle(8.0, 6.0), robot, people))
    here.robot.dock("ada", DockingPose(0.8, 0.0), speed_m_s=0.5)
    for tick in range(300):
        gone = min(1.0, tick / 20 * walk.speed_m_s / way_m)
        at = (start[0] + gone * (stop[0] - start[0]), start[1] + gone * (stop[1] - start[1]))
        assume(gone == 1.0 or math.dist(at, here.robot.pose.xy) > 0.7)
        here.move_person("ben", *at, 0.0)
        here.step()
        assert here.robot_touches == ()


def test_it_says_that_it_looks_first() -> None:
    """Ada is behind it, where it has not looked."""
    robot = RobotBody(*START, 0.0, sensor=Sensor(field_of_view_deg=60.0))
    here = World(Scene(Room.rectangle(8.0, 6.0), robot, (Person("ada", 1.0, 3.0, 0.0),)))
    here.robot.dock("ada", DockingPose(0.8, 0.0), speed_m_s=0.5)
    told = []
    while here.robot.motion().state != "succeeded":
        told.append(here.robot.motion().text)
        here.step()
    assert "looking at where it goes before it goes there" in told
    assert told[-1].endswith(" m of way left to ada")


@given(ROUND, st.floats(20.0, 359.0), ROUND, st.floats(0.2, 2.5))
def test_floor_is_seen_where_somebody_on_it_would_be(
    heading: float, view_deg: float, bearing: float, apart_m: float
) -> None:
    """But for places at the edge of the view, as a place has a size."""
    floor = VisibilityMemory(Sensor(field_of_view_deg=view_deg))
    floor.take_in(Pose(*START, heading), 1.0)
    place = beside(bearing, apart_m)
    unseen = floor.unseen(START, 0.5, 3.0)
    nearest_m = min(
        (math.dist((x + START[0], y + START[1]), place) for x, y in unseen.tolist()), default=math.inf
    )
    off = abs(math.remainder(bearing - heading, math.tau)) - math.radians(view_deg) / 2
    edge_rad = math.asin(min(1.0, CELL_M / apart_m))
    assert off > -edge_rad or nearest_m > CELL_M / 2
    assert off < edge_rad or nearest_m < CELL_M


@given(st.floats(0.0, 5.0), st.floats(0.05, 3.0), st.floats(0.1, 2.0))
def test_within_sight_it_stops_before_who_comes_into_view(
    clear_m: float, blind_s: float, braking: float
) -> None:
    speed = speed_within_sight(clear_m, blind_s=blind_s, braking=braking)
    assert speed * blind_s + speed**2 / (2.0 * braking) == pytest.approx(clear_m, abs=1e-6)


@pytest.mark.parametrize("delay_s", [0.0, 1.0])
@pytest.mark.parametrize("drive", ["omnidirectional", "differential"])
def test_it_is_no_faster_than_it_can_stop_within_what_it_sees(drive: str, delay_s: float) -> None:
    """Nobody is expected on its way, and ben stands there."""
    sensor = Sensor(range_m=0.9, delay_s=delay_s)
    robot = RobotBody(1.0, 3.0, 0.0, drive=drive, max_speed_m_s=1.5, max_acceleration_m_s2=0.2, sensor=sensor)
    people = (Person("ada", 7.0, 3.0, math.pi), Person("ben", 0.4, 0.4, 0.0))
    here = World(Scene(Room.rectangle(8.0, 6.0), robot, people))
    here.move_person("ben", 5.0, 3.0, 0.0)
    here.robot.dock("ada", DockingPose(0.8, 0.0), speed_m_s=1.5)
    here.run(25.0)
    assert here.robot_touches == ()


def test_a_range_within_its_own_body_is_refused() -> None:
    with pytest.raises(SceneError, match=r"expected at least 0\.75 m"):
        RobotBody(1.0, 1.0, sensor=Sensor(range_m=0.5))
    RobotBody(1.0, 1.0, sensor=Sensor(range_m=0.75))
