"""What people do about a robot, as HuNavSim defines it, and only those of whom the scene says so."""

from __future__ import annotations

import math

import numpy as np
import pytest

from comity_sim2d import Person, RobotBody, Room, Scene, SceneError, Walk, Wall, World

ROOM = Room.rectangle(14.0, 6.0)


def met(reacts: str | None, *, at: float = 8.0, robot: RobotBody | None = None, **more) -> World:
    """Somebody who walks west along the middle, towards a robot that stands at x = 4."""
    walker = Person("p", at, 3.0, math.pi, reacts=reacts, walk=Walk(((1.0, 3.0),), speed_m_s=1.2))
    return World(Scene(ROOM, robot or RobotBody(4.0, 3.0, 0.0), (walker,), **more))


def path(world: World, seconds: float) -> np.ndarray:
    world.run(seconds)
    return world.frames.of("p")


def to_robot(poses: np.ndarray, at: tuple[float, float] = (4.0, 3.0)) -> np.ndarray:
    return np.hypot(poses[:, 0] - at[0], poses[:, 1] - at[1])


def off_deg(pose: np.ndarray) -> float:
    """Between where somebody faces and the robot at (4, 3)."""
    bearing = math.atan2(3.0 - pose[1], 4.0 - pose[0]) - pose[2]
    return abs(math.degrees(math.remainder(bearing, math.tau)))


@pytest.mark.parametrize("reacts", [None, "regular", "impassive"])
def test_who_takes_it_for_a_person_or_a_thing_walks_around_it_and_on(reacts):
    world = met(reacts)
    world.robot.emergency_stop.press("it does not step aside")
    poses = path(world, 10.0)
    assert poses[-1, 0] < 1.5
    assert to_robot(poses).min() > 0.45


def test_a_person_is_given_a_wider_berth_than_a_thing():
    """A thing pushes within tens of centimetres, a person from metres off."""
    regular, impassive = (path(met(reacts), 6.0) for reacts in ("regular", "impassive"))
    aside = [np.abs(poses[poses[:, 0] > 5.5, 1] - 3.0).max() for poses in (regular, impassive)]
    assert aside[0] > aside[1]


def test_the_surprised_stop_and_look_and_go_on_when_they_are_used_to_it():
    poses = path(met("surprised"), 50.0)
    stopped = poses[60:600]
    assert np.ptp(stopped[:, :2], axis=0).max() == 0.0
    assert to_robot(stopped)[0] == pytest.approx(4.0, abs=0.3)
    assert off_deg(stopped[-1]) < 5.0
    assert poses[-1, 0] < 3.0


def test_the_curious_come_up_slowly_and_stop_before_it():
    poses = path(met("curious", at=12.0), 30.0)
    assert to_robot(poses)[-1] == pytest.approx(1.5, abs=0.1)
    speed = np.hypot(*np.diff(poses[:, :2], axis=0).T) * 20
    assert speed[400] < speed[20] < 1.8
    assert off_deg(poses[-1]) < 5.0


def test_the_scared_keep_farther_off_than_others():
    scared, regular = (to_robot(path(met(reacts), 8.0)).min() for reacts in ("scared", "regular"))
    assert scared > regular + 0.3


def test_the_threatening_stand_in_its_way():
    """1.4 m before it, whichever way it faces."""
    poses = path(met("threatening", at=6.5, robot=RobotBody(4.0, 3.0, math.pi / 3)), 12.0)
    ahead = (4.0 + 1.4 * math.cos(math.pi / 3), 3.0 + 1.4 * math.sin(math.pi / 3))
    assert math.dist(poses[-1, :2], ahead) < 0.5


def test_a_robot_behind_a_wall_or_behind_the_back_is_not_reacted_to():
    hidden = met("surprised", walls=(Wall((5.5, 2.0), (5.5, 4.0)),))
    assert path(met("surprised"), 4.0)[-1, 0] > 7.5
    assert path(hidden, 4.0)[-1, 0] < 6.5
    away = Person("p", 5.0, 3.0, 0.0, reacts="surprised", walk=Walk(((12.0, 3.0),)))
    assert path(World(Scene(ROOM, RobotBody(4.0, 3.0), (away,))), 8.0)[-1, 0] > 11.0


def test_who_only_stands_goes_back_after_a_reaction():
    """Curious for 40 s, then back to where they stood."""
    stander = Person("p", 8.0, 3.0, math.pi, reacts="curious")
    poses = path(World(Scene(ROOM, RobotBody(4.0, 3.0), (stander,))), 60.0)
    assert to_robot(poses).min() < 1.7
    assert poses[-1, :2] == pytest.approx([8.0, 3.0], abs=0.5)


def test_who_stops_for_robots_stops_when_one_comes_up():
    walk = Walk(((1.0, 3.0),), speed_m_s=1.2, stops=True)
    scene = Scene(ROOM, RobotBody(4.0, 3.0, 0.0), (Person("p", 8.0, 3.0, math.pi, walk=walk),))
    poses = path(World(scene), 20.0)
    assert to_robot(poses)[-1] == pytest.approx(2.0, abs=0.2)
    assert np.ptp(poses[200:, :2], axis=0).max() == 0.0


def test_an_unknown_reaction_is_refused_with_the_nearest():
    with pytest.raises(SceneError, match="curious"):
        Person("p", 1, 1, 0, reacts="courious")  # type: ignore[arg-type]
