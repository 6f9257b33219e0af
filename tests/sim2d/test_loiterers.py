"""Passers-by who stand about are gone round; those who walk are let pass."""

from __future__ import annotations

import math
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_sim2d import DockingPose, PassersBy, Person, RobotBody, Room, RouteMap, Scene, World
from comity_sim2d.clock import Clock
from comity_sim2d.robot.loiterers import EVERY_TICKS, STANDS_M, STANDS_S, Loiterers

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


def test_the_map_stays_the_same_as_long_as_the_same_people_stand():
    clock, seen = Clock(20), _seen([4 + 4j])
    loiterers, bare = Loiterers(seen, clock), RouteMap(_hall("regular", 1))
    assert loiterers.on(bare) is bare
    clock.tick += round(STANDS_S * clock.hz)
    around = loiterers.on(bare)
    assert [person.name for person in around.surroundings.people] == ["host", "passer-by 1"]
    clock.tick += EVERY_TICKS
    assert loiterers.on(bare) is around
    seen.at += 1.0
    clock.tick += EVERY_TICKS
    assert loiterers.on(bare) is bare
