"""Base controller: the robot's motion goal, its heading, and its progress."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace
from functools import partial

from comity_fis.proxemics import PERSON_MARGIN_M
from comity_sim2d.avoidance.contact_recovery import ContactRecovery
from comity_sim2d.avoidance.leaving_margins import LeavingMargins
from comity_sim2d.avoidance.speed_governor import NO_LIMITS, SpeedGovernor
from comity_sim2d.base.base import Base, BaseControl, VelocityCommand
from comity_sim2d.base.differential import Differential
from comity_sim2d.base.omnidirectional import Omnidirectional
from comity_sim2d.base.physics import Physics, foresee
from comity_sim2d.clock import Clock
from comity_sim2d.navigation.docking import DockingPose, PoseBeside, docked, spot_beside
from comity_sim2d.navigation.past_people import without_people
from comity_sim2d.navigation.route_map import RouteMap
from comity_sim2d.people.said import Said
from comity_sim2d.pose import XY, Pose, Twist, direction_to, wrap_angle
from comity_sim2d.robot.approach import AT_PLACE, Approach, MovingTarget
from comity_sim2d.robot.looking import DRIVES_M_S, LOOK_M, gaze_rad
from comity_sim2d.robot.margins import Margins
from comity_sim2d.robot.motion import MotionProgress, blocked
from comity_sim2d.robot.obstructing_people import PathObstruction
from comity_sim2d.robot.progress import ApproachProgress
from comity_sim2d.robot.reduced_margin import least_margin_m
from comity_sim2d.robot.search import Search
from comity_sim2d.robot.standing import DetourMap, PassersByKnown
from comity_sim2d.robot.walkers_met import WalkersMet
from comity_sim2d.scene.obstacles import FloorPlan
from comity_sim2d.scene.robot_body import RobotBody
from comity_sim2d.scene_error import unknown
from comity_sim2d.senses.sensing import SensedPeople

DRIVES: dict[str, Callable[[RobotBody, float], BaseControl]] = {
    "omnidirectional": Omnidirectional,
    "differential": Differential,
}
HOLDS_M, HOLDS_RAD, HOLDS_FACING_DEG = 0.01, math.radians(3.0), 5.0
"""Tolerances [m, rad, deg] around the goal within which a robot has docked: the executor's `docked?` uses
them."""

WAITS_M = 0.05
"""Distance from the waiting place at which the robot stands and looks at the person [m] (our choice)."""


class BaseController:
    """Controller of one robot's base: takes motion goals, returns a velocity for every tick.

    Args:
        spec: The robot's body.
        physics: Its true pose.
        senses: Believed positions of people.
        clock: Simulated time.
        route_map: Its routes while no person moves.
        places: Poses for fetching things, by name of the place.
        said: What people say to it.
    """

    def __init__(
        self,
        spec: RobotBody,
        physics: Physics,
        senses: SensedPeople,
        clock: Clock,
        route_map: RouteMap,
        *,
        places: Mapping[str, Pose],
        said: Sequence[Said] = (),
    ) -> None:
        self._spec = spec
        self._physics = physics
        self._senses = senses
        self._clock = clock
        self._places = dict(places)
        self.standing = DetourMap(senses, clock, route_map)
        """Its routes around standing people."""
        self.margins = Margins(spec, senses, clock, said, least_margin_m(spec, clock.step_s))
        """The margin that it keeps from each person."""
        self.motion = MotionProgress("stopped")
        """Progress of the last command."""
        self._base: BaseControl = DRIVES[spec.drive](spec, clock.step_s)
        self._governor = SpeedGovernor(spec, senses)
        self._obstruction = PathObstruction(math.inf)
        self._search = Search(spec.sensor, senses, clock)
        self._walkers = WalkersMet(spec, senses, clock)
        self._progress = ApproachProgress(spec, physics, senses, clock)
        self._draw_back = ContactRecovery(physics.touches, spec.radius_m)
        self._leaving = LeavingMargins(spec)
        self._approach: Approach | None = None
        self._docks = False
        self._near_m_s: dict[str, float] = {}
        """The speed limit near the person it visits, by name [m/s]."""
        self._faced: str | None = None
        self._is_halted = False
        """Whether it is to stand until its next goal, even where it would give way to somebody."""

    def let_pass(self, passers_by: PassersByKnown) -> None:
        """Take passers-by into account: walking ones go first, routes lead round standing ones."""
        self._governor.let_pass(passers_by)
        self.standing.let_pass(passers_by)

    def note_asked(self, names: Collection[str]) -> None:
        """Note that the robot has asked these people to make way."""
        self.margins.note_asked(names)
        self._governor.note_asked(names)

    def find_way(self) -> tuple[XY, ...]:
        """The path that it would take if all but the visited person made way; empty where there is none."""
        goal = self.goal
        if goal is None or self._approach is None:
            return ()
        ways = without_people(self.standing.map.surroundings, (self._approach.person,))
        route = ways.route(self._physics.pose.xy, goal, keep=self._approach.keep)
        return () if route is None else route.points

    @property
    def goal(self) -> XY | None:
        """Goal position [m]; None without a goal."""
        if self._approach is None or self.motion.state == "succeeded":
            return None
        return self._goal_of(self._approach)[0].xy

    @property
    def remaining_m(self) -> float | None:
        """Length of the remaining path [m]; None without a goal or route."""
        approach = self._approach
        return approach.remaining_m if approach is not None and math.isfinite(approach.remaining_m) else None

    @property
    def is_held_up_on_its_way(self) -> bool:
        """Whether it is blocked although it has a route."""
        has_route = self._approach is None or self._approach.has_route
        return self.motion.is_blocked and has_route

    def navigate(
        self, person: str, pose: PoseBeside, *, speed_m_s: float, near_m_s: float, detour_m: float
    ) -> None:
        """Drive to a docking pose; succeeds when the remaining path is short."""
        self._mind_people(person, detour_m)
        self._near_m_s = {person: near_m_s}
        self._set_out(person, pose, speed_m_s, docks=False)

    def dock(self, person: str, pose: PoseBeside, *, speed_m_s: float) -> None:
        """Drive onto the docking pose, and hold it when the person moves."""
        self._near_m_s = {person: speed_m_s}
        self._set_out(person, pose, speed_m_s, docks=True)

    def learn_places(self, places: Mapping[str, Pose]) -> None:
        """Add poses for fetching things that were unreachable before; known ones stay."""
        self._places = {**places, **self._places}

    def go_to(self, place: str, *, speed_m_s: float, detour_m: float) -> None:
        """Drive to where an object is kept, and face it; obstructing people as for `navigate`.

        Raises:
            ValueError: If there is no such place.
        """
        if not isinstance(place, str) or place not in self._places:
            raise unknown("place as one to fetch from", place, self._places)
        self._approach = Approach(
            place, AT_PLACE, min(speed_m_s, self._spec.max_speed_m_s), since_s=self._clock.now_s
        )
        self._mind_people(place, detour_m)
        self._near_m_s = {}
        self._docks, self._faced, self._is_halted = True, None, False
        self.motion = MotionProgress("running", f"going to {place}")

    def face(self, person: str) -> None:
        """Stop and turn on the spot towards a person, and keep facing them."""
        self._approach, self._faced, self._is_halted = None, person, False
        self.motion = MotionProgress("running", f"turning to {person}")

    def _decline(self, person: str) -> None:
        """Stop: the visited person has declined."""
        self.stop()
        self.motion = MotionProgress("declined", self._walkers.declined[person])

    def stop(self) -> None:
        """Drop the goal, and stand; it still gives way to people who come."""
        self._approach, self._faced, self.motion = None, None, MotionProgress("stopped")

    def halt(self) -> None:
        """Drop the goal, and stand until the next one, whoever comes: the base is to come to rest."""
        self.stop()
        self._is_halted = True

    def expire(self, lease_s: float) -> None:
        """Drop the goal, as it was not renewed for the lease."""
        self.stop()
        self.motion = MotionProgress("aborted", f"it was not renewed for {lease_s:g} s")

    def look_for_another_way(self) -> None:
        """Plan the route again at the next tick: its constraints have changed."""
        if self._approach is not None:
            self._approach.forget_route()

    def use_plan(self, plan: FloorPlan) -> None:
        """Replace the static obstacles."""
        self.standing.use_plan(plan)

    def cut(self, why: str | None = None) -> Twist:
        """The velocity with the motors cut, 0 at once; a given reason ends the goal."""
        self._base.cut()
        if why is not None:
            self.stop()
            self.motion = MotionProgress("aborted", why, is_blocked=True)
        return Twist()

    def brake(self) -> Twist:
        """The velocity under an emergency stop: maximum deceleration; the goal ends."""
        self._foreseen()  # two-wheeled bases brake along their heading at that time
        self.stop()
        return self._base.brake()

    def stand_blind(self) -> Twist:
        """The velocity while its sensors fail: normal braking; the goal continues afterwards."""
        base = self._foreseen()
        if self._approach is not None:
            self._approach.restart_watch(self._clock.now_s)
        if self._approach is not None or self._faced is not None:
            self.motion = blocked("it sees nothing")
        return self._command(base, VelocityCommand((0.0, 0.0), base.pose.heading_rad))

    def go_on(self) -> Twist:
        """The velocity for the coming tick, towards its goal."""
        base = self._foreseen()
        drawn = self._draw_back.look(base, self._senses.present, self._plan)
        if drawn is not None:
            return self._get_away(*drawn, base)
        if (twist := self._search_command(base)) is not None:
            return twist
        if self._approach is not None:
            return self._approach_command(self._approach, base)
        heading = base.pose.heading_rad
        if self._faced is not None:
            heading = direction_to(base.xy, self._senses.person(self._faced).pose.xy)
            turn_rad = wrap_angle(heading - base.pose.heading_rad)
            self.motion = self._progress.of_facing(self._faced, turn_rad, base, self.motion)
        return self._command(base, VelocityCommand((0.0, 0.0), heading))

    def _get_away(self, touched: str, wanted: VelocityCommand, base: Base) -> Twist:
        """The velocity away from a touched person; the goal continues afterwards."""
        self.standing.touched(touched)
        if self._approach is not None:
            self._approach.restart_watch(self._clock.now_s)
        if self._approach is not None or self._faced is not None:
            self.motion = MotionProgress("running", f"drawing back from {touched}")
        return self._command(base, wanted, looks=False)

    def _leave_margins(self, approach: Approach, base: Base, ways: RouteMap, goal: XY) -> Twist | None:
        """The velocity out of the margins of people who stand, before it follows a route; None outside."""
        stays = self.motion.state == "succeeded" or self._governor.held_up_by is not None
        people = () if stays else self.standing.standing_people()
        left = self._leaving.look(base, people, partial(ways.way_out, goal=goal))
        if left is None:
            return None
        approach.forget_route()
        approach.restart_watch(self._clock.now_s)
        self.motion = MotionProgress("running", f"drawing back from {left[0]}")
        return self._command(base, left[1], visited=approach.person)

    def _search_command(self, base: Base) -> Twist | None:
        """The velocity while looking for the approached or faced person; None if the goal continues."""
        approach = self._approach
        sought = self._faced if approach is None else approach.person
        if sought is None or (approach is not None and approach.pose is AT_PLACE):
            return None
        turn = self._search.turn(sought, approach, base, docks=self._docks)
        if turn is None:
            return None
        heading, self.motion = turn
        return self._command(base, VelocityCommand((0.0, 0.0), heading))

    def in_vain(self, person: str) -> str | None:
        """Since when a person has been lost whom it did not find at their last place, in words; else None."""
        return self._search.in_vain(person, self._physics.pose.xy)

    def _foreseen(self) -> Base:
        """State of the base when the command takes effect."""
        return self._base.base(foresee(self._physics.pose, self._physics.twist, self._physics.step_s))

    def _body(self, base: Base) -> Base:
        """The same state from the motion of its body, which matters for braking with slow dynamics."""
        if not base.lag_s:
            return base
        twist = self._physics.twist
        pose = foresee(self._physics.pose, twist, self._physics.step_s)
        return base._replace(pose=pose, velocity=twist.xy)

    def _mind_people(self, to: str, detour_m: float) -> None:
        """Search for obstructing people; the same goal again, as after a bump, keeps the known ones."""
        if (self._obstruction.to, self._obstruction.detour_m) != (to, detour_m):
            self._obstruction = PathObstruction(detour_m, to)

    def _set_out(self, person: str, pose: PoseBeside, speed_m_s: float, *, docks: bool) -> None:
        self._is_halted = False
        if person in self._walkers.declined:
            self._decline(person)
            return
        speed = min(speed_m_s, self._spec.max_speed_m_s)
        going, goal = self._approach, DockingPose(pose.distance_m, pose.bearing_deg)
        if going is not None and going.person == person and docks == self._docks:
            drives = self._physics.twist.speed_m_s > DRIVES_M_S
            self._approach = going.told(goal, speed, since_s=self._clock.now_s if drives else None)
            if self.motion.is_blocked:
                return  # what blocked it may still block it
        else:
            holds = docks and self._is_docked(person, goal)
            self._approach = Approach(person, goal, speed, since_s=self._clock.now_s, settled=holds)
        self._docks, self._faced = docks, None
        self.motion = MotionProgress("running", f"{'docking' if docks else 'going'} to {person}")

    def _is_docked(self, person: str, pose: DockingPose) -> bool:
        """Whether it rests at a docking pose and faces the person, so that the goal is to hold it."""
        stands = docked(self._physics.pose, self._spec.radius_m, self._senses.person(person))
        return (
            abs(stands.distance_m - pose.distance_m) <= HOLDS_M
            and abs(wrap_angle(math.radians(stands.bearing_deg - pose.bearing_deg))) <= HOLDS_RAD
            and stands.facing_error_deg <= HOLDS_FACING_DEG
            and self._physics.twist.speed_m_s <= DRIVES_M_S
        )

    def _approach_command(self, approach: Approach, base: Base) -> Twist:
        person, distance_m = approach.person, approach.pose.distance_m
        if approach.pose is not AT_PLACE:
            waits_at = self._walkers.look(person, distance_m, base.pose, self.standing.map)
            if person in self._walkers.declined:
                self._decline(person)
                return self._command(base, VelocityCommand((0.0, 0.0), base.pose.heading_rad))
            if waits_at is not None:
                return self._wait_command(approach, base, waits_at)
        keeps_all = partial(self._keeps_all, approach, base.xy)
        self.margins.look(base.xy, approach.person, self.motion.blocked_by, keeps_all)
        waits = not approach.has_route or self._obstruction.now is not None
        waits_for = [*self._obstruction.people]
        if approach.gives_way_to:
            waits_for.append(approach.gives_way_to)
        ways = self.standing.look(approach.person, waits_for, lets_by=self._governor.held_up_by, waits=waits)
        goal, seen = self._goal_of(approach)
        if (twist := self._leave_margins(approach, base, ways, goal.xy)) is not None:
            return twist
        if self._governor.backs_out_before is None:
            velocity = self._steer(approach, base, goal, ways)
        else:  # no route to follow until it moves on
            approach.forget_route()
            velocity = (0.0, 0.0)
        heading = gaze_rad(approach, base, seen, self._obstruction.people, self._senses)
        self.motion = self._progress.of(
            approach,
            goal,
            wrap_angle(heading - base.pose.heading_rad),
            held_up_by=self._obstruction.now,
            docks=self._docks,
            was=self.motion,
            plan=self._plan,
        )
        wanted = VelocityCommand(velocity, heading, may_reverse=approach.may_reverse)
        return self._command(base, wanted, visited=approach.person)

    def _keeps_all(self, approach: Approach, here: XY) -> bool:
        """Whether a route of any length keeps the full margin from all people on the map."""
        ways = self.standing.map
        people = tuple(replace(one, margin_m=PERSON_MARGIN_M) for one in ways.surroundings.people)
        return ways.with_people(people).reaches(here, self._goal_of(approach)[0].xy, keep=approach.keep)

    def _wait_command(self, approach: Approach, base: Base, place: XY) -> Twist:
        """The velocity to the place where the robot waits for a walking person; there it faces them."""
        person = self._senses.person(approach.person)
        ways = self.standing.look("", (), lets_by=self._governor.held_up_by, waits=False)
        if (twist := self._leave_margins(approach, base, ways, place)) is not None:
            return twist
        heading, velocity = direction_to(base.xy, person.xy), (0.0, 0.0)
        if self._governor.backs_out_before is None and math.dist(base.xy, place) > WAITS_M:
            velocity = approach.steer(base, MovingTarget(place, (0.0, 0.0)), ways, self.standing.movers(""))
            heading = gaze_rad(approach, base, person.xy, (), self._senses)
        else:
            approach.forget_route()
        approach.restart_watch(self._clock.now_s)
        self.motion = MotionProgress("running", f"waiting for {person.name}, who walks, beside their path")
        return self._command(
            base, VelocityCommand(velocity, heading, may_reverse=approach.may_reverse), waits=True
        )

    def _steer(self, approach: Approach, base: Base, goal: MovingTarget, ways: RouteMap) -> XY:
        """The velocity along the route to the goal, or to the waiting place [m/s]."""
        # for the pose of the body once it has caught up
        led = MovingTarget(_later(goal, base.lag_s), goal.velocity)
        xy = self._obstruction.look(ways, base.xy, led.xy, approach, self._clock.now_s)
        now = MovingTarget(xy, (0.0, 0.0)) if self._obstruction.now else led
        return approach.steer(base, now, ways, self.standing.movers(approach.person))

    def _goal_of(self, approach: Approach) -> tuple[MovingTarget, XY]:
        """The target, and the point to look at on the last stretch."""
        if approach.pose is AT_PLACE:
            at = self._places[approach.person]
            return MovingTarget(at.xy, (0.0, 0.0)), at.ahead(LOOK_M)
        person = self._senses.person(approach.person)
        spot = spot_beside(person, self._spec.radius_m, approach.pose)
        return MovingTarget(spot, self._senses.velocity_beside(approach.person, spot)), person.xy

    @property
    def _plan(self) -> FloorPlan:
        """The static obstacles."""
        return self.standing.map.surroundings.plan

    def _command(
        self,
        base: Base,
        wanted: VelocityCommand,
        *,
        visited: str | None = None,
        looks: bool = True,
        waits: bool = False,
    ) -> Twist:
        plan = self._plan
        body = self._body(base)
        if self._governor.is_late(base, body, plan):
            return self._base.brake_before_things(body)
        going = self._approach
        approached = going.person if going is not None and going.has_route and not waits else None
        under_way_to = None if self.motion.state == "succeeded" else visited
        allowed, most_m_s = self._governor.allowed(
            base,
            wanted,
            plan,
            visited=under_way_to,
            approached=approached,
            movers=self.standing.movers(visited or ""),
            stand=self._obstruction.people,
            looks=looks,
            gives_way=not self._is_halted,
            stays=self._is_halted or self._faced is not None or self.motion.state == "succeeded",
            near_m_s=self._near_m_s if going is not None else NO_LIMITS,
        )
        if going is not None:
            self._tell_restraint(going, looks=looks)
        return self._base.command(base, allowed, most_m_s)

    def _tell_restraint(self, going: Approach, *, looks: bool) -> None:
        """Report a safety behaviour that delays the goal; this does not count as standstill."""
        if (before := self._governor.backs_out_before) is not None:
            self.motion = MotionProgress("running", f"backing out before {before}")
        elif (comer := self._governor.held_up_by) is not None:
            self.motion = MotionProgress("running", f"giving way to {comer}")
        elif not (looks and self._governor.looks_first):
            return
        elif self.motion.state == "running" and not self.motion.is_blocked:
            self.motion = MotionProgress("running", "looking at where it goes before it goes there")
        going.restart_watch(self._clock.now_s)


def _later(goal: MovingTarget, time_s: float) -> XY:
    return (goal.xy[0] + goal.velocity[0] * time_s, goal.xy[1] + goal.velocity[1] * time_s)
