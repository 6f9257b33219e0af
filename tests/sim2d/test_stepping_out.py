"""Passers-by who stand in the only way are named, asked to let the robot pass, and step out of its way."""

from __future__ import annotations

import itertools
import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from comity_executor import ActGoal
from comity_sim2d import DockingPose, PassersBy, Person, RobotBody, Room, Scene, Wall, World
from comity_sim2d.clock import Clock
from comity_sim2d.people.pedestrians import Pedestrians
from comity_sim2d.people.stepping_out import HEARD_M, way_out
from comity_sim2d.scene.footpath import Footpaths
from comity_sim2d.scene.obstacles import floor_plan
from comity_sim2d.scene.robot_reaction import REACTIONS

ADA = Person("ada", 7.0, 1.0, math.pi / 2)
WALLS = (Wall((4.0, 0.0), (4.0, 2.0)), Wall((4.0, 2.9), (4.0, 5.0)))
"""A door of 0.9 m."""
STARES = 6
"""With this seed somebody curious stops in the door when the robot wants through."""


def doorway(reacts: str = "curious") -> Scene:
    passers_by = PassersBy(1, between=((2.0, 4.0), (7.0, 4.0)), reacts=reacts)
    return Scene(Room.rectangle(8.0, 5.0), RobotBody(1.0, 2.4), (ADA,), WALLS, passers_by=passers_by)


def until_blocked() -> World:
    """The robot wants through a door in which somebody stands and looks at it."""
    world = World(doorway(), STARES)
    world.robot.dock("ada", DockingPose(0.64, 0.0), speed_m_s=0.5)
    while not world.robot.motion().blocked_by:
        world.step()
        assert world.time_s < 20.0
    return world


def test_who_stands_in_the_only_way_is_named() -> None:
    motion = until_blocked().robot.motion()
    assert motion.blocked_by == ("passer-by 1",)
    assert motion.text == "passer-by 1 is in the way to ada"


def test_who_is_asked_steps_out_of_the_way() -> None:
    world = until_blocked()
    world.robot.perform(ActGoal("ask_to_pass", "passer-by 1", "Excuse me, may I pass?"))
    asked_s = world.time_s
    while world.robot.motion().blocked_by:
        world.step()
        assert world.time_s < asked_s + 5.0
    while world.robot.motion().state != "succeeded":
        world.step()
        assert world.time_s < asked_s + 20.0
    assert world.robot_touches == ()


def test_who_is_not_asked_stays() -> None:
    world = until_blocked()
    world.run(10.0)
    assert world.robot.motion().blocked_by == ("passer-by 1",)


def test_a_question_that_is_broken_off_is_none() -> None:
    world = until_blocked()
    asks = world.robot.perform(ActGoal("ask_to_pass", "passer-by 1", "Excuse me, may I pass?"))
    world.run(0.5)
    world.robot.stop(asks)
    world.run(5.0)
    assert world.robot.motion().blocked_by == ("passer-by 1",)


def test_they_go_on_when_the_robot_is_by() -> None:
    world = until_blocked()
    world.robot.perform(ActGoal("ask_to_pass", "passer-by 1", "Excuse me, may I pass?"))
    world.run(25.0)
    tracks = [row[2:4] for row in world.frames.rows() if row[1] == "passer-by 1"]
    assert max(math.dist(tracks[-1], xy) for xy in tracks[-200:]) > 1.0


def test_passers_by_are_asked_to_let_it_pass_and_told_nothing_else() -> None:
    world = until_blocked()
    with pytest.raises(ValueError, match="passer-by 1"):
        world.robot.perform(ActGoal("say", "passer-by 1", "Good morning"))


@pytest.mark.parametrize("reacts", REACTIONS)
def test_nobody_makes_way_for_a_thing_or_means_to(reacts: str) -> None:
    traffic = Pedestrians(doorway(reacts), Clock(20), 0)
    x, y = traffic.poses[0, :2].tolist()
    makes_way = traffic.ask_to_pass("passer-by 1", (x + 1.0, y), ((x + 1.0, y), (x - 2.0, y)))
    assert makes_way == (reacts not in {"impassive", "threatening"})


def test_who_does_not_hear_it_stays() -> None:
    traffic = Pedestrians(doorway(), Clock(20), 0)
    x, y = traffic.poses[0, :2].tolist()
    far = (x + HEARD_M + 0.1, y)
    assert not traffic.ask_to_pass("passer-by 1", far, (far, (x - 2.0, y)))


@settings(deadline=None, max_examples=40)
@given(x=st.floats(3.4, 5.0), y=st.floats(2.2, 2.7), back=st.booleans())
def test_where_they_go_the_robot_gets_by(x: float, y: float, back: bool) -> None:
    """Whichever side it comes from, wherever in the door they stand; on their way they do not touch it."""
    plan = floor_plan(doorway())
    ends = ((x + 1.0, y), (1.0, 2.4)) if back else ((x - 1.0, y), (7.0, 2.4))
    robot = (*ends[0], 0.25)
    way = [ends[0], (4.0, 2.45), ends[1]]
    paths = Footpaths(plan, 0.2)
    found = way_out((x, y), way, robot, radius_m=0.2, others=(), plan=plan, paths=paths)
    assert found is not None
    assert plan.blocker(found[-1], 0.2) is None
    legs = list(itertools.pairwise(way))
    assert min(_from(found[-1], leg) for leg in legs) >= 0.2 + 0.25 + 0.3
    walked = zip([(x, y), *found], found, strict=False)
    assert min(_from(robot[:2], leg) for leg in walked) >= 0.2 + 0.25


def _from(xy: tuple[float, float], leg: tuple[tuple[float, float], tuple[float, float]]) -> float:
    """From a point to a straight line, by plain geometry."""
    (ax, ay), (bx, by) = leg
    square = (bx - ax) ** 2 + (by - ay) ** 2
    share = ((xy[0] - ax) * (bx - ax) + (xy[1] - ay) * (by - ay)) / square if square else 0.0
    share = min(max(share, 0.0), 1.0)
    return math.dist(xy, (ax + share * (bx - ax), ay + share * (by - ay)))
