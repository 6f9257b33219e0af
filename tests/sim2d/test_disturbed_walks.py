"""Delay and deviation of walkers because of the robot, on walks whose delays can be worked out by hand."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sampling import sampled

from comity_sim2d import Door, PassersBy, Person, RobotBody, Room, Scene, Walk, Wall, World
from comity_sim2d.metrics.disturbed_walks import disturbed_walk
from comity_sim2d.people.undisturbed import undisturbed_walks

TICK_S = 0.05


def along(*legs, start=(0.0, 0.0)):
    """Times and places of a walk, from legs (seconds, velocity of x, velocity of y)."""
    places = [start]
    for seconds, vx, vy in legs:
        for _ in range(round(seconds / TICK_S)):
            x, y = places[-1]
            places.append((x + vx * TICK_S, y + vy * TICK_S))
    return np.column_stack([np.arange(len(places)) * TICK_S, places])


def compared(walked, undisturbed):
    return disturbed_walk(walked[:, 0], walked[:, 1:], undisturbed)


STRAIGHT = along((20.0, 1.0, 0.0))
TO_AND_FRO = along((5.0, 1.0, 0.0), (5.0, -1.0, 0.0), (5.0, 1.0, 0.0), (5.0, -1.0, 0.0))


def test_a_person_who_stands_for_four_seconds_comes_four_seconds_later():
    found = compared(along((3.0, 1.0, 0.0), (4.0, 0.0, 0.0), (8.0, 1.0, 0.0)), STRAIGHT)
    assert found.walk_delay_s == pytest.approx(4.0, abs=0.2)
    assert found.walk_deviation_m == pytest.approx(0.0, abs=1e-9)


def test_time_that_is_caught_up_again_was_a_delay_all_the_same():
    found = compared(along((3.0, 1.0, 0.0), (4.0, 0.0, 0.0), (4.0, 2.0, 0.0), (4.0, 1.0, 0.0)), STRAIGHT)
    assert found.walk_delay_s == pytest.approx(4.0, abs=0.2)


def test_a_step_aside_is_a_deviation_by_its_width():
    aside = along((3.0, 1.0, 0.0), (1.0, 0.8, 0.6), (2.0, 1.0, 0.0), (1.0, 0.8, -0.6), (5.0, 1.0, 0.0))
    found = compared(aside, STRAIGHT)
    assert found.walk_deviation_m == pytest.approx(0.6, abs=0.02)
    assert found.walk_delay_s == pytest.approx(0.4, abs=0.2)


def test_a_walk_to_and_fro_is_followed_in_its_order():
    """Held up for 2 s on the second way out: the places are those of the first one as well."""
    held_up = along((5.0, 1.0, 0.0), (5.0, -1.0, 0.0), (2.0, 1.0, 0.0), (2.0, 0.0, 0.0), (3.0, 1.0, 0.0))
    assert compared(held_up, TO_AND_FRO).walk_delay_s == pytest.approx(2.0, abs=0.2)


def test_a_rest_that_is_part_of_the_walk_is_no_delay():
    rests = along((3.0, 1.0, 0.0), (6.0, 0.0, 0.0), (3.0, 1.0, 0.0))
    assert compared(rests, rests).walk_delay_s == pytest.approx(0.0, abs=1e-9)


def test_a_person_who_comes_sooner_is_not_late():
    assert compared(along((5.0, 1.5, 0.0)), STRAIGHT).walk_delay_s == 0.0


def walkers(robot_at, *, passing=True):
    people = (
        Person("ann", 3.0, 2.0, 0.0, walk=Walk(((3.0, 2.0), (9.0, 6.0)), loop=True)),
        Person("ben", 9.0, 2.0, 0.0),
    )
    passers_by = PassersBy(4, reacts="regular") if passing else None
    return Scene(Room.rectangle(40.0, 8.0), RobotBody(*robot_at, 0.0), people, passers_by=passers_by)


@sampled(5)
@given(st.integers(0, 1000))
def test_a_walk_without_the_robot_is_the_walk_beside_a_robot_that_is_far_away(seed):
    scene = walkers((39.0, 4.0), passing=False)
    world = World(scene, seed)
    for _ in range(200):
        world.step()
    alone = undisturbed_walks(scene, seed, 200)
    assert set(alone) == {"ann"}
    np.testing.assert_allclose(alone["ann"][:, 1:], world.frames.of("ann")[:, :2], atol=1e-9)


def test_a_robot_in_the_path_delays_and_turns_aside_the_people_who_meet_it():
    scene = walkers((6.0, 4.0))
    world = World(scene, 3)
    world.robot.emergency_stop.press("it only stands there")
    for _ in range(400):
        world.step()
    alone = undisturbed_walks(scene, 3, 600)
    assert set(alone) == {"ann", *world.scene.passers_by.names}
    frames = world.frames
    found = disturbed_walk(frames.time_s, frames.of("ann")[:, :2], alone["ann"])
    assert found.walk_deviation_m > 0.3
    assert 0.0 <= found.walk_delay_s < 5.0


def test_a_door_that_shuts_shuts_in_the_walk_without_the_robot_too():
    """The near door shuts at once: the way through the far one is some 13 m longer."""
    doors = (Door("near", (4.0, 1.5), (4.0, 2.5)), Door("far", (4.0, 7.5), (4.0, 8.5)))
    walls = (Wall((4.0, 0.0), (4.0, 1.5)), Wall((4.0, 2.5), (4.0, 7.5)), Wall((4.0, 8.5), (4.0, 9.0)))
    ann = Person("ann", 2.0, 2.0, 0.0, walk=Walk(((2.0, 2.0), (6.0, 2.0)), loop=False, speed_m_s=1.0))
    scene = Scene(Room.rectangle(30.0, 9.0), RobotBody(29.0, 8.0), (ann,), walls, doors=doors)
    world = World(scene)
    world.set_door("near", open=False)
    for _ in range(600):
        world.step()
    alone = undisturbed_walks(scene, 0, 600, turns=world.door_turns)["ann"]
    np.testing.assert_allclose(alone[:, 1:], world.frames.of("ann")[:, :2], atol=1e-6)
    assert alone[120, 1] < 4.0 < alone[-1, 1]


def test_nobody_who_may_move_has_no_walk():
    scene = Scene(Room.rectangle(6.0, 6.0), RobotBody(1.0, 1.0, 0.0), (Person("ann", 3.0, 2.0, 0.0),))
    assert undisturbed_walks(scene, 0, 10) == {}
