"""A real robot's knowledge of the world on a map: its pose, people's positions, and its readings."""

from __future__ import annotations

from dataclasses import replace
from math import inf
from typing import TYPE_CHECKING

from comity.live.base_senses import GRACE_S, BaseSenses, one_each, stranger
from comity.live.identities import Identities
from comity.live.odd_readings import OddReadings
from comity.live.people_seen import PeopleSeen
from comity_fis.proxemics import PERSON_MARGIN_M
from comity_sim2d import Person, RouteMap, Wish, choose_pose, wrap_angle
from comity_sim2d.navigation.docking import docked
from comity_sim2d.navigation.past_people import PastPeople
from comity_sim2d.pose import Pose
from comity_sim2d.robot.motion import PersonEstimate
from comity_sim2d.scene.obstacles import floor_plan
from comity_sim2d.scene.surroundings import Surroundings
from comity_sim2d.senses.overlap_resolution import off_things
from comity_sim2d.senses.sight import too_short_for

if TYPE_CHECKING:
    from comity.live.people_seen import Seen
    from comity_executor import Localisation, MapRobot, PersonTrack, RelativePose
    from comity_sim2d import Scene
    from comity_sim2d.navigation.yielding import Walker

SILENT_S = 0.5
"""Time without data after which localisation or tracker count as silent [s] (our choice)."""


class KnownWorld:
    """Polls one robot once per tick and stores its reports.

    Args:
        base: The robot.
        scene: The map, people's positions at planning time, and the robot's body.
    """

    def __init__(self, base: MapRobot, scene: Scene) -> None:
        self.scene = scene
        self._base = base
        self._start_s = base.now_s()
        self._surroundings = Surroundings.of(scene)
        self._seen = PeopleSeen(scene)
        self.names = frozenset(person.name for person in scene.people)
        """Names of the scenario's people."""
        self._identities = Identities(self.names)
        self._margin_m: dict[str, float] = {}
        """Margins of the people with less than the full margin [m]."""
        self._strangers: tuple[Person, ...] = ()
        """Tracked people who are not in the scenario."""
        self._localised: Localisation | None = None
        self._senses = BaseSenses(base, floor_plan(scene))
        self.odd = OddReadings(self.names, scene.robot.name)
        """Readings that suggest a mistake in the robot's code."""

    def own_time_s(self, stamp_s: float) -> float:
        """A time of the robot's clock as time since the start of the episode [s]."""
        return stamp_s - self._start_s

    def sense(self) -> None:
        """Update the robot's pose and the tracked people; called once per tick."""
        now_s = self._base.now_s()
        self._localised = self._senses.localisation(now_s) or self._localised
        tracks, several = one_each(self._senses.tracks(now_s))
        self.odd.take_in(self.now_s(), self._localised, tracks)
        if self._localised is None:
            return
        own = [self._by_own_clock(track) for track in tracks]
        if not self._is_deaf(now_s):
            is_free = getattr(self._base, "floor_is_free", None)
            self._seen.take_in(own, self.here, self.now_s(), is_free=is_free)
            self._identities.take_in(own, self.now_s(), doubted=several)
        self._strangers = tuple(stranger(track) for track in own if track.person not in self.names)

    def _is_deaf(self, now_s: float) -> bool:
        """Whether the tracker is silent; then missing tracks mean nothing."""
        return now_s - self._senses.tracked_s > GRACE_S

    def _by_own_clock(self, track: PersonTrack) -> PersonTrack:
        sure_s = None if track.identified_s is None else track.identified_s - self._start_s
        return replace(track, stamp_s=track.stamp_s - self._start_s, identified_s=sure_s)

    @property
    def uncertain(self) -> frozenset[str]:
        """People whose identity is uncertain."""
        return self._identities.uncertain

    @property
    def is_blind(self) -> str | None:
        """Why the robot knows too little to move (its pose, or people); None if it knows enough."""
        now_s, here = self._base.now_s(), self._localised
        ages = {
            "localisation": inf if here is None else now_s - here.stamp_s,
            "tracker": now_s - self._senses.tracked_s,
        }
        for what, age in ages.items():
            if age > SILENT_S:
                why = self._senses.refused.get(what)
                return f"nothing was heard of the {what} for {_age(age)}" + (f": {why}" if why else "")
        return self._seen.may_be_at(self.here, self.now_s())

    def now_s(self) -> float:
        """Time since the start of the episode [s]."""
        return self._base.now_s() - self._start_s

    @property
    def pose(self) -> Pose:
        """The free pose nearest to the last known one, as localisation errors may put it inside obstacles."""
        here, radius_m = self.here, self.scene.robot.radius_m
        x_m, y_m = off_things(here.xy, radius_m, self._surroundings.plan)
        return Pose(x_m, y_m, here.heading_rad)

    @property
    def here(self) -> Pose:
        """The last known pose; before the first, the scenario's."""
        here = self._localised
        return (
            self.scene.robot.pose if here is None else Pose(here.x_m, here.y_m, wrap_angle(here.heading_rad))
        )

    @property
    def people(self) -> tuple[Person, ...]:
        """All people of the scenario at their believed positions."""
        return self._seen.people

    @property
    def missing(self) -> frozenset[str]:
        """People known to have left their last seen position."""
        return frozenset(self._seen.lost)

    @property
    def walking(self) -> frozenset[str]:
        """People who are walking."""
        return frozenset(walker.person.name for walker in self.walkers)

    @property
    def walkers(self) -> tuple[Walker, ...]:
        """Walking people with their velocities."""
        return self._seen.walkers

    def lost(self) -> dict[str, str]:
        """The missing, each with since when: the robot does not search for them."""
        return {name: _lost(name, since_s) for name, since_s in sorted(self._seen.lost.items())}

    def person(self, name: str) -> Person:
        """A person at their believed position."""
        return self._seen.of(name).person

    def seen(self, name: str) -> Seen:
        """A person with the tracker's data."""
        return self._seen.of(name)

    def keep(self, name: str, margin_m: float) -> None:
        """Set the margin to keep from a person [m]."""
        self._margin_m[name] = margin_m

    def learn(self, person: str, *, distance_m: float, speed_m_s: float | None = None) -> None:
        """Set how a person wants the robot to pass them."""
        self._seen.learn(person, distance_m=distance_m, speed_m_s=speed_m_s)

    def read(self, person: str, *, told_m: float | None) -> PersonEstimate | None:
        """Distances and angles to a tracked person; None if they are not tracked.

        If the sensor does not reach the person from the commanded pose, the reading is relative to where they
        were last seen, as for the simulated robot.

        Args:
            person: Name of the person.
            told_m: Commanded distance from the person [m], or None.
        """
        seen, localised = self._seen.of(person), self._localised
        if localised is None or self.is_blind or not (seen.is_seen or self._presumes(person, told_m)):
            return None
        stands = docked(self.here, self.scene.robot.radius_m, seen.person)
        here_s = self.own_time_s(localised.stamp_s)
        return PersonEstimate(
            distance_m=stands.distance_m,
            centre_distance_m=stands.centre_distance_m,
            bearing_deg=stands.bearing_deg,
            facing_error_deg=stands.facing_error_deg,
            person_facing_error_deg=abs(stands.bearing_deg),
            speed_m_s=abs(localised.speed_m_s),
            stamp_s=here_s if seen.stamp_s is None else min(seen.stamp_s, here_s),
            is_seen=seen.is_seen,
        )

    def _presumes(self, person: str, told_m: float | None) -> bool:
        """Whether an unseen person is assumed to be at their last seen position."""
        if told_m is None or self._seen.of(person).has_vanished or person in self._seen.lost:
            return False
        return self._too_short_for(told_m) is not None

    def _too_short_for(self, distance_m: float) -> str | None:
        """Why the sensor may not see a person at this distance; None if it does."""
        robot = self.scene.robot
        return too_short_for(robot.sensor, robot.radius_m + distance_m)

    def pose_for(self, wish: Wish) -> RelativePose | None:
        """The target pose if it is free, else the most desirable free one, or None."""
        if wish.person in self._seen.lost:
            return None
        around, here = self.around, self.pose.xy
        pose = choose_pose(RouteMap(around), here, wish)
        pose = pose or choose_pose(PastPeople(around).to(wish.person), here, wish)
        return pose and replace(pose, unverified=self._too_short_for(pose.distance_m))

    @property
    def bodies(self) -> tuple[Person, ...]:
        """All people who are or may be present; uncertain positions enlarge their bodies."""
        people = self._seen.obstacles(self.now_s())
        kept = (replace(one, margin_m=self._margin_m.get(one.name, one.margin_m)) for one in people)
        return (*kept, *self._strangers)

    @property
    def around(self) -> Surroundings:
        """The map with all these people."""
        return self._surroundings.with_people(self.bodies)

    @property
    def around_at_full_margin(self) -> Surroundings:
        """The same, with the full margin to everybody."""
        people = tuple(replace(one, margin_m=PERSON_MARGIN_M) for one in self.bodies)
        return self._surroundings.with_people(people)


def _age(age_s: float) -> str:
    return "the whole time" if age_s == inf else f"{age_s:.1f} s"


def _lost(name: str, since_s: float | None) -> str:
    seen = "has not been seen yet" if since_s is None else f"was seen last at {since_s:.1f} s"
    return f"{name} {seen}, and is not there any more"
