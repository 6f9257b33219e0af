"""Gaze of the robot: ahead on its path, at people it waits for, and near the goal at the visited person."""

from __future__ import annotations

from collections.abc import Collection

from comity_sim2d.base.base import Base
from comity_sim2d.pose import XY, direction_to
from comity_sim2d.robot.approach import Approach
from comity_sim2d.senses.sensing import SensedPeople

LOOK_M = 1.5
"""Length of the last stretch on which the robot faces the person instead of its path [m]."""
DRIVES_M_S = 0.05
"""Below this speed it is blocked, or has not set out [m/s]."""


def gaze_rad(
    approach: Approach, base: Base, visited: XY, waits_for: Collection[str], senses: SensedPeople
) -> float:
    """Gaze direction for the coming tick [rad].

    Args:
        approach: The current approach.
        base: Current motion of its base.
        visited: Position of the person or place that it approaches [m].
        waits_for: People who block its path.
        senses: Believed positions of people.
    """
    stands = base.speed_m_s < DRIVES_M_S
    watched = _watched(base.xy, waits_for, senses) if waits_for and stands else None
    if watched is not None:
        return direction_to(base.xy, watched)
    near = approach.remaining_m < LOOK_M
    # A base that turns before it drives would turn to and fro: to the person while it waits, and back.
    waits = approach.gives_way_to and (base.turns_to_go or not near)
    if not approach.has_route or waits:
        return base.pose.heading_rad
    return direction_to(base.xy, visited if near or stands else _ahead(base))


def _watched(xy: XY, people: Collection[str], senses: SensedPeople) -> XY | None:
    """Position of the nearest listed person whom the robot must face to see them go; None without one [m]."""
    name = next((name for name in people if senses.has_to_watch(name, xy)), None)
    return None if name is None else senses.person(name).xy


def _ahead(base: Base) -> XY:
    return (base.xy[0] + base.velocity[0], base.xy[1] + base.velocity[1])
