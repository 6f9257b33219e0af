"""Whoever is led somewhere does nothing by themselves, and others on foot meet them as anybody who walks."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from comity_sim2d import Person, RobotBody, Room, Scene, Walk, World
from comity_sim2d.people.crowd import Bodies, Crowd
from comity_sim2d.people.itinerary import Itinerary
from comity_sim2d.people.leading import Lead
from comity_sim2d.people.outlines import Outlines
from comity_sim2d.people.pedestrian_behaviour import PedestrianBehaviour, Stroller
from comity_sim2d.scene.footpath import Footpaths
from comity_sim2d.scene.obstacles import floor_plan
from comity_sim2d.scene.robot_reaction import RobotSeen

HALL = Scene(Room.rectangle(10.0, 6.0), RobotBody(0.5, 0.5))
ROBOT = RobotSeen(0.5 + 0.5j, 0j, 0.0, 0.25)
STEP_S, DECISION_S = 0.05, 0.1
ANN, BOB = 0, 1


def two(at: complex) -> Crowd:
    """Ann, and Bob at (2, 3) on his way along the hall, each of 0.2 m; both may walk by themselves."""
    plan, places = floor_plan(HALL), np.array([at, 2 + 3j, ROBOT.at])
    paths = Footpaths(plan, 0.2)
    strollers = tuple(
        Stroller(i, 1.0, Itinerary([(to_m, 0.0)], loop=False, paths=paths))
        for i, to_m in ((ANN, (9.0, 1.0)), (BOB, (9.0, 3.0)))
    )
    return Crowd(
        Bodies(places, np.zeros(3), np.array([0.2, 0.2, 0.25])),
        strollers,
        PedestrianBehaviour(strollers, places, plan, DECISION_S),
        Outlines.of(HALL),
        step_s=STEP_S,
        decision_s=DECISION_S,
    )


PLACES = st.builds(complex, st.floats(2.6, 7.0), st.floats(1.5, 4.5))
VELOCITIES = st.builds(complex, st.floats(-2.0, 2.0), st.floats(-2.0, 2.0)).filter(lambda v: abs(v) > 1e-3)


@given(PLACES, VELOCITIES)
def test_others_choose_before_somebody_who_is_led_as_before_somebody_who_walks_so(at, velocity) -> None:
    walks, led = two(at), two(at - velocity * STEP_S)
    walks.velocity[ANN] = velocity
    led.hold(ANN)
    led.put(ANN, at, 0.0)
    for crowd in (walks, led):
        crowd.decide(ROBOT)
    assert led.velocity[BOB] == pytest.approx(walks.velocity[BOB], abs=1e-6)
    assert led.velocity[ANN] == 0.0
    led.advance()
    assert complex(led.at[ANN]) == at


@given(PLACES, VELOCITIES)
def test_who_was_led_and_is_moved_no_more_stands_to_others(at, velocity) -> None:
    stands, led = two(at), two(at - velocity * STEP_S)
    stands.hold(ANN)
    led.hold(ANN)
    led.put(ANN, at, 0.0)
    led.advance()
    for crowd in (stands, led):
        crowd.velocity[BOB], crowd.at[BOB] = 0.0, 2 + 3j
        crowd.decide(ROBOT)
    assert led.velocity[BOB] == stands.velocity[BOB]


@settings(max_examples=12, deadline=None)
@given(speed_m_s=st.floats(0.5, 1.3), aside_m=st.floats(-0.2, 0.2))
def test_who_comes_towards_somebody_who_is_led_has_made_room_two_metres_before(speed_m_s, aside_m) -> None:
    ann = Person("ann", 9.0, 3.0 + aside_m, math.pi)
    bob = Person("bob", 1.0, 3.0, 0.0, walk=Walk(((9.0, 3.0),)))
    world = World(Scene(Room.rectangle(10.0, 6.0), RobotBody(0.5, 0.5), (ann, bob)))
    world.leads.begin(Lead("ann", (1.0, ann.y_m), None))
    x_m = ann.x_m
    while math.dist(world.people[0].xy, world.people[1].xy) > 2.0:
        x_m -= speed_m_s * world.step_s
        world.move_person("ann", x_m, ann.y_m, math.pi)
        world.step()
        assert world.people[0].xy == (x_m, ann.y_m), "she does nothing by herself"
    assert abs(world.people[1].y_m - 3.0) > 0.25
