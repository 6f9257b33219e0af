"""Who comes at the robot finds it beside their way, or gone back; where there is no room, it stands."""

import math

import pytest
from docking_study import CASES, visit
from hypothesis import example, given, settings
from hypothesis import strategies as st

from comity_fis.proxemics import PERSON_MARGIN_M
from comity_sim2d import Person, RobotBody, Room, Scene, Sensor, Walk, Wall, World

GAP_M = 0.45
"""Both radii."""


def meeting(speed_m_s: float, *walls: Wall, sensor: Sensor | None = None, drive: str = "omnidirectional"):
    """The gaps while ada walks at the robot for 2 m, and the world."""
    robot = RobotBody(4.0, 2.0, 0.0, sensor=sensor or Sensor(), drive=drive)
    world = World(Scene(Room.rectangle(8.0, 4.0), robot, (Person("ada", 5.5, 2.0, math.pi),), walls))
    gaps = []
    for _ in range(round(2.0 / speed_m_s * 20)):
        ada = world.people[0]
        world.move_person("ada", ada.x_m - speed_m_s / 20, ada.y_m, ada.heading_rad)
        world.step()
        gaps.append(math.dist(world.robot.pose.xy, world.people[0].xy) - GAP_M)
    return gaps, world


@pytest.mark.parametrize("drive", ["omnidirectional", "differential"])
@pytest.mark.parametrize("speed_m_s", [0.2, 0.4])
@pytest.mark.parametrize("sensor", [Sensor(), Sensor(0.03, 0.1)])
def test_it_steps_aside_for_whoever_comes_slowly(speed_m_s: float, sensor: Sensor, drive: str) -> None:
    gaps, world = meeting(speed_m_s, sensor=sensor, drive=drive)
    assert min(gaps) > 0.1
    assert abs(world.robot.pose.y_m - 2.0) > GAP_M
    assert world.robot_touches == ()


@pytest.mark.parametrize("sensor", [Sensor(), Sensor(0.03, 0.1)])
def test_between_walls_it_goes_back_before_whoever_comes_slowly(sensor: Sensor) -> None:
    walls = [Wall((0.0, 2.0 + side), (8.0, 2.0 + side)) for side in (-0.5, 0.5)]
    gaps, world = meeting(0.4, *walls, sensor=sensor)
    assert min(gaps) > 0.1
    assert world.robot.pose.x_m < 3.7
    assert world.robot_touches == ()


def test_with_its_back_to_a_wall_it_steps_along_it() -> None:
    gaps, world = meeting(0.4, Wall((3.6, 0.0), (3.6, 4.0)))
    assert min(gaps) > 0.1
    assert world.robot_touches == ()


def test_in_a_blind_alley_it_stands() -> None:
    sides = [Wall((3.6, 2.0 + side), (8.0, 2.0 + side)) for side in (-0.5, 0.5)]
    gaps, world = meeting(0.4, Wall((3.6, 1.5), (3.6, 2.5)), *sides)
    touched = next(i for i, gap in enumerate(gaps) if gap <= 0.0)
    assert touched > 20  # until then nothing was touched, the wall neither
    assert world.robot_touches[0].entity == "ada"


def test_who_is_too_fast_to_get_away_from_finds_it_at_rest() -> None:
    _, world = meeting(1.0)
    assert world.robot_touches[0].entity == "ada"
    assert world.robot_touches[0].t > 0.9  # ada has come all the way


def test_with_the_emergency_stop_pressed_it_stands_whoever_comes() -> None:
    robot = RobotBody(4.0, 2.0, 0.0)
    world = World(Scene(Room.rectangle(8.0, 4.0), robot, (Person("ada", 5.0, 2.0, math.pi),)))
    world.robot.emergency_stop.press("the button")
    for _ in range(20):
        ada = world.people[0]
        world.move_person("ada", ada.x_m - 0.02, ada.y_m, ada.heading_rad)
        world.step()
    assert world.robot.pose.x_m == pytest.approx(4.0, abs=1e-9)


@pytest.mark.parametrize("faces_her_then", [False, True])
def test_told_to_rest_it_stands_until_its_next_goal_whoever_comes(faces_her_then: bool) -> None:
    """It stepped aside, and a run that had ended waited in vain for the base to come to rest."""
    world = World(Scene(Room.rectangle(8.0, 4.0), RobotBody(4.0, 2.0), (Person("ada", 5.5, 2.0, math.pi),)))
    world.robot.stop()
    if faces_her_then:
        world.robot.face("ada")
    for _ in range(50):
        ada = world.people[0]
        world.move_person("ada", ada.x_m - 0.02, ada.y_m, ada.heading_rad)
        world.step()
    assert (world.robot.pose.xy == (4.0, 2.0)) != faces_her_then


@given(
    st.floats(1.3, 1.7),
    st.floats(3.0, 3.5),
    st.floats(0.2, 1.2),
    st.sampled_from(["omnidirectional", "differential"]),
    st.sampled_from(["regular", "impassive"]),
)
@example(1.66, 3.45, 0.68, "omnidirectional", "regular")
@example(1.35, 3.48, 0.85, "differential", "impassive")
@settings(max_examples=20)
def test_giving_way_it_keeps_the_margin_of_somebody_who_stands(wide_m, x_m, speed_m_s, drive, reacts):
    """In a corridor ada walks up behind it, and ben stands where it gives way: down to 0.16 m before."""
    ben = Person("ben", 4.0, 0.26, math.pi)
    walk = Walk(((7.5, wide_m / 2),), speed_m_s=speed_m_s)
    ada = Person("ada", 1.0, wide_m / 2, 0.0, walk=walk, reacts=reacts)
    world = World(Scene(Room.rectangle(8.0, wide_m), RobotBody(x_m, wide_m / 2, drive=drive), (ben, ada)), 21)
    nearest_m = min(PERSON_MARGIN_M, ben.gap_m(world.robot.pose.xy, 0.25))
    while world.time_s < 25.0:
        world.step()
        assert ben.gap_m(world.robot.pose.xy, 0.25) > nearest_m - 0.03  # it cuts bends by 2 cm


@pytest.mark.parametrize("seed", [430, 570, 685])
def test_it_gets_round_a_person_who_walks_backwards_into_it(seed: int) -> None:
    """It sank into their margin, left it straight backwards, and began again, for more than 30 s."""
    assert visit(CASES["drifting"], seed).arrived
