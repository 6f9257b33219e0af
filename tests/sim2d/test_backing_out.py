"""In a doorway that a passer-by wants through as well, the robot backs out, lets them by, and goes on."""

import itertools
import math

import pytest

from comity_sim2d import DockingPose, PassersBy, Person, RobotBody, Room, Scene, Wall, World


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
    while here.robot.motion().state != "arrived":
        here.step()
        assert here.time_s < 30.0
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
    while here.robot.motion().state != "arrived":
        told.append(here.robot.motion().text)
        here.step()
    backs_out = [k for k, text in enumerate(told) if text == "backing out of a doorway for a passer-by"]
    assert backs_out
    assert len(backs_out) < len(told) / 2
    assert told[-1].endswith(" m to ada")


def test_where_there_is_room_beside_it_the_robot_stays() -> None:
    """In a door of 2 m passers-by go round it."""
    here = doorway(6, "omnidirectional", 2.0)
    here.run(15.0)
    x_m = [row[2] for row in here.frames.rows() if row[1] == "robot"]
    assert all(after > before - 0.02 for before, after in itertools.pairwise(x_m) if after < 4.5)
