"""A robot that came off its way, as by a step aside, takes another one from where it is."""

from __future__ import annotations

import math

from hypothesis import example, given
from hypothesis import strategies as st

from comity_sim2d import DockingPose, Person, Pose, RobotBody, Room, RouteMap, Scene, Wall
from comity_sim2d.base.base import Base
from comity_sim2d.robot.approach import Approach, MovingTarget

STEP_S = 0.05
ANNA = Person("anna", 8.0, 3.0, math.pi)
ROUTES = RouteMap(
    Scene(
        Room.rectangle(9.0, 6.0),
        RobotBody(2.0, 3.0),
        (ANNA,),
        walls=(Wall((5.0, 0.0), (5.0, 2.4)), Wall((5.0, 3.6), (5.0, 6.0))),
    )
)
GOAL = MovingTarget((6.5, 3.0), (0.0, 0.0))


def base(xy: tuple[float, float], velocity: tuple[float, float]) -> Base:
    return Base(Pose(*xy, 0.0), velocity, 0.0, 0.5, STEP_S, 0.0)


@given(st.floats(2.0, 4.65), st.floats(0.5, 5.5))
@example(4.6, 1.5)
@example(4.65, 4.2)
def test_from_beside_its_way_it_does_not_go_straight_at_a_wall(x: float, y: float) -> None:
    """Its way led straight through a gap; it was steered elsewhere and stands there."""
    approach = Approach("anna", DockingPose(0.95, 0.0), 0.5)
    approach.steer(base((3.0, 3.0), (0.5, 0.0)), GOAL, ROUTES)
    xy, velocity = (x, y), (0.0, 0.0)
    for _ in range(600):
        velocity = approach.steer(base(xy, velocity), GOAL, ROUTES)
        xy = (xy[0] + velocity[0] * STEP_S, xy[1] + velocity[1] * STEP_S)
        assert ROUTES.surroundings.plan.blocker(xy, ROUTES.surroundings.robot_radius_m) is None
    assert math.dist(xy, GOAL.xy) < 0.02
