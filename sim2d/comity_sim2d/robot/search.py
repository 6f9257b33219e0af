"""Search for an unseen person that the robot approaches or faces.

The robot searches for a lost person by turning round, first where it notices the loss, and once more where
they were last seen; then the search ends. A two-wheeled robot, which faces its direction of travel, looks
once at a person out of view on its way to a docking pose. Otherwise it might arrive next to a person who has
moved, without ever having seen them.
"""

from __future__ import annotations

import math

from comity_sim2d.base.base import Base
from comity_sim2d.clock import Clock
from comity_sim2d.pose import XY, direction_to, wrap_angle
from comity_sim2d.robot.approach import Approach
from comity_sim2d.robot.look_round import LookRound, Loss, how_lost
from comity_sim2d.robot.motion import MotionProgress, blocked
from comity_sim2d.scene.robot_body import Sensor
from comity_sim2d.senses.sensing import SensedPeople

THERE_M = 0.1
"""Distance from the pose at which the robot has reached the place where the person was last seen [m] (our
choice)."""
FACES_RAD = math.radians(0.5)
"""Tolerance of the turn to where the person should be [rad]."""
GLANCE_S = 0.5
"""Duration of the look at where the person should be [s]: longer than it takes to conclude that they are
gone."""

Turn = tuple[float, MotionProgress]
"""Heading for the coming tick on the spot [rad], and the progress, in words."""


class Search:
    """The search of one robot for a person out of view.

    Args:
        sensor: Its field of view and delay.
        senses: People it sees, and people it has lost.
        clock: The ticks.
    """

    def __init__(self, sensor: Sensor, senses: SensedPeople, clock: Clock) -> None:
        self._sensor = sensor
        self._senses = senses
        self._clock = clock
        self._look_round = LookRound(sensor, clock)
        self._looked_on: Approach | None = None
        """The approach during which it has looked round, before moving on to where the person was last
        seen."""
        self._given_up: Loss | None = None
        self._glanced_on: Approach | None = None
        """The approach during which it has looked at the unseen person."""
        self._glances = False
        self._faces_s = 0.0

    def turn(self, person: str, approach: Approach | None, base: Base, *, docks: bool) -> Turn | None:
        """The turn on the spot to see a person; None if the robot's goal continues.

        Args:
            person: The person that it approaches or faces.
            approach: The approach to them; None if it only faces them.
            base: Current motion of its base.
            docks: Whether it leads onto a docking pose.
        """
        found = self._look_for(person, approach, base, docks=docks)
        if found is None and approach is not None and docks and base.turns_to_go:
            return self._glance(approach, base)
        return found

    def in_vain(self, person: str, xy: XY) -> str | None:
        """Since when a person has been lost whom it did not find at their last place, in words; else None."""
        loss = self._loss(person)
        if loss is None or self._given_up != loss or self._look_round.is_due(loss, xy):
            return None
        return how_lost(loss)

    def _loss(self, person: str) -> Loss | None:
        return (person, self._senses.last_seen_s(person)) if self._senses.has_lost(person) else None

    def _look_for(self, person: str, approach: Approach | None, base: Base, *, docks: bool) -> Turn | None:
        loss = self._loss(person)
        there = approach is None or (docks and approach.remaining_m < THERE_M)
        if loss is None or (approach is self._looked_on and not there):
            return None
        if approach is not None:
            approach.restart_watch(self._clock.now_s)
        heading = self._look_round.heading(loss, base)
        if heading is not None:
            return heading, MotionProgress("running", f"looking round for {person}")
        if not there:
            self._looked_on = approach
            return None
        self._given_up = loss
        return base.pose.heading_rad, blocked(how_lost(loss))

    def _glance(self, approach: Approach, base: Base) -> Turn | None:
        if approach is self._glanced_on:
            return None
        if self._senses.sees(approach.person):
            if self._glances:
                self._glanced_on, self._glances = approach, False
            return None
        now_s = self._clock.now_s
        heading = direction_to(base.xy, self._senses.person(approach.person).xy)
        if abs(wrap_angle(heading - base.pose.heading_rad)) > FACES_RAD:
            self._faces_s = now_s
        elif now_s - self._faces_s > self._sensor.delay_s + GLANCE_S:
            self._glanced_on = approach
        self._glances = approach is not self._glanced_on
        approach.restart_watch(now_s)
        return heading, MotionProgress("running", f"looking for {approach.person}")
