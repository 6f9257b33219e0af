"""Somebody whom the robot goes round leaves, and the shorter way is taken; nobody makes it go to and fro."""

from __future__ import annotations

import itertools
import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from comity_sim2d import DockingPose, Person, Pose, RobotBody, Room, RouteMap, Scene, Sensor, Wall, World
from comity_sim2d.base.base import Base
from comity_sim2d.robot.approach import Approach, MovingTarget

STEP_S = 0.05
GAP = (5.0, 4.5)
POSE = DockingPose(1.0, 0.0)
KEEP = {"anna": POSE.distance_m}


def scene(*, bob=GAP, sigma_m: float = 0.0) -> Scene:
    """A wall with a gap right ahead, in which Bob stands, and a way round it at one end."""
    return Scene(
        Room.rectangle(12.0, 9.0),
        RobotBody(1.0, 4.5, sensor=Sensor(sigma_m=sigma_m)),
        (Person("anna", 10.0, 4.5, math.pi), Person("bob", *bob, 0.0)),
        walls=(Wall((5.0, 0.0), (5.0, 3.6)), Wall((5.0, 5.4), (5.0, 8.0))),
    )


def way_m(world: World, move=lambda world: None) -> float:
    """How far the robot goes until it is close to Anna."""
    world.robot.navigate("anna", POSE, speed_m_s=0.7)
    gone_m, here = 0.0, world.robot.pose.xy
    while world.robot.motion().state != "succeeded":
        assert world.time_s < 60.0
        move(world)
        world.step()
        before, here = here, world.robot.pose.xy
        gone_m += math.dist(before, here)
    return gone_m


def leaving(at_s: float):
    def move(world: World) -> None:
        if abs(world.time_s - at_s) < world.step_s / 2:
            world.move_person("bob", 2.0, 1.0, 0.0)

    return move


@pytest.mark.parametrize("at_s", [1.0, 2.0, 3.0])
def test_the_shorter_way_is_taken_when_the_person_who_stood_in_it_has_gone(at_s: float) -> None:
    round_m, straight_m = way_m(World(scene())), way_m(World(scene()), leaving(0.0))
    assert round_m > straight_m + 2.0
    assert way_m(World(scene()), leaving(at_s)) < round_m - 1.0


def test_a_way_round_that_is_taken_on_the_way_is_no_lack_of_progress() -> None:
    """Bob steps into the gap before the robot: four metres more are left, and it drives on."""
    states = []

    def step_in(world: World) -> None:
        motion = world.robot.motion()
        states.append((motion.state, motion.is_blocked))
        if abs(world.time_s - 4.0) < world.step_s / 2:
            world.move_person("bob", *GAP, 0.0)

    assert way_m(World(scene(bob=(2.0, 1.0))), step_in) > 8.0
    assert set(states) == {("running", False)}


@pytest.mark.parametrize("direction", [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0)])
def test_following_somebody_who_walks_is_progress(direction) -> None:
    """The route is made anew all the time; what the robot has driven counts all the same."""
    world = World(Scene(Room.rectangle(14.0, 9.0), RobotBody(1.0, 4.5), (Person("anna", 8.0, 4.0, math.pi),)))
    world.robot.navigate("anna", POSE, speed_m_s=0.5)
    states = set()
    while (motion := world.robot.motion()).state != "succeeded" and world.time_s < 8.0:
        states.add((motion.state, motion.is_blocked))
        x, y = (8.0 + 0.45 * world.time_s * direction[0], 4.0 + 0.45 * world.time_s * direction[1])
        world.move_person("anna", x, y, math.pi)
        world.step()
    assert states == {("running", False)}


def test_where_turning_back_saves_nothing_the_robot_stays_on_its_way() -> None:
    assert way_m(World(scene()), leaving(8.0)) == pytest.approx(way_m(World(scene())), abs=0.1)


@pytest.mark.parametrize("sigma_m", [0.0, 0.03])
def test_nobody_who_rocks_from_foot_to_foot_makes_the_robot_go_to_and_fro(sigma_m: float) -> None:
    """In the first seconds Bob may be about to leave the gap; then the robot goes round him for good."""

    def rock(world: World) -> None:
        world.move_person("bob", GAP[0], GAP[1] + 0.25 * math.sin(4.0 * world.time_s), 0.0)

    still_m = way_m(World(scene(sigma_m=sigma_m), seed=1))
    assert way_m(World(scene(sigma_m=sigma_m), seed=1), rock) == pytest.approx(still_m, abs=1.5)


@settings(max_examples=40)
@given(
    before=st.tuples(st.floats(3.0, 7.0), st.floats(1.0, 8.0)),
    now=st.tuples(st.floats(3.0, 7.0), st.floats(1.0, 8.0)),
    share=st.floats(0.0, 0.6),
)
def test_a_way_that_is_taken_for_another_is_never_left_for_that_one_again(before, now, share) -> None:
    """On one map, one change is enough."""
    first, second = (
        RouteMap(
            Scene(
                Room.rectangle(12.0, 9.0),
                RobotBody(1.0, 4.5),
                (Person("anna", 10.0, 4.5, math.pi), Person("bob", *at, 0.0)),
                walls=(Wall((5.0, 0.0), (5.0, 0.5)), Wall((8.5, 5.4), (8.5, 8.0))),
            )
        )
        for at in (before, now)
    )
    old = first.route((1.0, 4.5), (8.55, 4.5), keep=KEEP)
    assert old is not None
    gone_m = share * old.length_m
    if second.has_better(old, gone_m, keep=KEEP):
        new = second.route(old.at(gone_m), old.goal, keep=KEEP)
        assert new is not None
        assert not second.has_better(new, 0.0, keep=KEEP)


def changes_of_mind(aside_m: float, period_s: float) -> int:
    """How often a robot that has yet to set out takes the other way round Bob, who shifts to and fro."""
    anna, approach = Person("anna", 9.0, 3.0, math.pi), Approach("anna", DockingPose(0.8, 0.0), 0.7)
    base = Base(Pose(2.0, 3.0, 0.0), (0.0, 0.0), 0.0, 0.5, STEP_S, 0.0)
    goal, sides = MovingTarget((7.65, 3.0), (0.0, 0.0)), list[bool]()
    for tick in range(round(30.0 / STEP_S)):
        y = 3.0 + aside_m * math.sin(math.tau * tick * STEP_S / period_s)
        bob = Person("bob", 4.5, y, 0.0, personal_distance_m=1.2)
        route_map = RouteMap(Scene(Room.rectangle(10.0, 6.0), RobotBody(2.0, 3.0), (anna, bob)))
        sides.append(approach.steer(base, goal, route_map)[1] > 0.0)
    return sum(one != other for one, other in itertools.pairwise(sides))


@given(st.floats(0.1, 0.3), st.floats(1.5, 2.5))
@settings(max_examples=5, deadline=None)
def test_a_robot_does_not_change_its_mind_with_everybody_who_shifts_to_and_fro(
    aside_m: float, period_s: float
) -> None:
    """Both ways are open all the time; every time the other one is shorter, 24 times at least in 30 s."""
    assert changes_of_mind(aside_m, period_s) <= 16
