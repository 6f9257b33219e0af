"""A real robot as the tree and the planner need it: distances, sides and docking poses come from the map.

The base is told poses of the map. A pose beside a person moves along with them: where it has moved by more
than `FOLLOW_M`, or the robot comes near and has to slow down, the base is told anew, which replaces the goal
before; for the tree it is still one goal. Goals are renewed only while localisation and tracker are heard, so
that a base that does not know where it is, or who is there, stops by itself.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from math import dist, inf, pi
from typing import TYPE_CHECKING

from comity.live.act_record import ActRecord
from comity.live.base_senses import GRACE_S, BaseSenses, one_each, stranger
from comity.live.identities import Identities
from comity.live.people_seen import PeopleSeen
from comity_executor import MapGoal, MotionStatus, without_names
from comity_executor.robots.stop_button import is_false
from comity_sim2d import Person, RouteMap, Wish, choose_pose, wrap_angle
from comity_sim2d.base.drive import NEAR_PEOPLE_M, NEAR_PEOPLE_M_S
from comity_sim2d.navigation.docking import docked, spot_beside
from comity_sim2d.navigation.past_people import PastPeople
from comity_sim2d.pose import Pose, direction_to
from comity_sim2d.robot.in_the_way import in_the_way
from comity_sim2d.robot.motion import Reading
from comity_sim2d.scene.obstacles import Surroundings, floor_plan
from comity_sim2d.senses.sight import too_short_for
from comity_sim2d.senses.taken_apart import off_things

if TYPE_CHECKING:
    from comity.live.operator import Operator
    from comity_executor import (
        ActGoal,
        Capabilities,
        DockingPose,
        GoalId,
        GoalStatus,
        Localisation,
        MapRobot,
        Motion,
        MotionGoal,
        PersonTrack,
        Words,
    )
    from comity_fis.defuzzification.curve import Curve
    from comity_sim2d import ActEvent, Scene

FOLLOW_M, FOLLOW_RAD = 0.05, 5.0 * pi / 180.0
"""A pose that has moved or turned by more is told to the base anew (our choice)."""
SILENT_S = 0.5
"""Localisation or a tracker of which nothing was heard for so long is silent (our choice)."""


class RobotOnMap:
    """It has the form of the executor's `Robot`, and what the planner asks of the simulated one.

    Args:
        base: The robot.
        scene: The map, everybody where they were when the plan was made, and the robot's body and speed.
        operator: Who may hold it.
    """

    def __init__(self, base: MapRobot, scene: Scene, operator: Operator | None = None) -> None:
        self._base = base
        self._scene = scene
        self._operator = operator
        self._start_s = base.now_s()
        self._surroundings = Surroundings.of(scene)
        self._seen = PeopleSeen(scene)
        self._names = frozenset(person.name for person in scene.people)
        self._identities = Identities(self._names)
        self._strangers: tuple[Person, ...] = ()
        """People whom the tracker sees and the scenario does not know."""
        self._localised: Localisation | None = None
        self._senses = BaseSenses(base, floor_plan(scene))
        self._places: Mapping[str, Pose] = {}
        self._record = ActRecord()
        self._goal: MotionGoal | None = None
        """The newest one; None once all was stopped."""
        self._distances_m: dict[str, float] = {}
        """How far from each person it was last told to stand."""
        self._goals = 0
        """So many there have been."""
        self._told: MapGoal | None = None
        """What the base was told last; None while it is to stand."""
        self._told_for = 0
        """For which goal."""
        self._base_goals: list[GoalId] = []
        """What the base calls it, and before it those that were told for the same goal."""

    def sense(self) -> None:
        """Take in where the robot is and whom it sees; to be called once in every tick."""
        now_s = self._base.now_s()
        self._localised = self._senses.localisation(now_s) or self._localised
        tracks, several = one_each(self._senses.tracks(now_s))
        if self._localised is None:
            return
        own = [self._by_own_clock(track) for track in tracks]
        if not self._is_deaf(now_s):
            is_free = getattr(self._base, "floor_is_free", None)
            self._seen.take_in(own, self.here, self.now_s(), is_free=is_free)
            self._identities.take_in(own, self.now_s(), doubted=several)
        self._strangers = tuple(stranger(track) for track in own if track.person not in self._names)

    def _is_deaf(self, now_s: float) -> bool:
        """Whether the tracker is silent: then nothing follows from whom it does not name."""
        return now_s - self._senses.tracked_s > GRACE_S

    def _by_own_clock(self, track: PersonTrack) -> PersonTrack:
        sure_s = None if track.identified_s is None else track.identified_s - self._start_s
        return replace(track, stamp_s=track.stamp_s - self._start_s, identified_s=sure_s)

    @property
    def uncertain(self) -> frozenset[str]:
        """Of whom it is not sure who they are."""
        return self._identities.uncertain

    @property
    def has_to_stand(self) -> str | None:
        """Why it must not move for now: the operator holds it, or it is blind; None: it may."""
        held = self._operator.holds() if self._operator is not None else False
        return str(held) if held else self.is_blind

    @property
    def is_blind(self) -> str | None:
        """Why it does not know enough to move: where it is, or who is there; None: it does."""
        now_s, here = self._base.now_s(), self._localised
        ages = {
            "localisation": inf if here is None else now_s - here.stamp_s,
            "tracker": now_s - self._senses.tracked_s,
        }
        for what, age in ages.items():
            if age > SILENT_S:
                return f"nothing was heard of the {what} for {_age(age)}"
        return self._seen.may_be_at(self.here, self.now_s())

    @property
    def name(self) -> str:
        """As in the scenario."""
        return self._scene.robot.name

    @property
    def capabilities(self) -> Capabilities:
        """The base's own."""
        return self._base.capabilities

    def now_s(self) -> float:
        """Seconds since the start of the episode."""
        return self._base.now_s() - self._start_s

    @property
    def pose(self) -> Pose:
        """Where it can be, near where it last knew to be: localisation that is off puts it into things."""
        here, radius_m = self.here, self._scene.robot.radius_m
        x_m, y_m = off_things(here.xy, radius_m, self._surroundings.plan)
        return Pose(x_m, y_m, here.heading_rad)

    @property
    def here(self) -> Pose:
        """Where it last knew to be; before it ever did, where the scenario has it."""
        here = self._localised
        return (
            self._scene.robot.pose if here is None else Pose(here.x_m, here.y_m, wrap_angle(here.heading_rad))
        )

    @property
    def events(self) -> tuple[ActEvent, ...]:
        """All that it said and did."""
        return self._record.events

    @property
    def people(self) -> tuple[Person, ...]:
        """All people of the scenario where it believes them to be."""
        return self._seen.people

    @property
    def missing(self) -> frozenset[str]:
        """Who is known not to be where they were seen last."""
        return frozenset(self._seen.lost)

    @property
    def walking(self) -> frozenset[str]:
        """Who is under way."""
        return frozenset(walker.person.name for walker in self._seen.walkers)

    def lost(self) -> dict[str, str]:
        """The missing, with since when: it does not go to look for them."""
        return {name: _lost(name, since_s) for name, since_s in sorted(self._seen.lost.items())}

    def would_see(self, person: str) -> bool:
        """Never: it does not turn to look for people."""
        return False

    def has_to_watch(self, person: str) -> bool:
        """Never: whom the tracker sees does not hang on where the robot looks, as far as is known."""
        return False

    def learn(self, person: str, *, distance_m: float, speed_m_s: float | None = None) -> None:
        """Know how a person wants it to pass them."""
        self._seen.learn(person, distance_m=distance_m, speed_m_s=speed_m_s)

    def learn_places(self, places: Mapping[str, Pose]) -> None:
        """Know where to stand to fetch things."""
        self._places = dict(places)

    def carried(self) -> str | None:
        """What the robot says that it holds; nothing where it cannot say."""
        carried = getattr(self._base, "carried", None)
        return carried() if carried else None

    def read(self, person: str) -> Reading | None:
        """Distances and angles to a person whom the tracker sees; None otherwise.

        Where the sensor is too short for the pose that the robot was told to take beside them, that is how it
        stands to where they were seen last, as for the simulated robot.
        """
        seen, localised = self._seen.of(person), self._localised
        if localised is None or self.is_blind or not (seen.is_seen or self._presumes(person)):
            return None
        stands = docked(self.here, self._scene.robot.radius_m, seen.person)
        here_s = localised.stamp_s - self._start_s
        return Reading(
            distance_m=stands.distance_m,
            centre_distance_m=stands.centre_distance_m,
            bearing_deg=stands.bearing_deg,
            facing_error_deg=stands.facing_error_deg,
            person_facing_error_deg=abs(stands.bearing_deg),
            speed_m_s=abs(localised.speed_m_s),
            stamp_s=here_s if seen.stamp_s is None else min(seen.stamp_s, here_s),
            is_seen=seen.is_seen,
        )

    def _presumes(self, person: str) -> bool:
        """Whether it takes a person whom it does not see to stand where they were seen last."""
        distance_m = self._distances_m.get(person)
        if distance_m is None or self._seen.of(person).has_vanished or person in self._seen.lost:
            return False
        return self._too_short_for(distance_m) is not None

    def _too_short_for(self, distance_m: float) -> str | None:
        """Why its sensor would not surely show a person so far away; None where it would."""
        robot = self._scene.robot
        return too_short_for(robot.sensor, robot.radius_m + distance_m)

    def heard(self, person: str) -> Sequence[Words]:
        """What the robot understood of a person; nothing where it has no ears."""
        heard = getattr(self._base, "heard", None)
        return heard(person) if heard else ()

    def choose_pose(
        self,
        person: str,
        *,
        distance_m: float,
        bearing_deg: float,
        distance_desirability: Curve,
        direction_desirability: Curve,
    ) -> DockingPose | None:
        """The wanted pose if the map and the people leave it free, else the most desirable one that is."""
        if person in self._seen.lost:
            return None
        wish = Wish(person, distance_m, bearing_deg, distance_desirability, direction_desirability)
        around, here = self._around(), self.pose.xy
        pose = choose_pose(RouteMap(around), here, wish)
        pose = pose or choose_pose(PastPeople(around).to(person), here, wish)
        return pose and replace(pose, unverified=self._too_short_for(pose.distance_m))

    def go(self, goal: MotionGoal) -> int:
        """Set out for a goal, once localisation and tracker are heard; its number."""
        self._goal, self._goals = goal, self._goals + 1
        if goal.pose is not None:
            self._distances_m[goal.to] = goal.pose.distance_m
        self._go_on(self._base_goals[-1:])
        return self._goals

    def renew(self, goal: GoalId) -> None:
        """Let the base go on, or tell it where the goal is by now."""
        if goal != self._goals or self._goal is None:
            return
        if self.has_to_stand or self._told is None or _differs(self._told, self._pose_of(self._goal)):
            self._go_on(self._base_goals)
        else:
            self._base.renew(self._base_goals[-1])

    def _go_on(self, before: Sequence[GoalId]) -> None:
        """Tell the base where its goal is now, or stop it while it does not know where it is or who is there.

        Args:
            before: What the base calls the goal that goes on so, last of all the newest.
        """
        assert self._goal is not None
        if self.has_to_stand:
            if self._told is not None:
                self._base.stop(before[-1])
            self._told, self._base_goals = None, []
            return
        is_new = self._told_for != self._goals
        self._told, self._told_for = self._pose_of(self._goal), self._goals
        self._base_goals = [*([] if is_new else before), self._base.go(self._told)]

    def motion(self) -> MotionStatus:
        """How the newest goal goes, as the base says, by the number that it has here."""
        said = self._base.motion()
        if self._goal is not None and self._told is None:
            return self._waiting(said)
        state, number = said.state, self._number_of(said.goal)
        if self._base_goals and said.goal in self._base_goals[:-1]:
            state = "running"  # what replaces it is not taken up yet
        if self._goal is None and state == "succeeded":
            state = "stopped"  # it has ended, and nothing else was asked for
        return MotionStatus(
            number,
            state,  # type: ignore[arg-type]  # the tree refuses other words
            said.text,
            stamp_s=said.stamp_s - self._start_s,
            remaining_m=said.remaining_m,
            is_blocked=said.is_blocked,
            blocked_by=self._blocked_by(said),
            is_at_rest=said.is_at_rest,
        )

    def _waiting(self, said: Motion) -> MotionStatus:
        """How a goal goes of which the base does not know yet."""
        return MotionStatus(
            self._goals,
            "accepted",
            self.has_to_stand or "",
            stamp_s=self.now_s(),
            is_blocked=True,
            is_at_rest=said.is_at_rest,
        )

    def _number_of(self, goal: GoalId | None) -> int | None:
        """What a goal of the base is called here: the newest one, or any before it."""
        if goal is None or not self._goals:
            return None
        return self._goals if goal in self._base_goals else self._goals - 1 or None

    def perform(self, act: ActGoal) -> str:
        """Begin an act; what it is called here. Nobody is named of whom it is not sure who they are."""
        if self._operator is not None and (held := self._operator.holds()):
            raise RuntimeError(held)  # it is tried again once the operator lets it
        if act.text is not None and self.uncertain:
            act = replace(act, text=without_names(act.text, self.uncertain))
        return self._record.begin(act, self._base.perform(act), self.now_s())

    def performance(self, act: GoalId) -> GoalStatus:
        """How an act goes."""
        status = self._base.performance(self._record.goal_of(act))
        return self._record.note(act, status, self.now_s())

    def stop(self, goal: GoalId | None = None) -> None:
        """End a goal, an act, or whatever the base does."""
        if isinstance(goal, str):
            self._base.stop(self._record.goal_of(goal))
        elif goal is None:
            self._goal = self._told = None
            self._base.stop()
        elif goal == self._goals and self._base_goals:
            self._goal = self._told = None
            self._base.stop(self._base_goals[-1])

    def emergency(self) -> str | bool:
        """The base's own stop."""
        return self._base.emergency()

    def stop_of(self, asked: Callable[[], object]) -> Callable[[], object]:
        """The stop as the execution reads it: the operator's, where the base's own is not pressed.

        Args:
            asked: Says what the base's own is.
        """

        def read() -> object:
            said = asked()
            return self._operator.holds() if self._operator is not None and is_false(said) else said

        return read

    def _pose_of(self, goal: MotionGoal) -> MapGoal:
        here, speed_m_s = self.pose, min(goal.speed_m_s, self._scene.robot.max_speed_m_s)
        if goal.kind == "go_to":
            there = self._places[goal.to]
            return MapGoal("go_to", goal.to, there.x_m, there.y_m, there.heading_rad, speed_m_s)
        person = self._seen.of(goal.to).person
        xy = here.xy if goal.pose is None else spot_beside(person, self._scene.robot.radius_m, goal.pose)
        if self._is_near(person, speed_m_s):
            speed_m_s = min(speed_m_s, goal.near_m_s)
        for other in self._bodies:
            if self._is_near(other, speed_m_s):
                speed_m_s = min(speed_m_s, other.approach_speed_m_s or NEAR_PEOPLE_M_S)
        return MapGoal(goal.kind, goal.to, *xy, direction_to(xy, person.xy), speed_m_s)

    def _is_near(self, person: Person, speed_m_s: float) -> bool:
        """Whether the robot is so near somebody that it has to begin to slow down for them."""
        can = self.capabilities
        ahead_m = speed_m_s * can.latency_s + speed_m_s**2 / (2.0 * can.braking_m_s2) + FOLLOW_M
        gap_m = dist(self.here.xy, person.xy) - self._scene.robot.radius_m - person.radius_m
        return gap_m <= NEAR_PEOPLE_M + ahead_m

    @property
    def _bodies(self) -> tuple[Person, ...]:
        """Everybody who is or may be there, as large as where they may be."""
        return (*self._seen.obstacles(self.now_s()), *self._strangers)

    def _around(self) -> Surroundings:
        return self._surroundings.with_people(self._bodies)

    def _blocked_by(self, said: Motion) -> tuple[str, ...]:
        """The people in the way, by the map where the base does not name them."""
        goal = self._goal
        if not said.is_blocked or said.blocked_by or goal is None or goal.pose is None:
            return tuple(said.blocked_by)
        found = in_the_way(
            RouteMap(self._around()),
            self.pose.xy,
            self._pose_xy(goal),
            visited=goal.to,
            keep_m=goal.pose.distance_m,
            detour_m=goal.detour_m,
        )
        return tuple(name for name in found.people if name in self._names) if found else ()

    def _pose_xy(self, goal: MotionGoal) -> tuple[float, float]:
        there = self._pose_of(goal)
        return there.x_m, there.y_m


def _differs(told: MapGoal, wanted: MapGoal) -> bool:
    moved_m = dist((told.x_m, told.y_m), (wanted.x_m, wanted.y_m))
    turned_rad = abs(wrap_angle(told.heading_rad - wanted.heading_rad))
    return moved_m > FOLLOW_M or turned_rad > FOLLOW_RAD or told.speed_m_s != wanted.speed_m_s


def _age(age_s: float) -> str:
    return "the whole time" if age_s == inf else f"{age_s:.1f} s"


def _lost(name: str, since_s: float | None) -> str:
    seen = "has not been seen yet" if since_s is None else f"was seen last at {since_s:.1f} s"
    return f"{name} {seen}, and is not there any more"
