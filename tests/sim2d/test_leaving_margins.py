"""A robot that is too near to somebody who stands goes straight out before it follows its route."""

import math

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from comity_sim2d import DockingPose, Person, RobotBody, Room, Scene, Sensor, Wall, World
from comity_sim2d.base.drive import REDUCED_M_S
from comity_sim2d.navigation.route_map import RouteMap

DRIVES = st.sampled_from(["omnidirectional", "differential"])
BEN = (4.0, 3.0)
BODIES_M = 0.45
"""Both radii."""
MARGIN_M = 0.30


def beside_ben(drive: str, gap_m: float, bearing: float, heading: float = 0.0, **others: object) -> World:
    """The robot stands beside ben, and is to go to ada."""
    apart_m = BODIES_M + gap_m
    at = (BEN[0] + apart_m * math.cos(bearing), BEN[1] + apart_m * math.sin(bearing))
    robot = RobotBody(*at, heading, drive=drive, **others)
    here = World(
        Scene(Room.rectangle(8.0, 6.0), robot, (Person("ada", 7.2, 3.0, math.pi), Person("ben", *BEN, 0.0)))
    )
    here.robot.dock("ada", DockingPose(0.8, 0.0), speed_m_s=0.5)
    return here


def polar(here: World) -> tuple[float, float]:
    """The gap to ben [m] and the robot's bearing from him [rad]."""
    dx, dy = (mine - his for mine, his in zip(here.robot.pose.xy, BEN, strict=True))
    return math.hypot(dx, dy) - BODIES_M, math.atan2(dy, dx)


def step_m_s(here: World) -> float:
    """Advance by one step; returns the robot's mean speed in it [m/s]."""
    before, since_s = here.robot.pose.xy, here.time_s
    here.step()
    return math.dist(before, here.robot.pose.xy) / (here.time_s - since_s)


@given(DRIVES, st.floats(0.02, 0.27), st.floats(-math.pi, math.pi), st.floats(-math.pi, math.pi))
@example("differential", 0.1, math.pi, 0.0)
@example("differential", 0.02, math.pi, math.pi / 2)
def test_it_goes_straight_out_of_a_margin_and_slowly(drive, gap_m, bearing, heading) -> None:
    """The gap never shrinks, and the robot does not go round the person, however it stands."""
    here = beside_ben(drive, gap_m, bearing, heading)
    before_m = gap_m
    while before_m < MARGIN_M - 0.01:
        assert step_m_s(here) <= REDUCED_M_S + 1e-6
        now_m, at = polar(here)
        assert now_m >= before_m - 1e-6
        assert abs(math.remainder(at - bearing, math.tau)) <= math.radians(3.0)
        assert here.time_s < 5.0
        before_m = now_m


@given(DRIVES, st.floats(0.02, 0.27), st.floats(-math.pi, math.pi))
@example("differential", 0.26953125, 2.0)
def test_then_it_keeps_the_margin_and_docks(drive, gap_m, bearing) -> None:
    here = beside_ben(drive, gap_m, bearing)
    has_left = False
    while here.robot.motion().state != "succeeded":
        here.step()
        has_left = has_left or polar(here)[0] >= MARGIN_M - 0.01
        assert not has_left or polar(here)[0] >= MARGIN_M - 0.03  # bends are cut by 2 cm
        assert here.time_s < 40.0


@given(st.floats(0.02, 0.4), st.floats(-0.6, 0.6), st.floats(0.7, 0.845) | st.floats(0.855, 0.95))
def test_a_start_inside_a_margin_opens_no_gap_that_is_too_narrow(gap_m, bearing, wide_m) -> None:
    """Ben leaves a gap beside him in the only door: the robot, 0.5 m wide, needs 0.30 m and 5 cm more."""
    at = (BEN[0] - (BODIES_M + gap_m) * math.cos(bearing), BEN[1] + (BODIES_M + gap_m) * math.sin(bearing))
    walls = (
        Wall((BEN[0], 0.0), (BEN[0], BEN[1] - 0.25)),
        Wall((BEN[0], BEN[1] + 0.25 + wide_m), (BEN[0], 6.0)),
    )
    scene = Scene(Room.rectangle(8.0, 6.0), RobotBody(*at), (Person("ben", *BEN, 0.0),), walls=walls)
    routes = RouteMap(scene)
    assert (routes.route((1.0, 3.0), (7.0, 3.0)) is not None) == (wide_m > 0.85)
    assert (routes.route(at, (7.0, 3.0)) is not None) == routes.reaches(at, (7.0, 3.0)) == (wide_m > 0.85)


@given(DRIVES, st.floats(-math.pi, math.pi))
def test_inside_by_no_more_than_a_bend_is_cut_it_follows_its_route(drive, bearing) -> None:
    here = beside_ben(drive, MARGIN_M - 0.019, bearing)
    here.step()
    assert not here.robot.motion().text.startswith("drawing back")


@pytest.mark.parametrize("drive", ["omnidirectional", "differential"])
def test_between_a_person_and_a_wall_it_goes_out_beside_both(drive: str) -> None:
    """Straight out is the wall: the way out leads along it."""
    robot = RobotBody(4.0 - BODIES_M - 0.2, 3.0, 0.0, drive=drive)
    wall = Wall((robot.x_m - 0.32, 1.0), (robot.x_m - 0.32, 5.0))
    people = (Person("ada", 7.2, 3.0, math.pi), Person("ben", *BEN, 0.0))
    here = World(Scene(Room.rectangle(8.0, 6.0), robot, people, walls=(wall,)))
    here.robot.dock("ada", DockingPose(0.8, 0.0), speed_m_s=0.5)
    while polar(here)[0] < MARGIN_M - 0.01:
        assert step_m_s(here) <= REDUCED_M_S + 1e-6
        assert polar(here)[0] >= 0.18
        assert here.time_s < 15.0
    assert here.robot_touches == ()


def test_somebody_who_comes_to_stand_beside_it_is_left_too() -> None:
    """Ben is put 0.1 m from the robot on its way, where its sensor is noisy."""
    here = beside_ben("differential", 2.0, math.pi, sensor=Sensor(0.03, 0.1))
    here.run(2.0)
    x, y = here.robot.pose.xy
    here.move_person("ben", x, y - BODIES_M - 0.1, 0.0)
    here.run(4.0)
    assert math.dist(here.robot.pose.xy, here.people[1].xy) - BODIES_M >= MARGIN_M - 0.03
