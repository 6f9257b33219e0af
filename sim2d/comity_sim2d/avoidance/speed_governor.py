"""Speed governor over every command: slow near people, no push towards them, right of way for them."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping, Sequence
from types import MappingProxyType

import numpy as np

from comity_fis.proxemics import PERSON_MARGIN_M
from comity_sim2d.avoidance.backing_out import BackingOut
from comity_sim2d.avoidance.emergency_braking import EmergencyBraking
from comity_sim2d.avoidance.look_before_moving import LookBeforeMoving
from comity_sim2d.avoidance.making_room import make_room
from comity_sim2d.avoidance.oncoming import Oncoming
from comity_sim2d.avoidance.right_of_way import PassersBySeen, yield_to
from comity_sim2d.avoidance.stepping_aside import SteppingAside
from comity_sim2d.base.base import Base, VelocityCommand
from comity_sim2d.base.drive import (
    KEEP_OFF_M,
    REDUCED_M_S,
    SPEED_SHARE,
    keep_off_people,
    limit_speed,
    speed_near_people,
    speed_within_sight,
    stopping_speed,
)
from comity_sim2d.navigation.yielding import Walker
from comity_sim2d.pose import XY, direction_to
from comity_sim2d.scene.obstacles import FloorPlan
from comity_sim2d.scene.person import Person
from comity_sim2d.scene.robot_body import RobotBody
from comity_sim2d.senses.sensing import SensedPeople

TOUCHING_M, DRIFT_M_S = 0.05, 0.05
"""The robot brakes as hard as it can rather than come within `TOUCHING_M` [m] of a person faster than
`DRIFT_M_S` [m/s] (our choice: a third of the gap that it keeps by itself)."""
UNSURE = 2.0
"""Number of the sensor's standard deviations by which a walking person may be nearer."""
NO_LIMITS: Mapping[str, float] = MappingProxyType({})


class SpeedGovernor:
    """Speed limits that always apply, given what one robot knows of the people around it.

    Args:
        spec: The robot's body.
        senses: Believed positions of people.
    """

    def __init__(self, spec: RobotBody, senses: SensedPeople) -> None:
        self._spec = spec
        self._senses = senses
        self._passers_by: PassersBySeen | None = None
        self._oncoming = Oncoming(spec.radius_m, senses)
        self._backing_out = BackingOut(spec.radius_m, self._oncoming)
        self._reach_m = np.empty(0)
        """Distance between the robot's and each person's centre when the bodies touch [m]."""
        self._clear_m = spec.sensor.range_m - spec.radius_m - KEEP_OFF_M
        """Gap between the bodies when a person comes into view, less the gap that the robot keeps [m]."""
        self._emergency_braking = EmergencyBraking(spec)
        self._stepping_aside = SteppingAside(spec.radius_m)
        self._look_first = None if senses.sees_all_round else LookBeforeMoving(spec, senses)

    def let_pass(self, passers_by: PassersBySeen) -> None:
        """Take passers-by into account, who are in no plan."""
        self._passers_by = passers_by
        self._backing_out.let_pass(passers_by)
        self._reach_m = passers_by.radius_m + self._spec.radius_m

    def note_asked(self, names: Collection[str]) -> None:
        """Note that the robot has asked these people to let it pass: they make way for a while."""
        self._oncoming.note_asked(names)

    def allowed(
        self,
        base: Base,
        wanted: VelocityCommand,
        plan: FloorPlan,
        *,
        visited: str | None = None,
        approached: str | None = None,
        movers: Sequence[Walker] = (),
        stand: Collection[str] = (),
        looks: bool = True,
        gives_way: bool = True,
        stays: bool = False,
        near_m_s: Mapping[str, float] = NO_LIMITS,
    ) -> tuple[VelocityCommand, float]:
        """The allowed part of the velocity command, and the speed limit here [m/s].

        Args:
            base: Current motion of the robot's base.
            wanted: The velocity command.
            plan: The static obstacles around it.
            visited: The person or place the robot is going to; None if it is going nowhere.
            approached: The same if there is a route; else None.
            movers: People that its route does not lead around, except the visited person.
            stand: People who block its path and are to be asked to make way.
            looks: Whether it looks before moving, if its sensor does not cover all directions.
            gives_way: Whether it leaves its place for people who come; else it stands there.
            stays: Whether it is with the person it visits: it does not back out of anybody's way.
            near_m_s: Speed limits near the people it visits, by name, in addition to what they asked for.
        """
        braking, people = SPEED_SHARE * base.acceleration_m_s2, self._senses.present
        ahead_s = base.step_s + base.lag_s
        xy, radius_m = base.xy, self._spec.radius_m
        near = speed_near_people(
            xy,
            base.speed_m_s,
            radius_m,
            people,
            braking=braking,
            step_s=ahead_s,
            most_m_s=self._most_near(near_m_s),
        )
        seen = speed_within_sight(self._clear_m, blind_s=ahead_s + self._spec.sensor.delay_s, braking=braking)
        self._oncoming.look(base)
        roomy = self._with_room(base, wanted, plan, visited, approached) if gives_way else wanted
        kept_off = keep_off_people(
            xy,
            roomy.velocity,
            radius_m,
            people,
            braking=braking,
            step_s=base.step_s,
            keep_m=self._gap_to_keep(None if roomy is not wanted else visited),
        )
        most_m_s = min(near, seen, self._spec.max_speed_m_s)
        velocity = self._yielding(base, limit_speed(kept_off, most_m_s), movers, braking)
        if not stays:
            self._backing_out.note(base, velocity, plan, to=visited or "", stand=stand)
        heading = roomy.heading_rad
        if velocity == (0.0, 0.0) != roomy.velocity and base.turns_to_go and not roomy.may_reverse:
            heading = direction_to((0.0, 0.0), roomy.velocity)  # while others pass it turns to where it goes
        left = VelocityCommand(velocity, heading, roomy.may_reverse)
        left = self._emergency_braking.turned(base, left, plan)
        if looks and self._look_first is not None:
            left = self._look_first.allowed(base, left, plan)
        return left, most_m_s

    def _most_near(self, visited_m_s: Mapping[str, float]) -> Callable[[Person], float]:
        """The speed limit near each person: what they asked for, and what suits those who are visited.

        A walking person's own speed is added: the robot could never catch up with them otherwise.
        """
        walks_m_s = {each.person.name: math.hypot(*each.velocity) for each in self._senses.walkers}

        def most_m_s(person: Person) -> float:
            if person.margin_m < PERSON_MARGIN_M:
                return REDUCED_M_S
            asked = math.inf if person.approach_speed_m_s is None else person.approach_speed_m_s
            limit = min(asked, visited_m_s.get(person.name, math.inf))
            return limit + walks_m_s.get(person.name, 0.0)

        return most_m_s

    def _gap_to_keep(self, visited: str | None) -> Callable[[Person], float]:
        """The gap that the robot keeps to each person [m]: the margin of those who stand, except the visited.

        Routes keep these margins by themselves; giving way, or beside a person who walks, the robot has none.
        """
        walking = {walker.person.name for walker in self._senses.walkers}

        def keep_m(person: Person) -> float:
            return KEEP_OFF_M if person.name == visited or person.name in walking else person.margin_m

        return keep_m

    @property
    def backs_out_before(self) -> str | None:
        """The person for whom the robot backs out of a narrow place, or waits until they have passed."""
        return self._backing_out.before

    @property
    def held_up_by(self) -> str | None:
        """The person for whom it will back out if they do not move elsewhere."""
        return self._backing_out.held_up_by

    @property
    def looks_first(self) -> bool:
        """Whether the robot looks at its path before it goes there."""
        return self._look_first is not None and self._look_first.looks

    def is_late(self, base: Base, body: Base, plan: FloorPlan) -> bool:
        """Whether usual braking would touch a person in its path, or harder braking a thing.

        Args:
            base: Where its commands will have taken it.
            body: Current pose and motion of the body, from which it brakes.
            plan: The static obstacles around it.
        """
        if self._is_late_for_people(base) or self._emergency_braking.has_come(body, plan):
            return True
        if self._is_late_for_walkers(body):
            return True
        passers_by = self._passers_by
        return passers_by is not None and self._emergency_braking.has_come_before(
            body, passers_by.at, self._reach_m
        )

    def _is_late_for_people(self, base: Base) -> bool:
        braking = SPEED_SHARE * base.acceleration_m_s2
        (x, y), (vx, vy) = base.xy, base.velocity
        walking = {walker.person.name for walker in self._senses.walkers}
        for person in self._senses.present:
            apart = math.dist((x, y), person.xy)
            if not apart:
                continue
            closing = (vx * (person.x_m - x) + vy * (person.y_m - y)) / apart
            if closing <= DRIFT_M_S:
                continue
            # The stopping point is predicted; a walking person comes nearer until the body has caught up with
            # its commands.
            walks = person.name in walking
            behind_s = base.step_s + (base.lag_s if walks else 0.0)
            free_m = apart - person.radius_m - self._spec.radius_m - TOUCHING_M - closing * behind_s
            is_fast = closing > stopping_speed(max(free_m, 0.0), braking, base.step_s)
            if is_fast and (walks or not self._stops_beside(base, person, braking)):
                return True
        return False

    def _is_late_for_walkers(self, body: Base) -> bool:
        """Whether braking as hard as it can would bring it to where a walking person may be.

        The robot may pass or leave a walking person inside the margin, and they may overtake it and turn in.
        So its body counts here, not its commands, and a person may be two standard deviations of the sensor
        nearer than believed.
        """
        walkers = self._senses.walkers
        if not walkers:
            return False
        at = np.array([complex(*each.person.xy) for each in walkers])
        beside_m = self._spec.radius_m + TOUCHING_M + UNSURE * self._spec.sensor.sigma_m
        reach_m = np.array([each.person.radius_m + beside_m for each in walkers])
        return self._emergency_braking.has_come_before(body, at, reach_m)

    def _stops_beside(self, base: Base, person: Person, braking: float) -> bool:
        """Whether the robot, braking on its line, passes a person at its side."""
        (x, y), (vx, vy), speed = base.xy, base.velocity, base.speed_m_s
        way_m = speed * (base.step_s + speed / (2.0 * braking))
        ahead_m = ((person.x_m - x) * vx + (person.y_m - y) * vy) / speed
        share = min(max(ahead_m, 0.0), way_m) / speed
        gap_m = person.gap_m((x + share * vx, y + share * vy), self._spec.radius_m)
        return gap_m > KEEP_OFF_M

    def _with_room(
        self,
        base: Base,
        wanted: VelocityCommand,
        plan: FloorPlan,
        visited: str | None,
        approached: str | None,
    ) -> VelocityCommand:
        """Back out of a narrow place, step aside for an approaching person, or back off from them."""
        back = self._backing_out.velocity(base, plan, visited=visited)
        if back is not None:
            wanted = wanted._replace(velocity=back, may_reverse=True)
            if back != (0.0, 0.0):
                return wanted
        walkers, people, radius_m = self._senses.walkers, self._senses.people, self._spec.radius_m
        made = self._stepping_aside.velocity(base, wanted, walkers, people, plan, approached=approached)
        if made is None:
            braking = SPEED_SHARE * base.acceleration_m_s2
            made = make_room(base.xy, wanted.velocity, radius_m, walkers, plan, braking=braking)
        return wanted if made == wanted.velocity else wanted._replace(velocity=made, may_reverse=True)

    def _yielding(self, base: Base, velocity: XY, movers: Sequence[Walker], braking: float) -> XY:
        """Stop before people who move, and let them go first."""
        ahead_m = base.speed_m_s * (base.step_s + base.lag_s)
        at = np.array([complex(*mover.person.xy) for mover in movers], dtype=complex)
        reach_m = np.array([mover.person.radius_m + self._spec.radius_m for mover in movers])
        if self._passers_by is not None:
            velocity = yield_to(
                velocity,
                base.xy,
                self._passers_by.at,
                self._reach_m,
                braking=braking,
                ahead_m=ahead_m,
            )
        return yield_to(velocity, base.xy, at, reach_m, braking=braking, ahead_m=ahead_m, stands_beside=True)
