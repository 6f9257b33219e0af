"""In a corridor the robot lets people pass who come towards it or across its way."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_sim2d import DockingPose, Person, RobotBody, Room, Scene, World
from comity_sim2d.avoidance.right_of_way import CLOSES_M_S, GRAZES_M, SIDEWAYS_COS, yield_to
from comity_sim2d.base.drive import KEEP_OFF_M


def corridor(width: float, walker: Person) -> World:
    """The robot at the left end, the one it visits at the right end."""
    people = (Person("p0", 13.0, width / 2, math.pi), walker)
    return World(Scene(Room.rectangle(14.0, width), RobotBody(1.0, width / 2), people))


def walk(
    world: World, velocity: tuple[float, float], seconds: float
) -> tuple[list[float], list[float], list[str]]:
    """The gaps, the robot's speeds and what it says while somebody walks, looking at nothing."""
    gaps, speeds, texts = [], [], []
    for _ in range(round(seconds * 20)):
        bo = world.people[1]
        world.move_person("bo", bo.x_m + velocity[0] / 20, bo.y_m + velocity[1] / 20, bo.heading_rad)
        before = world.robot.pose.xy
        world.step()
        gaps.append(math.dist(world.robot.pose.xy, world.people[1].xy) - 0.45)
        speeds.append(math.dist(before, world.robot.pose.xy) * 20)
        texts.append(world.robot.motion().text)
    return gaps, speeds, texts


def test_somebody_who_comes_towards_the_robot_in_a_narrow_corridor_finds_it_at_rest() -> None:
    """There is no room to pass: the robot stands before they meet, and moves at nobody."""
    world = corridor(1.4, Person("bo", 9.0, 0.7, math.pi))
    world.robot.navigate("p0", DockingPose(0.8, 0.0), speed_m_s=0.7)
    gaps, speeds, texts = walk(world, (-0.8, 0.0), 7.0)
    assert {"giving way to bo", "bo is in the way to p0"} & set(texts)
    meeting = next((i for i, gap in enumerate(gaps) if gap < 0.02), len(gaps))  # then it is pushed
    near = [speed for gap, speed in zip(gaps[:meeting], speeds, strict=False) if gap < 0.35]
    assert max(near, default=0.0) < 0.05
    assert max(speeds[:meeting][-5:]) < 0.05


def test_in_a_wide_corridor_both_go_on() -> None:
    world = corridor(4.0, Person("bo", 11.0, 1.0, math.pi))
    world.robot.navigate("p0", DockingPose(0.8, 0.0), speed_m_s=0.7)
    gaps, speeds, _ = walk(world, (-0.8, 0.0), 10.0)
    assert min(gaps) > 0.3
    assert min(speeds[20:]) > 0.2


@pytest.mark.parametrize("speed", [0.6, 1.0])
def test_somebody_who_crosses_is_let_by_and_then_the_robot_goes_on(speed: float) -> None:
    world = corridor(6.0, Person("bo", 4.5, 0.5, math.pi / 2))
    world.robot.navigate("p0", DockingPose(0.8, 0.0), speed_m_s=0.7)
    gaps, _, _ = walk(world, (0.0, speed), 5.0 / speed)
    assert min(gaps) > 0.25
    world.run(25.0)
    assert world.robot.motion().state == "succeeded"
    assert world.robot_touches == ()


@given(gap_m=st.floats(0.01, 0.29), angle_deg=st.floats(0.0, 180.0))
def test_who_stands_beside_the_robot_does_not_hold_it_up_on_a_line_that_leads_by(
    gap_m: float, angle_deg: float
):
    """Inside the margin: towards them it stands still, and past them it goes, nearer slowly and by little."""
    reach_m = 0.45
    apart_m, course = reach_m + gap_m, math.radians(angle_deg)
    wanted = (0.2 * math.cos(course), 0.2 * math.sin(course))
    left = yield_to(
        wanted, (0.0, 0.0), np.array([complex(apart_m)]), np.array([reach_m]), braking=0.45, ahead_m=0.0
    )
    nearer_m = apart_m * (1.0 - math.sin(course))
    most_m = min(GRAZES_M, gap_m - KEEP_OFF_M)
    if nearer_m < most_m - 1e-9 or math.cos(course) <= SIDEWAYS_COS:
        assert 0.0 < math.hypot(*left) <= 0.2 + 1e-9
        assert left[0] <= CLOSES_M_S + 1e-9
        assert left == wanted or math.cos(course) > 0.0
    elif nearer_m > most_m + 1e-9:
        assert left == (0.0, 0.0)
