"""Making room: a robot that cannot step aside goes back before whoever comes slowly, where there is space."""

from __future__ import annotations

import math
from collections.abc import Iterable

from comity_sim2d.base.drive import KEEP_OFF_M, NEAR_PEOPLE_M_S
from comity_sim2d.navigation.yielding import Walker
from comity_sim2d.pose import XY
from comity_sim2d.scene.obstacles import WALL_MARGIN_M, FloorPlan

WITHIN_S = 1.0
"""Who would be at the robot's body (but for `KEEP_OFF_M`) sooner than this is made room for (our choice)."""


def make_room(
    xy: XY, velocity: XY, radius_m: float, walkers: Iterable[Walker], plan: FloorPlan, *, braking: float
) -> XY:
    """The velocity with as much of going back as keeps whoever comes nearer at a distance.

    Who is faster than the robot may be near people cannot be got away from: for them it stays where it is.

    Args:
        xy: Where the robot's centre is.
        velocity: What is wanted.
        radius_m: Of the robot.
        walkers: Who moves.
        plan: What it must not go back into.
        braking: The deceleration to count on [m/s^2].
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
    """The velocity that one of them leaves."""
    person = walker.person
    apart = math.dist(xy, person.xy)
    if not apart:
        return velocity
    ux, uy = (xy[0] - person.x_m) / apart, (xy[1] - person.y_m) / apart
    closing = walker.velocity[0] * ux + walker.velocity[1] * uy
    gap_m = apart - person.radius_m - radius_m - KEEP_OFF_M
    back = min(closing, closing - gap_m / WITHIN_S)
    lacks = back - (velocity[0] * ux + velocity[1] * uy)
    if back <= 0.0 or lacks <= 0.0 or closing > NEAR_PEOPLE_M_S:
        return velocity
    return (velocity[0] + lacks * ux, velocity[1] + lacks * uy)
