"""The robot in the world: commands in, motion and acts out. It has the form of the executor's `Robot`."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType

from comity_fis.curve import Curve
from comity_fis.errors import closest
from comity_sim2d.acts import HAND_OVER, NORMAL, PICK_UP, ActEvent, Acts, Manner
from comity_sim2d.approach import Approach, Goal
from comity_sim2d.base import Base, BaseControl, Wanted
from comity_sim2d.bump_stop import BumpStop
from comity_sim2d.carrying import carried_at
from comity_sim2d.clock import Clock
from comity_sim2d.differential import Differential
from comity_sim2d.docking import DockingPose, PoseBeside, docked, spot_beside
from comity_sim2d.emergency import EmergencyStop
from comity_sim2d.in_the_way import ARRIVED_M, Hindrance
from comity_sim2d.motion import Motion, Reading
from comity_sim2d.obstacles import FloorPlan
from comity_sim2d.omnidirectional import Omnidirectional
from comity_sim2d.past_people import PastPeople
from comity_sim2d.physics import Physics, foresee
from comity_sim2d.pose import XY, Pose, Twist, direction_to, wrap_angle
from comity_sim2d.pose_choice import Wish, choose_pose
from comity_sim2d.restraint import Restraint
from comity_sim2d.right_of_way import PassersBySeen
from comity_sim2d.route_map import RouteMap
from comity_sim2d.said import Said
from comity_sim2d.scene import Person, RobotBody, find_person
from comity_sim2d.sensing import Senses
from comity_sim2d.troubles import BASE, SENSORS, VOICE, Troubles

DRIVES: dict[str, Callable[[RobotBody, float], BaseControl]] = {
    "omnidirectional": Omnidirectional,
    "differential": Differential,
}
CLOSE_M = 1.2
"""Navigation has arrived when so little of the way is left; docking does the rest, at the person's own
approach speed. Our choice: long enough for that speed to be felt, too short to crawl through a hall."""
LOOK_M = 1.5
"""On the last stretch of this length the robot looks at the person and not where it goes."""
REMAP_M = 0.02
"""The map of routes follows people who moved farther than this."""
DOCKED_M, DOCKED_RAD, DOCKED_M_S = 0.001, math.radians(0.5), 0.01
"""Docked: within these of the pose and of rest relative to it (noise of the sensors comes on top)."""
NOWHERE: Mapping[str, Pose] = MappingProxyType({})
AT_PLACE = DockingPose(0.0, 0.0)
"""In the place of a pose beside a person, where the robot goes to a place."""
DRIVES_M_S = 0.05
"""Slower, it is held up, or has not set out."""
LEFT_M = 0.02
"""A docked robot counts as moving again when its pose got so far away."""


class SimRobot:
    """The robot of a `World`."""

    def __init__(
        self,
        spec: RobotBody,
        physics: Physics,
        senses: Senses,
        clock: Clock,
        route_map: RouteMap,
        *,
        said: Sequence[Said] = (),
        places: Mapping[str, Pose] = NOWHERE,
        troubles: Troubles | None = None,
    ) -> None:
        self._spec = spec
        self._physics = physics
        self._senses = senses
        self._clock = clock
        self._map = route_map
        self._said = said
        self._places = places
        self._troubles = troubles or Troubles()
        self._acts = Acts(clock)
        self.emergency_stop = EmergencyStop()
        self._bump_stop = BumpStop(physics.touches, clock, self.emergency_stop)
        self._hindrance = Hindrance(math.inf)
        self._base: BaseControl = DRIVES[spec.drive](spec, clock.step_s)
        self._approach: Approach | None = None
        self._docks = False
        self._faced: str | None = None
        self._motion = Motion("idle")
        self._restraint = Restraint(spec, senses)

    def give_way_to(self, passers_by: PassersBySeen) -> None:
        """Let people pass, without planning for them."""
        self._restraint.let_pass(passers_by)

    @property
    def name(self) -> str:
        """As in the scene."""
        return self._spec.name

    @property
    def events(self) -> tuple[ActEvent, ...]:
        """All that was said and done, in order."""
        return self._acts.events

    @property
    def pose(self) -> Pose:
        """Where it is, in truth."""
        return self._physics.pose

    @property
    def people(self) -> tuple[Person, ...]:
        """Everybody where it believes them to be."""
        return self._senses.people

    def now_s(self) -> float:
        """Simulated time."""
        return self._clock.now_s

    def read(self, person: str) -> Reading | None:
        """What the robot knows about a person; None while its sensors do not see them.

        Raises:
            ValueError: Where there is no such person.
        """
        self._require(person)
        if self._senses.stamp_s is None or not self._senses.sees(person):
            return None
        stands = docked(self._physics.pose, self._spec.radius_m, self._senses.person(person))
        return Reading(
            distance_m=stands.distance_m,
            centre_distance_m=stands.centre_distance_m,
            bearing_deg=stands.bearing_deg,
            facing_error_deg=stands.facing_error_deg,
            person_facing_error_deg=abs(stands.bearing_deg),
            speed_m_s=self._physics.twist.speed_m_s,
            stamp_s=self._senses.stamp_s,
        )

    def heard(self, person: str) -> tuple[Said, ...]:
        """What a person has said to the robot, as far as it has understood it: ears lag as eyes do.

        Raises:
            ValueError: Where there is no such person.
        """
        self._require(person)
        latest_s = self._clock.now_s - self._spec.sensor.delay_s
        return tuple(words for words in self._said if words.person == person and words.t <= latest_s)

    def choose_pose(
        self,
        person: str,
        *,
        distance_m: float,
        bearing_deg: float,
        distance_desirability: Curve,
        direction_desirability: Curve,
    ) -> DockingPose | None:
        """The wanted pose if free and reachable, else the most desirable one that is, or None.

        Raises:
            ValueError: For a bearing beyond 90 degrees, a distance below 0.30 m or a person who is not there.
        """
        self._require(person)
        self._remap(0.0)
        wish = Wish(person, distance_m, bearing_deg, distance_desirability, direction_desirability)
        here = self._physics.pose.xy
        return choose_pose(self._map, here, wish) or choose_pose(
            PastPeople(self._map.surroundings, person), here, wish
        )

    def navigate(
        self, person: str, pose: PoseBeside, *, speed_m_s: float, detour_m: float = math.inf
    ) -> None:
        """Set out along the shortest route; `arrived` 1.2 m before the pose, onto which the robot glides.

        Where the way around people is longer by more than `detour_m`, or there is none, the robot comes up to
        the one in the way, and is blocked by them.
        """
        self._hindrance = Hindrance(detour_m)
        self._set_out(person, pose, speed_m_s, docks=False)

    def dock(self, person: str, pose: PoseBeside, *, speed_m_s: float) -> None:
        """Go onto the pose, and hold it wherever the person moves, until another command."""
        self._set_out(person, pose, speed_m_s, docks=True)

    def go_to(self, place: str, *, speed_m_s: float, detour_m: float = math.inf) -> None:
        """Go where something is kept, and turn to it; people in the way as for `navigate`.

        Raises:
            ValueError: Where there is no such place.
        """
        if place not in self._places:
            raise ValueError(f"no place {place!r} to fetch from. {closest(place, self._places)}")
        self._approach = Approach(
            place, AT_PLACE, min(speed_m_s, self._spec.max_speed_m_s), since_s=self._clock.now_s
        )
        self._hindrance = Hindrance(detour_m)
        self._docks, self._faced = True, None
        self._motion = Motion("moving", f"going to {place}")

    def pick_up(self, thing: str, place: str) -> None:
        """Begin to take something up."""
        self._acts.start(PICK_UP, place, None, thing=thing)

    def hand_over(self, thing: str, person: str, *, manner: Manner = NORMAL) -> None:
        """Begin to hand over what is in the hands."""
        self._require(person)
        self._acts.start(HAND_OVER, person, None, manner, thing=thing)

    def carried(self) -> str | None:
        """What it took up and has not handed over."""
        return carried_at(self._acts.events, self._clock.now_s)

    def face(self, person: str) -> None:
        """Stop and turn on the spot towards a person, and keep facing them."""
        self._require(person)
        self._approach, self._faced, self._motion = None, person, Motion("moving", f"turning to {person}")

    def stop(self) -> None:
        """Brake as hard as the base may, and stand."""
        self._approach, self._faced, self._motion = None, None, Motion("idle")

    def motion(self) -> Motion:
        """How the last motion command goes."""
        return self._motion

    def trouble(self, part: str) -> str | None:
        """What is wrong with a part of it, the way or a person; None where nothing is."""
        return self._troubles.of(part)

    def emergency(self) -> str | None:
        """Why the emergency stop is pressed; None while it is not."""
        return self.emergency_stop.reason

    def start_act(self, act: str, person: str, text: str | None = None, *, manner: Manner = NORMAL) -> None:
        """Begin to speak or gesture to a person."""
        self._require(person)
        self._acts.start(act, person, text, manner)
        if self._troubles.of(VOICE):
            self._acts.fall_silent()

    def act_done(self, act: str, person: str) -> bool | None:
        """None: never begun, or broken off. False: it runs. True: it is over."""
        return self._acts.done(act, person)

    def stop_act(self, act: str, person: str) -> None:
        """Break an act off, if it runs."""
        self._acts.stop(act, person)

    def use_plan(self, plan: FloorPlan) -> None:
        """Know another floor plan from now on: a door was shut or opened, which the robot learns at once."""
        self._map = RouteMap(replace(self._map.surroundings, plan=plan))
        self._senses.use_plan(plan)

    def feel(self) -> None:
        """Press the emergency stop where something was touched, and fall silent where the voice fails.

        Called by the world after every tick.
        """
        self._bump_stop.feel()
        if self._troubles.of(VOICE):
            self._acts.fall_silent()

    def control(self) -> Twist:
        """The command for the coming tick: called by the world."""
        twist = self._commanded()
        if self._troubles.of(BASE):
            self._base.cut()
            return Twist()
        return twist

    def _commanded(self) -> Twist:
        if (bump := self._bump_stop.reason) is not None:
            self._base.cut()
            self.stop()
            self._motion = Motion("blocked", bump)
            return Twist()
        base = self._base.base(foresee(self._physics.pose, self._physics.twist, self._physics.step_s))
        if self.emergency_stop.reason is not None:
            self.stop()
            return self._base.brake()
        if (blind := self._troubles.of(SENSORS)) is not None:
            return self._stand_blind(blind, base)
        if self._approach is not None:
            return self._approach_command(self._approach, base)
        heading = base.pose.heading_rad
        if self._faced is not None:
            heading = direction_to(base.xy, self._senses.person(self._faced).pose.xy)
            self._report_facing(wrap_angle(heading - base.pose.heading_rad), base)
        return self._command(base, Wanted((0.0, 0.0), heading))

    def _stand_blind(self, why: str, base: Base) -> Twist:
        """Brake, and say why, until the robot sees again; what it was told to do then goes on."""
        if self._approach is not None:
            self._approach.restart_watch(self._clock.now_s)
        if self._approach is not None or self._faced is not None:
            self._motion = Motion("blocked", "it sees nothing")
        return self._command(base, Wanted((0.0, 0.0), base.pose.heading_rad))

    @property
    def goal(self) -> XY | None:
        """Where it is under way to; None where it is not."""
        if self._approach is None or self._motion.state == "arrived":
            return None
        return self._goal_of(self._approach)[0].xy

    def _set_out(self, person: str, pose: PoseBeside, speed_m_s: float, *, docks: bool) -> None:
        self._require(person)
        if not (math.isfinite(speed_m_s) and speed_m_s > 0.0):
            raise ValueError(f"the speed must be positive, not {speed_m_s}")
        speed = min(speed_m_s, self._spec.max_speed_m_s)
        going, goal = self._approach, DockingPose(pose.distance_m, pose.bearing_deg)
        if going is not None and going.person == person and docks == self._docks:
            drives = self._physics.twist.speed_m_s > DRIVES_M_S
            self._approach = going.told(goal, speed, since_s=self._clock.now_s if drives else None)
            if self._motion.state == "blocked":
                return  # what held it up may hold it up still
        elif going is not None and going.person == person and going.pose == goal:
            going.speed_m_s = speed  # the same way, for another purpose: the route stands
            going.restart_watch(self._clock.now_s)
        else:
            self._approach = Approach(person, goal, speed, since_s=self._clock.now_s)
        self._docks, self._faced = docks, None
        self._motion = Motion("moving", f"{'docking' if docks else 'going'} to {person}")

    def _approach_command(self, approach: Approach, base: Base) -> Twist:
        waits = not approach.has_route or self._hindrance.now is not None
        self._remap(REMAP_M + (0.0 if waits else 3.0 * self._senses.noise_m))  # it may be noise that waits
        goal, seen = self._goal_of(approach)
        led = Goal(_later(goal, base.lag_s), goal.velocity)  # for where the body is when it has caught up
        now = self._goal_for_now(approach, base, led)
        velocity = approach.steer(base, now, self._map, self._restraint.walkers(approach.person))
        near = approach.remaining_m < LOOK_M
        heading = direction_to(base.xy, seen if near or base.speed_m_s < DRIVES_M_S else _ahead(base))
        # A base that turns to go would turn to and fro: to the person while it waits, and back to its way.
        looks = near and not base.turns_to_go
        if not approach.has_route or (approach.gives_way_to and not looks):
            heading = base.pose.heading_rad
        self._report(approach, goal, base, wrap_angle(heading - base.pose.heading_rad))
        return self._command(base, Wanted(velocity, heading, may_reverse=approach.may_reverse))

    def _goal_of(self, approach: Approach) -> tuple[Goal, XY]:
        """Where to, and what to look at on the last stretch."""
        if approach.pose is AT_PLACE:
            at = self._places[approach.person]
            return Goal(at.xy, (0.0, 0.0)), at.ahead(LOOK_M)
        person = self._senses.person(approach.person)
        spot = spot_beside(person, self._spec.radius_m, approach.pose)
        return Goal(spot, self._velocity_beside(approach.person, person.xy, spot)), person.xy

    def _goal_for_now(self, approach: Approach, base: Base, goal: Goal) -> Goal:
        """The goal, or the place to wait at where somebody is in the way to it."""
        xy = self._hindrance.look(self._map, base.xy, goal.xy, approach)
        return Goal(xy, (0.0, 0.0)) if self._hindrance.now else goal

    def _command(self, base: Base, wanted: Wanted) -> Twist:
        plan = self._map.surroundings.plan
        if self._restraint.is_late(base, plan):
            return self._base.brake()
        allowed, most_m_s = self._restraint.allowed(base, wanted, plan)
        return self._base.command(base, allowed, most_m_s)

    def _velocity_beside(self, person: str, at: XY, spot: XY) -> XY:
        """How the pose beside a person moves when the person walks and turns."""
        (vx, vy), turn = self._senses.velocity(person)
        return (vx - turn * (spot[1] - at[1]), vy + turn * (spot[0] - at[0]))

    def _report(self, approach: Approach, goal: Goal, base: Base, turn_rad: float) -> None:
        if (hindrance := self._hindrance.now) is not None:
            approach.restart_watch(self._clock.now_s)
            waits = not approach.has_route or approach.remaining_m <= ARRIVED_M
            text = f"{hindrance.person} is in the way to {approach.person}"
            self._motion = Motion("blocked", text, hindrance.person) if waits else Motion("moving", text)
        elif not approach.has_route and approach.pose is AT_PLACE:
            self._motion = Motion("blocked", f"no route to {approach.person}")
        elif not approach.has_route:
            pose = approach.pose
            text = f"no route to {pose.distance_m:.2f} m from {approach.person} at {pose.bearing_deg:.0f} deg"
            self._motion = Motion("blocked", text)
        elif self._is_there(approach, goal, base, turn_rad):
            approach.restart_watch(self._clock.now_s)
            self._motion = Motion("arrived", f"{'docked' if self._docks else 'close'} to {approach.person}")
        elif approach.gives_way_to and not approach.stalled(self._clock.now_s, approach.remaining_m):
            self._motion = Motion("moving", f"giving way to {approach.gives_way_to}")
        elif approach.stalled(self._clock.now_s, approach.remaining_m + 0.1 * abs(turn_rad)):
            self._motion = Motion("blocked", f"no progress towards {approach.person} for 3 s")
        else:
            self._motion = Motion("moving", f"{approach.remaining_m:.2f} m to {approach.person}")

    def _is_there(self, approach: Approach, goal: Goal, base: Base, turn_rad: float) -> bool:
        if not self._docks:
            return approach.remaining_m <= CLOSE_M
        body = foresee(self._physics.pose, self._physics.twist, self._physics.step_s)
        gap = math.dist(body.xy, goal.xy)
        if self._motion.state == "arrived":
            return gap <= LEFT_M + self._senses.noise_m
        drift = math.dist(self._physics.twist.xy, goal.velocity)
        noise = 0.3 * self._senses.noise_m
        return (
            (approach.settled or gap <= DOCKED_M + noise)
            and abs(turn_rad) <= DOCKED_RAD + noise
            and drift <= DOCKED_M_S + noise
        )

    def _report_facing(self, turn_rad: float, base: Base) -> None:
        there = abs(turn_rad) <= DOCKED_RAD and base.speed_m_s <= DOCKED_M_S
        if there:
            self._motion = Motion("arrived", f"facing {self._faced}")

    def _remap(self, tolerance_m: float) -> None:
        """Renew the map of routes where people are not where it has them."""
        believed, mapped = self._senses.people, self._map.surroundings.people
        if believed is mapped:
            return
        pairs = list(zip(believed, mapped, strict=True))
        moved = any(math.dist(one.xy, other.xy) > tolerance_m for one, other in pairs)
        if moved or any(one.heading_rad != other.heading_rad for one, other in pairs):
            self._map = RouteMap(self._map.surroundings.with_people(believed))

    def _require(self, person: str) -> None:
        find_person(self._map.surroundings.people, person)


def _later(goal: Goal, time_s: float) -> XY:
    return (goal.xy[0] + goal.velocity[0] * time_s, goal.xy[1] + goal.velocity[1] * time_s)


def _ahead(base: Base) -> XY:
    return (base.xy[0] + base.velocity[0], base.xy[1] + base.velocity[1])
