"""Who bars a way: people abreast and groups, from one wall to the other."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_sim2d import DockingPose, Person, RobotBody, Room, Scene, Wall, World
from comity_sim2d.navigation.barrier import who_bars
from comity_sim2d.scene.group import Group

POSE = DockingPose(0.8, 0.0)
WIDE_M = 2.6


@pytest.fixture
def corridor():
    """The robot at one end of a corridor, Carol at the other, and others between them."""

    def build(*people: Person, groups: tuple[Group, ...] = (), walls: tuple[Wall, ...] = ()) -> World:
        carol = Person("carol", 15.0, 1.3, math.pi)
        room, robot = Room.rectangle(16, WIDE_M), RobotBody(0.8, 1.3)
        return World(Scene(room, robot, (*people, carol), groups=groups, walls=walls))

    return build


def go(world: World, seconds: float = 25.0, *, detour_m: float = 3.0):
    """Set out to Carol, until the robot stands; what it says then."""
    world.robot.navigate("carol", POSE, speed_m_s=0.8, detour_m=detour_m)
    for _ in range(round(seconds * 20)):
        world.step()
        if world.robot.motion().state != "running" or world.robot.motion().is_blocked:
            break
    return world.robot.motion()


ACROSS = (Person("a", 4.5, 2.3, -math.pi / 2), Person("b", 4.5, 0.3, math.pi / 2))
TALKING = (Group("talk", ("a", "b")),)


@pytest.mark.parametrize("detour_m", [3.0, math.inf])
def test_a_group_across_a_corridor_is_come_up_to_and_both_are_named(corridor, detour_m: float) -> None:
    """The robot stands before the space between them, as far from each as they like robots to be."""
    here = corridor(*ACROSS, groups=TALKING)
    motion = go(here, detour_m=detour_m)
    assert (motion.is_blocked, motion.blocked_by) == (True, ("a", "b"))
    assert motion.text == "a and b are in the way to carol"
    (space,) = here.scene.o_spaces
    gap_m = math.dist(here.robot.pose.xy, space.xy) - space.radius_m - here.scene.robot.radius_m
    assert 0.0 <= gap_m < 0.5
    assert min(here.robot.read(name).distance_m for name in "ab") >= 0.449


def test_the_same_two_who_do_not_talk_are_passed_between(corridor) -> None:
    assert go(corridor(*ACROSS)).state == "succeeded"


def test_the_robot_goes_on_when_one_of_a_group_leaves(corridor) -> None:
    here = corridor(*ACROSS, groups=TALKING)
    assert go(here).is_blocked
    here.move_person("a", 10.0, 0.4, 0.0)
    here.step()
    assert go(here).state == "succeeded"


def test_all_who_stand_abreast_are_named(corridor) -> None:
    abreast = [Person(name, 4.5, y_m, math.pi) for name, y_m in (("a", 0.9), ("b", 1.7))]
    assert go(corridor(*abreast)).blocked_by == ("a", "b")


def test_who_stands_beside_the_one_in_the_way_without_barring_it_is_not_named(corridor) -> None:
    """In a gap of 1.6 m stands Marta; Bob is half a step behind it, beside the straight way."""
    walls = (Wall((5.0, 0.0), (5.0, 0.5)), Wall((5.0, 2.1), (5.0, 2.6)))
    here = corridor(Person("marta", 5.0, 1.3, math.pi), Person("bob", 5.6, 0.7, math.pi), walls=walls)
    assert go(here).blocked_by == ("marta",)


def test_who_can_be_gone_round_on_the_way_to_a_barrier_is_not_asked_for_it(corridor) -> None:
    """Bob stands on the straight way with room beside him; behind him two bar it."""
    abreast = [Person(name, 9.0, y_m, math.pi) for name, y_m in (("a", 0.9), ("b", 1.7))]
    here = corridor(Person("bob", 4.5, 0.8, math.pi), *abreast)
    assert go(here).blocked_by == ("a", "b")
    assert here.robot.pose.x_m > 6.0


NAMES = tuple("abcdef")


@given(st.lists(st.sets(st.sampled_from(NAMES), min_size=1), min_size=1, max_size=4))
def test_of_those_who_bar_a_way_each_is_named_who_could_open_it_else_fewest_together(barriers) -> None:
    """A way is barred as long as all of one of the barriers stand there."""

    def bars(people) -> bool:
        return any(barrier <= set(people) for barrier in barriers)

    alone = {name for name in NAMES if not bars(set(NAMES) - {name})}
    named = set(who_bars(NAMES, bars))
    if alone:
        assert named == alone
    else:
        assert not bars(set(NAMES) - named)
        assert all(bars(set(NAMES) - (named - {name})) for name in named)
