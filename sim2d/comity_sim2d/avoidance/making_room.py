"""Making room: a robot that cannot step aside retreats from a slowly approaching person."""

from __future__ import annotations

import math
from collections.abc import Iterable

from comity_fis.proxemics import PERSON_MARGIN_M
from comity_sim2d.base.drive import NEAR_PEOPLE_M_S
from comity_sim2d.navigation.yielding import Walker
from comity_sim2d.pose import XY
from comity_sim2d.scene.obstacles import WALL_MARGIN_M, FloorPlan

WITHIN_S = 1.0
"""The robot makes room for a person who would come within `PERSON_MARGIN_M` of its body sooner than this [s]
(our choice)."""


def make_room(
    xy: XY, velocity: XY, radius_m: float, walkers: Iterable[Walker], plan: FloorPlan, *, braking: float
) -> XY:
    """The velocity, with as much retreat as keeps the distance to an approaching person [m/s].

    The robot cannot get away from a person who is faster than its speed limit near people: then it stays.

    Args:
        xy: Position of the robot's centre [m].
        velocity: The velocity command [m/s].
        radius_m: Radius of the robot [m].
        walkers: People who move.
        plan: The static obstacles, which the robot must not back into.
        braking: The assumed deceleration [m/s^2].
    """
    made = velocity
    for walker in walkers:
        made = _before(walker, xy, made, radius_m)
    if made == velocity:
        return velocity
    speed = math.hypot(*made)
    ahead_s = speed / (2.0 * braking) + WITHIN_S / 4
    there = (xy[0] + made[0] * ahead_s, xy[1] + made[1] * ahead_s)
    return velocity if plan.blocker(there, radius_m + WALL_MARGIN_M) else made


def _before(walker: Walker, xy: XY, velocity: XY, radius_m: float) -> XY:
    """The velocity after making room for one person [m/s]."""
    person = walker.person
    apart = math.dist(xy, person.xy)
    if not apart:
        return velocity
    ux, uy = (xy[0] - person.x_m) / apart, (xy[1] - person.y_m) / apart
    closing = walker.velocity[0] * ux + walker.velocity[1] * uy
    gap_m = apart - person.radius_m - radius_m - PERSON_MARGIN_M
    back = min(closing, closing - gap_m / WITHIN_S)
    lacks = back - (velocity[0] * ux + velocity[1] * uy)
    if back <= 0.0 or lacks <= 0.0 or closing > NEAR_PEOPLE_M_S:
        return velocity
    return (velocity[0] + lacks * ux, velocity[1] + lacks * uy)
