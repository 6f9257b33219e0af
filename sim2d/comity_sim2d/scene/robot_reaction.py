"""Reactions of people to a robot: the six of HuNavSim.

Perez-Higueras, Otero, Caballero and Merino 2023, "HuNavSim: A ROS 2 human navigation simulator for
benchmarking human-aware robot navigation", IEEE Robotics and Automation Letters 8(11). Distances and speeds
are those of its behaviour trees and of `agent_manager.cpp` (github.com/robotics-upo/hunav_sim); what these
leave open is labelled as our choice. All distances are between the centres of the two bodies.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from typing import Literal, get_args

from comity_sim2d.scene_error import require_one_of

RobotReaction = Literal["regular", "impassive", "curious", "surprised", "scared", "threatening"]
"""In order: they take the robot for a person, take it for an object, approach it, stop and look, keep away,
or block it."""
REACTIONS: tuple[RobotReaction, ...] = get_args(RobotReaction)

SEEN_M = {"curious": 10.0, "surprised": 4.0, "scared": 3.0, "threatening": 4.0}
"""Distance of the robot at which they react [m]; the behaviour trees give none for surprise (our choice)."""
SEEN_RAD = math.pi / 2 + 0.17
"""Maximum bearing from their facing at which they see it [rad]."""
LASTS_S = 40.0
"""Total time after which they are used to it, and treat it like another person [s]."""
CURIOUS_STOP_M, CURIOUS_M_S = 1.5, 1.8
"""Distance at which they stop [m], and their speed at 10 m, which falls with the distance [m/s]."""
SCARED_M_S2, SCARED_REACH_M = 20.0, 0.2
"""The additional acceleration is `SCARED_M_S2` [m/s^2] times `SCARED_REACH_M` [m] over the distance."""
THREATENING_AHEAD_M, THREATENING_M_S = 1.4, 2.0
"""Distance ahead of the robot of the place that they head for [m], and their maximum speed [m/s]."""
ADDRESSED_M, ADDRESSED_RAD = 2.0, math.radians(45.0)
"""Distance [m] and bearing [rad] within which a robot has approached a walker (our choice)."""


@dataclass(frozen=True, slots=True)
class RobotSeen:
    """The robot, as people see it."""

    at: complex
    velocity: complex
    heading_rad: float
    radius_m: float


@dataclass(frozen=True, slots=True)
class Intent:
    """A person's current reaction in place of their walk."""

    goal: complex | None = None
    """Goal as x + iy [m]; None: stand."""
    speed_m_s: float = 0.0
    push: complex = 0j
    """An additional acceleration [m/s^2]."""
    keeps_walking: bool = False
    """Whether the walk continues nevertheless."""


def require_reaction(entity: str, reaction: str) -> None:
    """Reject an unknown reaction.

    Raises:
        SceneError: With the nearest known reaction.
    """
    require_one_of(entity, "reacts", reaction, REACTIONS, what="reaction")


def is_seen(robot: RobotSeen, at: complex, heading_rad: float, distance_m: float) -> bool:
    """Whether a person faces a robot within a distance; walls do not count here."""
    return abs(robot.at - at) <= distance_m and abs(off_rad(robot, at, heading_rad)) <= SEEN_RAD


def off_rad(robot: RobotSeen, at: complex, heading_rad: float) -> float:
    """Bearing of the robot from a person's facing, positive to the left [rad]."""
    return cmath.phase((robot.at - at) * cmath.rect(1.0, -heading_rad))


def comes_up(robot: RobotSeen, at: complex) -> bool:
    """Whether the robot is near a person and faces them."""
    apart = at - robot.at
    bearing = cmath.phase(apart * cmath.rect(1.0, -robot.heading_rad))
    return abs(apart) <= ADDRESSED_M and abs(bearing) <= ADDRESSED_RAD


def intent(reaction: RobotReaction, robot: RobotSeen, at: complex, radius_m: float) -> Intent:
    """The reaction of a person who sees the robot and is not used to it yet."""
    apart = robot.at - at
    distance = abs(apart)
    if reaction == "curious":
        if distance <= CURIOUS_STOP_M:
            return Intent()
        near = CURIOUS_STOP_M - 0.05
        return Intent(robot.at - apart / distance * near, CURIOUS_M_S * distance / SEEN_M["curious"])
    if reaction == "threatening":
        ahead = complex(math.cos(robot.heading_rad), math.sin(robot.heading_rad))
        return Intent(robot.at + ahead * THREATENING_AHEAD_M, THREATENING_M_S)
    if reaction == "scared":
        gap = max(distance - radius_m, 0.05)
        return Intent(push=-apart / distance * SCARED_M_S2 * SCARED_REACH_M / gap, keeps_walking=True)
    return Intent()
