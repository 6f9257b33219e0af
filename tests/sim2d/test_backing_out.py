"""In a doorway or passage that somebody else wants through as well, the robot backs out, and lets them by."""

import itertools
import math

import pytest

from comity_sim2d import (
    DockingPose,
    PassersBy,
    Person,
    RobotBody,
    Room,
    Scene,
    Sensor,
    Walk,
    Wall,
    World,
)


def doorway(seed: int, drive: str, width_m: float) -> World:
    """The robot is to go through a door to ada; two passers-by walk to and fro through it."""
    walls = (Wall((4.0, 0.0), (4.0, 3.0 - width_m / 2)), Wall((4.0, 3.0 + width_m / 2), (4.0, 6.0)))
    robot, ada = RobotBody(2.5, 3.0, 0.0, drive=drive), Person("ada", 6.5, 1.0, math.pi)
    walkers = PassersBy(2, between=((1.5, 4.5), (6.5, 4.5)))
    here = World(Scene(Room.rectangle(8.0, 6.0), robot, (ada,), walls, passers_by=walkers), seed)
    here.robot.dock("ada", DockingPose(0.8, 0.0), speed_m_s=0.5)
    return here


@pytest.mark.parametrize("seed", [2, 6, 7])
@pytest.mark.parametrize("width_m", [0.7, 0.9])
@pytest.mark.parametrize("drive", ["omnidirectional", "differential"])
def test_nobody_waits_in_a_doorway_for_good(drive: str, width_m: float, seed: int) -> None:
    """At 0.7 m and 0.9 m the robot and a passer-by do not get by one another."""
    here = doorway(seed, drive, width_m)
    while here.robot.motion().state != "succeeded":
        here.step()
        assert here.time_s < 40.0
    assert here.robot.motion().text == "docked to ada"
    assert here.robot_touches == ()


@pytest.mark.parametrize("seed", [2, 6])
def test_it_goes_back_until_they_are_by(seed: int) -> None:
    """It gives up its way for them, and the door is free of it before it goes through."""
    here = doorway(seed, "omnidirectional", 0.7)
    here.run(30.0)
    rows = [row for row in here.frames.rows() if row[1] == "robot"]
    x_m = [row[2] for row in rows]
    through = next(k for k, x in enumerate(x_m) if x > 4.4)
    nearest = max(range(through // 2), key=lambda k: x_m[k])
    assert min(x_m[nearest:through]) < x_m[nearest] - 0.6


def test_it_says_that_it_backs_out_and_no_longer_than_it_does() -> None:
    here = doorway(6, "omnidirectional", 0.7)
    told = []
    while here.robot.motion().state != "succeeded":
        told.append(here.robot.motion().text)
        here.step()
    backs_out = [k for k, text in enumerate(told) if text == "backing out before passer-by 2"]
    assert backs_out
    assert len(backs_out) < len(told) / 2
    assert told[-1].endswith(" m of way left to ada")


def test_where_there_is_room_beside_it_the_robot_stays() -> None:
    """In a door of 2 m passers-by go round it."""
    here = doorway(6, "omnidirectional", 2.0)
    here.run(15.0)
    x_m = [row[2] for row in here.frames.rows() if row[1] == "robot"]
    assert all(after > before - 0.02 for before, after in itertools.pairwise(x_m) if after < 4.5)


PASSAGE = tuple(
    Wall(start, end)
    for start, end in [
        ((2.0, 1.55), (6.0, 1.55)),
        ((2.0, 2.45), (6.0, 2.45)),
        ((2.0, 0.0), (2.0, 1.55)),
        ((2.0, 2.45), (2.0, 4.0)),
        ((6.0, 0.0), (6.0, 1.55)),
        ((6.0, 2.45), (6.0, 4.0)),
    ]
)
"""0.9 m wide and 4 m long, from one room to another."""
REACHES_M = 0.45
"""Both radii."""


def passage(kim: Person, drive: str = "omnidirectional", sensor: Sensor | None = None) -> World:
    """The robot is to go through the passage to ada; kim goes through it, too."""
    robot = RobotBody(1.0, 2.0, 0.0, drive=drive, sensor=sensor or Sensor())
    here = World(Scene(Room.rectangle(8.0, 4.0), robot, (Person("ada", 7.2, 0.8, math.pi / 2), kim), PASSAGE))
    here.robot.dock("ada", DockingPose(0.6, 0.0), speed_m_s=0.5)
    return here


def gaps_m(here: World, other: str) -> list[float]:
    rows = list(here.frames.rows())
    places = [[row[2:4] for row in rows if row[1] == name] for name in ("robot", other)]
    return [math.dist(robot, kim) - REACHES_M for robot, kim in zip(*places, strict=True)]


@pytest.mark.parametrize("sensor", [Sensor(), Sensor(0.03, 0.1)])
@pytest.mark.parametrize("reacts", ["regular", "impassive"])
@pytest.mark.parametrize("drive", ["omnidirectional", "differential"])
def test_in_a_passage_it_lets_somebody_by_whom_it_knows(drive: str, reacts: str, sensor: Sensor) -> None:
    """At 0.9 m the two do not get by one another, and kim comes as slowly as 0.3 m/s."""
    walk = Walk(((0.8, 3.3),), speed_m_s=0.3)
    here = passage(Person("kim", 6.8, 2.0, math.pi, walk=walk, reacts=reacts), drive, sensor)
    told = set()
    while here.robot.motion().state != "succeeded":
        here.step()
        told.add(here.robot.motion().text)
        assert here.time_s < 70.0
    assert "backing out before kim" in told
    assert here.people[1].x_m < 2.0
    assert here.robot_touches == ()


@pytest.mark.parametrize("reacts", ["regular", "impassive"])
@pytest.mark.parametrize("drive", ["omnidirectional", "differential"])
def test_behind_somebody_slow_it_follows_and_does_not_push(drive: str, reacts: str) -> None:
    walk = Walk(((7.2, 3.4),), speed_m_s=0.3)
    here = passage(Person("kim", 2.6, 2.0, 0.0, walk=walk, reacts=reacts), drive)
    told = []
    while here.robot.motion().state != "succeeded":
        here.step()
        told.append(here.robot.motion().text)
        assert here.time_s < 40.0
    assert not any(text.startswith("backing out") for text in told)
    assert min(gaps_m(here, "kim")) > 0.25


def test_it_waits_beside_the_line_of_whoever_comes_out() -> None:
    walk = Walk(((0.8, 3.3),), speed_m_s=0.3)
    here = passage(Person("kim", 6.8, 2.0, math.pi, walk=walk))
    while here.robot.motion().text != "backing out before kim":
        here.step()
    while here.robot.motion().text == "backing out before kim":
        here.step()
    assert abs(here.robot.pose.y_m - 2.0) > REACHES_M
    assert here.people[1].x_m < 2.2


def test_whoever_turns_round_is_not_waited_for() -> None:
    """Kim has come to meet it halfway, and goes back as soon as it backs out."""
    walk = Walk(((4.4, 2.0), (7.2, 3.4)), speed_m_s=0.3, pauses_s=(10.0, 0.0))
    here = passage(Person("kim", 6.8, 2.0, math.pi, walk=walk, reacts="impassive"))
    while here.robot.motion().state != "succeeded":
        here.step()
        assert here.time_s < 70.0
    assert here.robot_touches == ()


def shut_room(seed: int) -> World:
    """Ada is in a room with a narrow door, through which two who mind nobody walk; bob is outside."""
    walls = (Wall((0.0, 1.8), (1.65, 1.8)), Wall((2.35, 1.8), (8.0, 1.8)))
    people = (Person("ada", 0.9, 3.4, -0.5), Person("bob", 6.5, 0.9, math.pi))
    walkers = PassersBy(2, between=((1.5, 4.5), (4.5, 0.9)), reacts="impassive")
    robot = RobotBody(0.8, 0.9, 0.0)
    return World(Scene(Room.rectangle(8.0, 5.5), robot, people, walls, passers_by=walkers), seed)


@pytest.mark.parametrize("seed", [1, 36])
def test_who_stands_beside_it_does_not_keep_it_from_letting_others_by(seed: int) -> None:
    """One wants in and one wants out: whichever is nearer, it goes back before the one whom it bars."""
    here = shut_room(seed)
    for person in ("ada", "bob"):
        since_s = here.time_s
        here.robot.dock(person, DockingPose(0.7, 0.0), speed_m_s=0.5)
        while here.robot.motion().state != "succeeded":
            here.step()
            assert here.time_s - since_s < 60.0
    assert here.robot_touches == ()
