"""Who is in the robot's way, in the world: around them where that is short, up to them where it is not."""

from __future__ import annotations

import math

import pytest

from comity_sim2d import DockingPose, Person, RobotBody, Room, Scene, Wall, World

WALL = (Wall((5.0, 0.0), (5.0, 2.2)), Wall((5.0, 3.8), (5.0, 6.0)))
"""With one gap, around y = 3."""
SECOND_GAP = (Wall((5.0, 1.2), (5.0, 2.2)), Wall((5.0, 3.8), (5.0, 6.0)))
POSE = DockingPose(0.8, 0.0)


@pytest.fixture
def world():
    """The robot and Johanna on both sides of walls, Marta between them."""

    def build(walls=(), marta=(5.0, 3.0)) -> World:
        people = (Person("johanna", 8.0, 3.0, math.pi), Person("marta", *marta, math.pi / 2))
        return World(Scene(Room.rectangle(10, 6), RobotBody(1.0, 3.0), people, walls=walls))

    return build


def motions(world: World, seconds: float = 12.0) -> list[str]:
    """The states that the motion goes through."""
    found = []
    for _ in range(round(seconds * 20)):
        world.step()
        motion = world.robot.motion()
        if not found or found[-1] != motion.state:
            found.append(motion.state)
    return found


def test_somebody_in_an_open_room_is_gone_round_at_once(world) -> None:
    here = world()
    here.robot.navigate("johanna", POSE, speed_m_s=0.7, detour_m=1.0)
    assert motions(here) == ["moving", "arrived"]


def test_somebody_in_the_only_gap_is_come_up_to_and_named(world) -> None:
    """At rest, at least as far from her as anybody likes, and without touching her."""
    here = world(WALL)
    here.robot.navigate("johanna", POSE, speed_m_s=0.7, detour_m=3.0)
    assert motions(here) == ["moving", "blocked"]
    motion = here.robot.motion()
    assert motion.blocked_by == "marta"
    assert motion.text == "marta is in the way to johanna"
    reading = here.robot.read("marta")
    assert 0.449 <= reading.distance_m <= 0.6
    assert reading.speed_m_s < 0.02
    assert here.robot_touches == ()


def test_the_robot_goes_on_by_itself_when_she_makes_way(world) -> None:
    here = world(WALL)
    here.robot.navigate("johanna", POSE, speed_m_s=0.7, detour_m=3.0)
    assert motions(here) == ["moving", "blocked"]
    here.move_person("marta", 6.0, 5.0, 0.0)
    here.step()
    assert motions(here) == ["moving", "arrived"]


@pytest.mark.parametrize(("detour_m", "ends"), [(0.05, "blocked"), (3.0, "arrived"), (math.inf, "arrived")])
def test_a_way_round_is_taken_where_it_is_short_enough(world, detour_m: float, ends: str) -> None:
    here = world(SECOND_GAP)
    here.robot.navigate("johanna", POSE, speed_m_s=0.7, detour_m=detour_m)
    assert motions(here, 20.0)[-1] == ends


def test_a_wall_without_a_gap_is_nobodys_fault(world) -> None:
    here = world((Wall((5.0, 0.0), (5.0, 6.0)),), marta=(3.0, 3.0))
    here.robot.navigate("johanna", POSE, speed_m_s=0.7, detour_m=3.0)
    assert motions(here) == ["blocked"]
    assert here.robot.motion().blocked_by is None


def test_a_pose_behind_somebody_in_the_only_gap_is_still_chosen(world) -> None:
    from comity_fis import load_rulebook

    values = load_rulebook("bruno2017").infer({})
    pose = world(WALL).robot.choose_pose(
        "johanna",
        distance_m=0.8,
        bearing_deg=0.0,
        distance_desirability=values["conversational_distance"].desirability,
        direction_desirability=values["approach_direction"].desirability,
    )
    assert (pose.distance_m, pose.bearing_deg, pose.pose_free) == (0.8, 0.0, True)


def test_the_emergency_stop_brakes_as_hard_as_the_base_may_whatever_it_was_told(world) -> None:
    here = world()
    here.robot.navigate("johanna", POSE, speed_m_s=0.7)
    here.run(3.0)
    before_m_s = here.robot.read("johanna").speed_m_s
    assert before_m_s > 0.3
    here.robot.emergency_stop.press("the bumper")
    here.robot.emergency_stop.press("the button")
    here.run(before_m_s / here.scene.robot.max_acceleration_m_s2 + 0.1)
    assert here.robot.read("johanna").speed_m_s < 1e-6
    here.robot.navigate("johanna", POSE, speed_m_s=0.7)
    here.run(1.0)
    assert here.robot.read("johanna").speed_m_s < 1e-6
    here.robot.emergency_stop.release("the bumper")
    assert here.robot.emergency() == "the button"
    here.robot.emergency_stop.release("the button")
    here.robot.navigate("johanna", POSE, speed_m_s=0.7)
    here.run(1.0)
    assert here.robot.read("johanna").speed_m_s > 0.2
