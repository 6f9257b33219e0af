"""Overlap resolution: moves people's noisy believed positions apart until no bodies overlap."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations

from comity_sim2d.pose import XY
from comity_sim2d.scene.obstacles import FloorPlan
from comity_sim2d.scene.person import Person
from comity_sim2d.scene.robot_body import RobotBody

ROUNDS = 50
"""Maximum number of rounds; in a corner, one is not enough."""
NEAR_M = 1.0
"""Distance beyond which pairs of people are ignored [m] (our choice: people move by centimetres)."""
SPARE_M = 1e-6
"""Resulting gap [m], above rounding errors."""


def taken_apart(people: Sequence[Person], robot: RobotBody, plan: FloorPlan) -> tuple[Person, ...]:
    """The people, moved slightly so that none overlaps another person, the robot or an obstacle.

    Two people each move by half of their overlap. If there is no room for all, some still overlap.

    Args:
        people: People at their believed poses.
        robot: The robot, whose pose is known.
        plan: The static obstacles.
    """
    at = [person.xy for person in people]
    near = [
        (i, j, reach_m)
        for (i, one), (j, other) in combinations(enumerate(people), 2)
        if math.dist(one.xy, other.xy) < NEAR_M + (reach_m := one.radius_m + other.radius_m)
    ]
    # Overlap resolution by projection, one constraint after the other, until none moves a person
    # (Gauss-Seidel over positions, as in position based dynamics; Mueller et al. 2007). Walls, furniture and
    # the robot come first in each round and do not yield, as their places are known; two people share what
    # they overlap, as both are believed with the same noise. Only people near each other as first believed
    # are paired, since they move by centimetres: the rest of a crowd costs nothing.
    for _ in range(ROUNDS):
        before = list(at)
        for i, person in enumerate(people):
            things = plan.bare if person.posture == "seated" else plan
            at[i] = _off_robot(off_things(at[i], person.radius_m, things), person.radius_m, robot)
        for i, j, reach_m in near:
            if math.dist(at[i], at[j]) < reach_m:
                at[i], at[j] = _off_one_another(at[i], at[j], reach_m)
        if at == before:
            break
    return tuple(
        person if xy == person.xy else replace(person, x_m=xy[0], y_m=xy[1])
        for person, xy in zip(people, at, strict=True)
    )


def off_things(xy: XY, radius_m: float, plan: FloorPlan) -> XY:
    """The nearest place where a disc is clear of walls and furniture; `xy` itself if it is."""
    if plan.blocker(xy, radius_m) is None:
        return xy
    from shapely import Point
    from shapely.ops import nearest_points

    free = plan.clear_space(radius_m + SPARE_M)
    if free.is_empty:
        return xy
    nearest = nearest_points(free, Point(xy))[0]
    return (nearest.x, nearest.y)


def _off_robot(xy: XY, radius_m: float, robot: RobotBody) -> XY:
    reach_m = radius_m + robot.radius_m
    return xy if math.dist(xy, robot.pose.xy) >= reach_m else _beside(robot.pose.xy, xy, reach_m + SPARE_M)


def _off_one_another(one: XY, other: XY, reach_m: float) -> tuple[XY, XY]:
    middle = ((one[0] + other[0]) / 2.0, (one[1] + other[1]) / 2.0)
    x, y = _beside(middle, other, (reach_m + SPARE_M) / 2.0)
    return (2.0 * middle[0] - x, 2.0 * middle[1] - y), (x, y)


def _beside(centre: XY, xy: XY, away_m: float) -> XY:
    """The point at a distance from a centre in the direction of `xy`; along x if both coincide."""
    x, y = xy[0] - centre[0], xy[1] - centre[1]
    length_m = math.hypot(x, y)
    x, y = (x / length_m, y / length_m) if length_m else (1.0, 0.0)
    return (centre[0] + away_m * x, centre[1] + away_m * y)
