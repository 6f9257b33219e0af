"""Those who stand are on the map of routes; those who walk are left to the robot's reactions."""

from __future__ import annotations

import math
from collections.abc import Callable
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from comity_sim2d import DockingPose, PassersBy, Person, RobotBody, Room, RouteMap, Scene, Walk, Wall, World
from comity_sim2d.clock import Clock
from comity_sim2d.robot.standing import RENEWS_S, STANDS_M, STANDS_S, Loiterers

HOST = Person("host", 8.5, 6.5, -2.4)
LONGEST_S = 12.0
"""Somebody surprised stands for up to 40 s."""


def _hall(reacts: str, count: int) -> Scene:
    passing = PassersBy(count, reacts=reacts)
    return Scene(Room.rectangle(10.0, 8.0), RobotBody(1.0, 1.0), (HOST,), passers_by=passing)


@pytest.mark.parametrize("reacts", ["surprised", "curious"])
@pytest.mark.parametrize("seed", range(6))
def test_the_robot_does_not_wait_until_those_who_look_at_it_have_seen_enough(reacts, seed):
    world = World(_hall(reacts, 3), seed)
    world.robot.navigate("host", DockingPose(0.8, 0.0), speed_m_s=0.7)
    stood_s = longest_s = 0.0
    while world.robot.motion().state != "succeeded" and world.time_s < 60.0:
        before = world.robot.pose.xy
        world.step()
        stood_s = stood_s + world.step_s if math.dist(before, world.robot.pose.xy) < 1e-3 else 0.0
        longest_s = max(longest_s, stood_s)
    assert world.robot.motion().state == "succeeded"
    assert longest_s < LONGEST_S


def _seen(places: list[complex]) -> SimpleNamespace:
    at = np.array(places, dtype=complex)
    poses = np.stack([at.real, at.imag, np.zeros(len(at))], axis=1)
    names = tuple(f"passer-by {i + 1}" for i in range(len(at)))
    return SimpleNamespace(at=at, radius_m=np.full(len(at), 0.2), names=names, poses=poses)


@given(
    speeds=st.lists(st.one_of(st.just(0.0), st.floats(2 * STANDS_M / STANDS_S, 2.0)), min_size=1, max_size=5)
)
def test_whoever_goes_nowhere_for_a_while_stands_and_nobody_else(speeds):
    clock = Clock(20)
    seen = _seen([complex(0, 3 * i) for i in range(len(speeds))])
    loiterers = Loiterers(seen, clock)
    for _ in range(20 * 3):
        seen.at += np.array(speeds) * clock.step_s
        clock.tick += 1
        loiterers.look()
    standing = {name for name, speed in zip(seen.names, speeds, strict=True) if speed == 0.0}
    assert {person.name for person in loiterers.look()} == standing


def _corridor(walk: Walk | None = None, bob: tuple[float, float] = (6.0, 1.0)) -> World:
    """A hall in which bob stands or walks, and a robot on its way to the host at the other end."""
    people = (Person("host", 11.0, 4.0, math.pi), Person("bob", *bob, 0.0, walk=walk))
    world = World(Scene(Room.rectangle(12.0, 8.0), RobotBody(1.0, 4.0), people))
    world.robot.navigate("host", DockingPose(0.8, 0.0), speed_m_s=0.5)
    return world


def _maps(world: World, seconds: float, move: Callable[[World], None] = lambda world: None) -> list[RouteMap]:
    """The map of routes in each tick."""
    found = []
    for _ in range(round(seconds / world.step_s)):
        move(world)
        world.step()
        found.append(world.robot._controller.standing.map)
    return found


def _names(route_map: RouteMap) -> list[str]:
    return [person.name for person in route_map.surroundings.people]


@given(st.floats(0.3, 1.6))
@settings(max_examples=10, deadline=None)
def test_a_walk_changes_no_map(speed_m_s: float) -> None:
    """Bob walks along the hall, beside the robot's way, and is on no map until he stands at its end."""
    world = _corridor(Walk(((0.8, 1.0),), speed_m_s=speed_m_s))
    maps = _maps(world, 3.0)[20:]  # in the first second he turns and sets out
    assert len({id(route_map) for route_map in maps}) == 1
    assert _names(maps[-1]) == ["host"]


def test_whoever_comes_to_stand_is_mapped_after_a_second_where_they_stand() -> None:
    world = _corridor(Walk(((5.0, 1.0),), speed_m_s=1.0))
    assert _names(_maps(world, 1.0)[-1]) == ["host"]
    mapped = _maps(world, 3.0)[-1]
    assert _names(mapped) == ["host", "bob"]
    assert mapped.surroundings.person("bob").xy == world.people[1].xy


def test_the_map_changes_twice_a_second_at_most() -> None:
    """Also where somebody shifts a little all the time."""

    def shuffle(world: World) -> None:
        world.move_person("bob", 6.0 + 0.1 * world.time_s, 1.0, 0.0)

    maps = _maps(_corridor(), 5.0, shuffle)
    assert 5 <= len({id(route_map) for route_map in maps}) <= 5.0 / RENEWS_S + 1


def test_whoever_walks_to_and_fro_in_the_only_doorway_is_asked_in_the_end() -> None:
    """He never stands; and after a while the robot knows that he holds it up."""
    walls = (Wall((6.0, 0.0), (6.0, 3.4)), Wall((6.0, 4.6), (6.0, 8.0)))
    people = (Person("host", 11.0, 4.0, math.pi), Person("bob", 6.0, 4.0, 0.0))
    world = World(Scene(Room.rectangle(12.0, 8.0), RobotBody(4.0, 4.0), people, walls))
    world.robot.navigate("host", DockingPose(0.8, 0.0), speed_m_s=0.5)
    named = set[str]()
    for _ in range(round(20.0 / world.step_s)):
        world.move_person("bob", 6.0 + 0.8 * math.sin(world.time_s), 4.0, 0.0)
        world.step()
        named.update(world.robot.motion().blocked_by)
    assert named == {"bob"}
    assert all(touch.entity != "bob" for touch in world.robot_touches)
