"""Distance between a robot and the person nearest to it, by its own localisation and tracker."""

from __future__ import annotations

import time
from math import dist, isfinite
from typing import TYPE_CHECKING

from comity_fis.errors import WrongValueError

if TYPE_CHECKING:
    from comity_executor import MapRobot

FRESH_S = 0.5
"""Maximum age of a measurement [s]."""
BRAKES_S, PERIOD_S = 3.0, 0.05
"""Time limit for the robot to come to rest, and polling period [s]."""


def stopped_at(robot: MapRobot) -> float:
    """Stop the robot, then measure its distance to the nearest person, between the centres [m].

    Raises:
        WrongValueError: if it does not come to rest, or its own or the person's position is unknown.
    """
    robot.stop()
    ends_s = robot.now_s() + BRAKES_S
    while not robot.motion().is_at_rest:
        if robot.now_s() > ends_s:
            raise _silent(f"one that still moves after {BRAKES_S:g} s")
        getattr(robot, "sleep", time.sleep)(PERIOD_S)
    here, now_s = robot.localisation(), robot.now_s()
    if here is None or now_s - here.stamp_s > FRESH_S:
        raise _silent("one that does not know where it is")
    seen = [one for one in robot.tracks() or () if now_s - one.stamp_s <= FRESH_S]
    far = [dist((here.x_m, here.y_m), (one.x_m, one.y_m)) for one in seen]
    if not any(map(isfinite, far)):
        raise _silent("one that sees no person")
    return min(filter(isfinite, far))


def _silent(got: str) -> WrongValueError:
    return WrongValueError(
        expected="a robot at rest that sees the person", got=got, remedy="Measure, and type the distance."
    )
