"""The robot in the world: commands in, motion and acts out; implements the executor's `Robot` protocol."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

from comity_fis.defuzzification.curve import Curve
from comity_fis.errors import WrongValueError
from comity_sim2d.base.bump_stop import BumpStop
from comity_sim2d.base.drive import mean_braking
from comity_sim2d.base.emergency import EmergencyStop
from comity_sim2d.base.physics import Physics
from comity_sim2d.clock import Clock
from comity_sim2d.kinds import require_each, require_kinds
from comity_sim2d.navigation.docking import DockingPose, PoseBeside, docked
from comity_sim2d.navigation.past_people import PastPeople
from comity_sim2d.navigation.pose_choice import Wish, choose_pose
from comity_sim2d.navigation.route_map import RouteMap
from comity_sim2d.people.said import Said
from comity_sim2d.pose import XY, Pose, Twist
from comity_sim2d.robot.acts import ASK_TO_PASS, HAND_OVER, PICK_UP, ActEvent, ActProgress, ActRequest, Acts
from comity_sim2d.robot.base_controller import BaseController
from comity_sim2d.robot.carrying import carried_at
from comity_sim2d.robot.lease import LEASE_S, Lease
from comity_sim2d.robot.margins import MarginDecision
from comity_sim2d.robot.motion import BaseCapabilities, MotionProgress, MotionRequest, PersonEstimate
from comity_sim2d.robot.walkers_met import goes_along, pose_at_side
from comity_sim2d.scene.obstacles import FloorPlan
from comity_sim2d.scene.person import Person, find_person
from comity_sim2d.scene.robot_body import RobotBody
from comity_sim2d.scene_error import is_number, require_text, shown
from comity_sim2d.senses import active_faults
from comity_sim2d.senses.active_faults import BASE, PATH, SENSORS, VOICE, ActiveFaults
from comity_sim2d.senses.sensing import SensedPeople


class SimRobot:
    """The robot of a `World`.

    Args:
        spec: Its body.
        physics: Its true pose.
        senses: Believed positions of people.
        clock: Simulated time.
        controller: Controller of its base.
        said: What people say to it.
        faults: Its active faults.
    """

    def __init__(
        self,
        spec: RobotBody,
        physics: Physics,
        senses: SensedPeople,
        clock: Clock,
        controller: BaseController,
        *,
        said: Sequence[Said] = (),
        faults: ActiveFaults | None = None,
    ) -> None:
        require_kinds(
            "robot", spec=(spec, RobotBody), physics=(physics, Physics), senses=(senses, SensedPeople)
        )
        require_kinds("robot", clock=(clock, Clock), controller=(controller, BaseController))
        require_kinds("robot", faults=(faults, ActiveFaults | None))
        require_each("robot", "said", said, Said)
        self._spec = spec
        self._physics = physics
        self._senses = senses
        self._clock = clock
        self._said = said
        self._faults = faults or ActiveFaults()
        self._acts = Acts(clock)
        self._goals = 0
        """Number of motion goals so far."""
        self._lease = Lease(clock)
        self.emergency_stop = EmergencyStop()
        self._bump_stop = BumpStop(physics.touches, clock, self.emergency_stop)
        self._controller = controller
        self._distances_m: dict[str, float] = {}
        """Last commanded distance from each person, between the surfaces [m]."""

    @property
    def name(self) -> str:
        """Name, as in the scene."""
        return self._spec.name

    @property
    def events(self) -> tuple[ActEvent, ...]:
        """All speech and acts, in order."""
        return self._acts.events

    @property
    def pose(self) -> Pose:
        """True pose."""
        return self._physics.pose

    @property
    def people(self) -> tuple[Person, ...]:
        """All people at their believed positions."""
        return self._senses.people

    @property
    def missing(self) -> frozenset[str]:
        """People known not to be at their believed place, whether or not the robot has searched for them."""
        return self._senses.lost

    @property
    def walking(self) -> frozenset[str]:
        """People believed to be walking."""
        return frozenset(person.name for person in self.people if self._senses.walks(person.name))

    def lost(self) -> dict[str, str]:
        """Missing people whom it did not find where they were last seen, and since when, in words.

        People for whom another search is worthwhile, from elsewhere or after a while, are not included.
        """
        return {name: why for name in sorted(self.missing) if (why := self._controller.in_vain(name))}

    def would_see(self, person: str) -> bool:
        """Whether a turn is enough to check the believed place of an unseen person."""
        return self._senses.would_see(person, self._physics.pose.xy)

    def has_to_watch(self, person: str) -> bool:
        """Whether it has to face a person to notice that they leave, as it lacks all-round view."""
        return self._senses.has_to_watch(person, self._physics.pose.xy)

    @property
    def capabilities(self) -> BaseCapabilities:
        """It follows commands at once, stops exactly, and brakes as its body can."""
        return BaseCapabilities(
            braking_m_s2=mean_braking(self._spec, self._clock.step_s),
            feedback_hz=1.0 / self._clock.step_s,
            lease_s=LEASE_S,
        )

    def now_s(self) -> float:
        """Simulated time."""
        return self._clock.now_s

    def read(self, person: str) -> PersonEstimate | None:
        """The robot's estimate of a person; None while its sensors do not see them.

        If the sensor range is too short for the commanded pose next to the person, the reading is relative to
        where the person was last seen, unless they are known to have left.

        Raises:
            ValueError: If there is no such person.
        """
        someone = self._senses.person(person)
        is_seen = self._senses.sees(person)
        if self._senses.stamp_s is None or not (is_seen or self._presumes(person)):
            return None
        stands = docked(self._physics.pose, self._spec.radius_m, someone)
        return PersonEstimate(
            distance_m=stands.distance_m,
            centre_distance_m=stands.centre_distance_m,
            bearing_deg=stands.bearing_deg,
            facing_error_deg=stands.facing_error_deg,
            person_facing_error_deg=abs(stands.bearing_deg),
            speed_m_s=self._senses.speed_beside(person, self._physics.pose, self._physics.twist.xy),
            stamp_s=self._senses.stamp_s,
            is_seen=is_seen,
        )

    def _presumes(self, person: str) -> bool:
        """Whether it assumes an unseen person to be where they were last seen."""
        distance_m = self._distances_m.get(person)
        if distance_m is None or self._senses.has_lost(person):
            return False
        return self._senses.too_short_for(self._spec.radius_m + distance_m) is not None

    def heard(self, person: str) -> tuple[Said, ...]:
        """What a person has said, as far as the robot has understood it: hearing has a delay, like sight.

        Raises:
            ValueError: If there is no such person.
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
        """The target pose if free and reachable, else the most desirable one that is, or None.

        For a walking person, a pose that only they obstruct is accepted, and as a last resort the target
        pose: if they face a wall now, they will turn round. For a person who agreed to be accompanied, it is
        at their side.

        Raises:
            ValueError: For a bearing beyond 90 degrees, a distance below 0.30 m or an unknown person.
        """
        self._require(person)
        ways = self._controller.standing.everybody()
        if self._senses.has_lost(person):  # the robot goes to look for them where they were seen last
            ways = RouteMap(
                ways.surroundings.with_people((*ways.surroundings.people, self._senses.person(person)))
            )
        wish = Wish(person, distance_m, bearing_deg, distance_desirability, direction_desirability)
        here = self._physics.pose.xy
        walks = self._senses.walks(person)
        if walks and goes_along(self._spec, someone := self._senses.person(person)):
            return pose_at_side(docked(self._physics.pose, self._spec.radius_m, someone), wish)
        past = PastPeople(ways.surroundings)
        pose = choose_pose(ways, here, wish) or choose_pose(past.to(person), here, wish)
        if pose is None and walks:
            pose = choose_pose(past, here, wish) or DockingPose(distance_m, bearing_deg)
        if pose is None:
            return None
        return replace(pose, unverified=self._senses.too_short_for(self._spec.radius_m + pose.distance_m))

    def go(self, goal: MotionRequest) -> int:
        """Start a goal, replacing the previous one, until its lease ends; returns its number, from 1."""
        require_kinds("robot", goal=(goal, MotionRequest))
        number = self._set_out(goal)
        self._lease.begin()
        return number

    def renew(self, goal: int | str) -> None:
        """Renew the newest motion goal; a manual one needs no renewal."""
        require_kinds("robot", goal=(goal, int | str))
        if goal == self._goals:
            self._lease.renew()

    def _set_out(self, goal: MotionRequest) -> int:
        if goal.kind == "face":
            return self.face(goal.to)
        if goal.kind == "go_to":
            return self.go_to(goal.to, speed_m_s=goal.speed_m_s, detour_m=goal.detour_m)
        if goal.pose is not None and goal.kind == "navigate":
            return self.navigate(
                goal.to,
                goal.pose,
                speed_m_s=goal.speed_m_s,
                near_m_s=goal.near_m_s,
                detour_m=goal.detour_m,
            )
        if goal.pose is not None and goal.kind == "dock":
            return self.dock(goal.to, goal.pose, speed_m_s=goal.speed_m_s)
        raise WrongValueError(
            expected="a goal of the kind face, go_to, or navigate or dock with a pose",
            got=shown(goal),
            remedy="Give the pose to stand at, as choose_pose finds it.",
        )

    def navigate(
        self,
        person: str,
        pose: PoseBeside,
        *,
        speed_m_s: float,
        near_m_s: float = math.inf,
        detour_m: float = math.inf,
    ) -> int:
        """Drive along the shortest route; succeeds 1.2 m before the pose, from where docking continues.

        Within 1.5 m of the person's body the speed is at most `near_m_s`, from every side. If the route
        around people is longer by more than `detour_m`, or there is none, the robot approaches the
        obstructing person and reports them.

        Returns:
            The goal's number.
        """
        self._require(person)
        _require_command(speed_m_s, detour_m, near_m_s)
        require_kinds("robot", pose=(pose, PoseBeside))
        self._distances_m[person] = pose.distance_m
        self._controller.navigate(person, pose, speed_m_s=speed_m_s, near_m_s=near_m_s, detour_m=detour_m)
        return self._next_goal()

    def dock(self, person: str, pose: PoseBeside, *, speed_m_s: float) -> int:
        """Drive onto the docking pose, and hold it as the person moves; returns the goal's number.

        The speed limit also applies within 1.5 m of the person's body, relative to them if they walk.
        """
        self._require(person)
        _require_command(speed_m_s)
        require_kinds("robot", pose=(pose, PoseBeside))
        self._distances_m[person] = pose.distance_m
        self._controller.dock(person, pose, speed_m_s=speed_m_s)
        return self._next_goal()

    def learn_places(self, places: Mapping[str, Pose]) -> None:
        """Add poses for fetching things that were unreachable before; known ones stay."""
        self._controller.learn_places(places)

    def learn(self, person: str, *, distance_m: float, speed_m_s: float | None = None) -> None:
        """Store how a person wants the robot to move near them, and replan at once.

        Args:
            person: The person.
            distance_m: Distance for passing them, between the surfaces [m], in [0, 10].
            speed_m_s: Maximum speed within 1.5 m of their body, as they asked [m/s]; None: they did not.

        Raises:
            SceneError: For an invalid distance or speed.
            ValueError: If there is no such person.
        """
        known = self._senses.person(person)
        if (known.personal_distance_m, known.approach_speed_m_s) == (distance_m, speed_m_s):
            return
        self._senses.learn(person, distance_m=distance_m, speed_m_s=speed_m_s)
        if known.personal_distance_m != distance_m:
            self._controller.look_for_another_way()

    def go_to(self, place: str, *, speed_m_s: float, detour_m: float = math.inf) -> int:
        """Drive to where an object is kept, and face it, as in `navigate`; returns the goal's number.

        Raises:
            ValueError: If there is no such place.
        """
        _require_command(speed_m_s, detour_m)
        self._controller.go_to(place, speed_m_s=speed_m_s, detour_m=detour_m)
        return self._next_goal()

    def carried(self) -> str | None:
        """The object that it picked up and has not handed over."""
        return carried_at(self._acts.events, self._clock.now_s)

    def face(self, person: str) -> int:
        """Stop, turn on the spot towards a person, and keep facing them; returns the goal's number."""
        self._require(person)
        self._controller.face(person)
        return self._next_goal()

    def stop(self, goal: int | str | None = None) -> None:
        """Stop an act or the newest motion goal; without an argument, stand until the next goal."""
        require_kinds("robot", goal=(goal, int | str | None))
        if isinstance(goal, str):
            self._acts.stop(goal)
        elif goal is None:
            self._controller.halt()
        elif goal == self._goals:
            self._controller.stop()

    def motion(self) -> MotionProgress:
        """Progress of the newest motion goal."""
        twist = self._physics.twist
        return self._controller.motion._replace(
            goal=self._goals or None,
            stamp_s=self._clock.now_s,
            remaining_m=self._controller.remaining_m,
            is_at_rest=twist.speed_m_s == 0.0 and twist.turn_rad_s == 0.0,
        )

    def trouble(self, part: str) -> str | None:
        """The fault of a part of the robot or its path, in words, or None.

        A shut path is no fault if something else blocks the robot.
        """
        subject = active_faults.part(part)
        if subject == PATH and self._controller.is_held_up_on_its_way:
            return None
        return self._faults.of(subject)

    def trouble_with(self, person: str) -> str | None:
        """The fault concerning a person, in words, or None."""
        return self._faults.of(active_faults.person(person))

    def emergency(self) -> str | bool:
        """Why the emergency stop is pressed; False while it is not."""
        return self.emergency_stop.reason or False

    def perform(self, act: ActRequest) -> str:
        """Begin to speak, gesture or handle something; towards passers-by only requests for passage.

        Returns:
            Identifier of the act.
        """
        require_kinds("robot", act=(act, ActRequest))
        require_kinds("act", act=(act.act, str))
        if act.act == PICK_UP:
            require_text("robot", "place", act.to)
        elif not (act.act == ASK_TO_PASS and act.to in self._controller.standing.passers_by):
            self._require(act.to)
        if act.act in (PICK_UP, HAND_OVER):
            require_kinds("act", thing=(act.thing, str))
        begun = self._acts.start(act)
        if self._faults.of(VOICE):
            self._acts.fall_silent()
        return begun

    def performance(self, act: int | str) -> ActProgress:
        """The progress of an act: running, succeeded, or stopped if interrupted.

        Raises:
            ValueError: If there is no such act.
        """
        return self._acts.status(act)

    @property
    def asked_now(self) -> tuple[str, ...]:
        """People whom it asked to make way, if the question ended in this tick."""
        return tuple(event.person for event in self._acts.ended(ASK_TO_PASS, self._clock.step_s))

    @property
    def margin_decisions(self) -> tuple[MarginDecision, ...]:
        """Whether each person who let it pass is passed at the reduced margin, in order."""
        return tuple(self._controller.margins.decisions)

    def find_way(self) -> tuple[XY, ...]:
        """The path that it would take if all people made way; empty where it has no goal."""
        return self._controller.find_way()

    def use_plan(self, plan: FloorPlan) -> None:
        """Replace the floor plan after a door was shut or opened, which the robot learns at once."""
        self._controller.use_plan(plan)
        self._senses.use_plan(plan)

    def feel(self) -> None:
        """Handle contacts, which press the emergency stop, ended requests, and voice faults.

        Called by the world after every tick.
        """
        self._bump_stop.feel()
        self._controller.note_asked(self.asked_now)
        if self._faults.of(VOICE):
            self._acts.fall_silent()

    def control(self) -> Twist:
        """The command for the coming tick: called by the world."""
        twist = self._commanded()
        return self._controller.cut() if self._faults.of(BASE) else twist

    def _commanded(self) -> Twist:
        if (bump := self._bump_stop.reason) is not None:
            return self._controller.cut(bump)
        if self.emergency_stop.reason is not None:
            return self._controller.brake()
        if self._faults.of(SENSORS) is not None:
            return self._controller.stand_blind()
        if self._lease.is_over:
            self._lease.waive()
            self._controller.expire(LEASE_S)
        return self._controller.go_on()

    @property
    def goal(self) -> XY | None:
        """Goal position [m]; None without a goal."""
        return self._controller.goal

    def _next_goal(self) -> int:
        self._goals += 1
        self._lease.waive()
        return self._goals

    def _require(self, person: str) -> None:
        find_person(self._senses.people, person)


def _require_command(speed_m_s: float, detour_m: float = math.inf, near_m_s: float = math.inf) -> None:
    """Reject invalid speeds and detours before the current goal is dropped."""
    if not (is_number(speed_m_s) and 0.0 < speed_m_s < math.inf):
        raise WrongValueError(expected="speed_m_s above 0", got=shown(speed_m_s), remedy="Give it in m/s.")
    if not (is_number(near_m_s) and near_m_s > 0.0):
        raise WrongValueError(expected="near_m_s above 0", got=shown(near_m_s), remedy="Give it in m/s.")
    if not (is_number(detour_m) and detour_m >= 0.0):
        raise WrongValueError(expected="detour_m of 0 or more", got=shown(detour_m), remedy="Give it in m.")
