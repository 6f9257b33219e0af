"""Look before moving: a robot without all-round view drives only where it recently saw free floor.

People may be on unseen floor, whatever the motion: to a docking pose, aside, or back from an approaching
person. If its path leads onto such floor, the robot slows down, turns to look, and goes on.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from comity_sim2d.base.base import Base, VelocityCommand
from comity_sim2d.base.drive import SPEED_SHARE, limit_speed, stopping_speed
from comity_sim2d.pose import XY, direction_to, wrap_angle
from comity_sim2d.scene.obstacles import FloorPlan
from comity_sim2d.scene.person import PERSON_RADIUS_M
from comity_sim2d.scene.robot_body import RobotBody
from comity_sim2d.senses.sensing import SensedPeople
from comity_sim2d.senses.visibility_memory import CELL_M, Numbers

SEEN_S = 10.0
"""Time for which floor seen free counts as free [s]: longer than a look to both sides (our choice)."""
SHIFT_M = 0.05
"""Distance from its last known free place that it moves without looking [m], such as by its own noise (our
choice)."""
LOOKS_M_S = 0.1
"""Below this speed it stops to look instead of going on [m/s] (our choice)."""
SPARE_M = 0.1
"""Distance beyond its stopping point that it has to see [m]."""
FINISHES_S = 3.0
"""Minimum time to look at a place once it has begun, even if its goal has changed [s]: longer than half a
turn takes (our choice). Otherwise it may turn to and fro, as its goal may depend on where it looks."""


class StraightPath(NamedTuple):
    """A straight path."""

    start: XY
    direction: XY
    length_m: float


class LookBeforeMoving:
    """Keeps one robot on floor that it has seen to be free.

    Args:
        spec: The robot's body; its sensor's field of view is less than 360 degrees.
        senses: What the robot saw, and when.
    """

    def __init__(self, spec: RobotBody, senses: SensedPeople) -> None:
        self._reach_m = spec.radius_m + PERSON_RADIUS_M
        self._senses = senses
        self._knew: XY | None = None
        """The last place known to be free; at first, the start."""
        self._place: XY | None = None
        """The place it turns to look at; the side, left or right, is kept until the robot has seen the
        place."""
        self._idle_s = 0.0
        """Time since a command last led onto floor that it has to look at [s]."""
        self.looks = False
        """Whether it looks before it follows the command."""

    def allowed(self, base: Base, wanted: VelocityCommand, plan: FloorPlan) -> VelocityCommand:
        """The part of the velocity command that is allowed, and the heading for a look.

        Args:
            base: Current motion of the robot's base.
            wanted: The velocity command, within all other limits.
            plan: The static obstacles, where no person can be.
        """
        self.looks = False
        self._knew = self._knew or base.xy
        speed = math.hypot(*wanted.velocity)
        if not speed:
            return self._finishing(base, wanted)
        braking = SPEED_SHARE * base.acceleration_m_s2
        ahead_m = speed * (base.step_s + base.lag_s) + speed**2 / (2.0 * braking) + SPARE_M
        way = StraightPath(base.xy, (wanted.velocity[0] / speed, wanted.velocity[1] / speed), ahead_m)
        within_m = ahead_m + self._reach_m
        free_m = self._met(way, self._senses.unseen_floor(base.xy, SEEN_S, within_m), plan)[1]
        if not len(free_m):
            self._knew, self._place = base.xy, None
            return wanted
        least_m = max(float(free_m.min()), SHIFT_M - math.dist(base.xy, self._knew))
        most_m_s = stopping_speed(max(least_m - speed * base.lag_s, 0.0), braking, base.step_s)
        if most_m_s >= speed:
            self._place = None
            return wanted
        self.looks, self._idle_s = True, 0.0
        heading = self._heading(base)
        if heading is None:
            places = self._met(way, self._senses.floor_to_look_at(base.xy, SEEN_S, within_m), plan)[0]
            self._place = _nearest(base, places) if len(places) else None
            heading = direction_to(base.xy, self._place) if self._place else wanted.heading_rad
        if most_m_s <= LOOKS_M_S:
            return VelocityCommand((0.0, 0.0), heading)
        return wanted._replace(velocity=limit_speed(wanted.velocity, most_m_s), heading_rad=heading)

    def _finishing(self, base: Base, wanted: VelocityCommand) -> VelocityCommand:
        """The command at rest, which continues the look for a while."""
        self._idle_s += base.step_s
        heading = self._heading(base) if self._idle_s <= FINISHES_S else None
        if heading is None:
            self._place = None
            return wanted
        self.looks = True
        return wanted._replace(heading_rad=heading)

    def _heading(self, base: Base) -> float | None:
        """Heading of the place it turns to look at [rad]; None if it has looked there."""
        if self._place is None:
            return None
        x, y = self._place[0] - base.xy[0], self._place[1] - base.xy[1]
        left = self._senses.floor_to_look_at(base.xy, SEEN_S, math.hypot(x, y) + CELL_M)
        is_left = len(left) and np.hypot(left[:, 0] - x, left[:, 1] - y).min() < CELL_M / 2
        return math.atan2(y, x) if is_left else None

    def _met(self, way: StraightPath, places: Numbers, plan: FloorPlan) -> tuple[Numbers, Numbers]:
        """Places where it would touch a person standing there, and the path length up to the contact [m]."""
        along = places @ np.array(way.direction)
        across = places @ np.array((-way.direction[1], way.direction[0]))
        near = (np.abs(across) < self._reach_m) & (along > 0.0)
        near &= np.hypot(along, across) >= self._reach_m  # any nearer, it would have touched them already
        free_m = along[near] - np.sqrt(self._reach_m**2 - across[near] ** 2)
        places, free_m = places[near][free_m < way.length_m], free_m[free_m < way.length_m]
        if len(places):
            floor = plan.are_free(places + np.array(way.start), PERSON_RADIUS_M)
            places, free_m = places[floor], free_m[floor]
        return places, free_m


def _nearest(base: Base, places: Numbers) -> XY:
    """The place that needs the least turning."""
    heading = base.pose.heading_rad
    x, y = min(places.tolist(), key=lambda place: abs(wrap_angle(math.atan2(place[1], place[0]) - heading)))
    return base.xy[0] + x, base.xy[1] + y
