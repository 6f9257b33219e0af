"""Tracked people, and the last seen positions of everybody else."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from math import atan2, dist
from typing import TYPE_CHECKING

from comity_sim2d import wrap_angle
from comity_sim2d.navigation.yielding import Walker, is_walking
from comity_sim2d.scene.obstacles import floor_plan
from comity_sim2d.senses.missing import Missing
from comity_sim2d.senses.sight import Sight

if TYPE_CHECKING:
    from comity_executor import PersonTrack
    from comity_sim2d import Person, Pose, Scene

IsFree = Callable[[float, float, float], bool]
"""Whether a disc of floor is free: x, y and radius [m]."""
MOST_RADIUS_M = 2.0
"""Maximum radius of any body in a scene [m]."""
STANDING = (0.0, 0.0)
GROWS_M_S, GROWS_M = 1.4, 2.0
"""Maximum speed [m/s], a brisk walk, and distance [m] of a person out of sight (our choice)."""


@dataclass(frozen=True, slots=True)
class Seen:
    """The robot's knowledge of a person of the scenario."""

    person: Person
    """The person at their current or last seen position."""
    velocity: tuple[float, float] = STANDING
    """Velocity [m/s]; for an unseen person the last known one."""
    is_seen: bool = False
    """Whether they are in the newest tracks."""
    has_heading: bool = False
    """Whether the tracker knows their orientation."""
    stamp_s: float | None = None
    """Time of the last observation since the start of the episode [s]; None: never seen."""
    has_vanished: bool = False
    """Whether they may have moved: they were walking when last seen, or the tracker lost them.

    A standing person who is merely out of view is assumed to stay.
    """

    def grown_m(self, now_s: float) -> float:
        """Maximum distance from the last seen position by now [m]."""
        if not self.has_vanished or self.stamp_s is None:
            return 0.0
        return min(GROWS_M, GROWS_M_S * max(0.0, now_s - self.stamp_s))

    def ahead(self, seconds: float) -> Person:
        """The person extrapolated at constant velocity."""
        (vx, vy), person = self.velocity, self.person
        return replace(person, x_m=person.x_m + vx * seconds, y_m=person.y_m + vy * seconds)


class PeopleSeen:
    """Updates people from a tracker, tick by tick.

    Args:
        scene: The scene, with people's assumed positions before they are seen.
    """

    def __init__(self, scene: Scene) -> None:
        sensor = scene.robot.sensor
        self._seen: Mapping[str, Seen] = {person.name: Seen(person) for person in scene.people}
        self._plan = floor_plan(scene)
        self._sight = Sight(sensor, self._plan)
        self._missing = Missing(self._sight, sensor.sigma_m)
        self._last_s: float | None = None
        self._robot_radius_m = scene.robot.radius_m

    @property
    def people(self) -> tuple[Person, ...]:
        """All people of the scenario at their believed positions."""
        return tuple(each.person for each in self._seen.values())

    def obstacles(self, now_s: float) -> tuple[Person, ...]:
        """All people, enlarged by the uncertainty of their positions, unless the floor was seen free."""
        return tuple(
            replace(each.person, radius_m=min(MOST_RADIUS_M, each.person.radius_m + each.grown_m(now_s)))
            for name, each in self._seen.items()
            if each.has_vanished or name not in self._missing.lost
        )

    def may_be_at(self, robot: Pose, now_s: float) -> str | None:
        """A sentence about an unseen person who may have reached the robot by now, or None.

        People do not pass through walls.
        """
        for name, each in self._seen.items():
            reach_m = self._robot_radius_m + each.person.radius_m + each.grown_m(now_s)
            if not each.has_vanished or dist(robot.xy, each.person.xy) > reach_m:
                continue
            if self._plan.wall_between(each.person.xy, robot.xy) is None:
                return f"{name} was seen last at {each.stamp_s:.1f} s and may have come here by now"
        return None

    @property
    def lost(self) -> Mapping[str, float | None]:
        """People who are not at their last seen position although it is in view, and since when [s]."""
        return dict(self._missing.lost)

    def of(self, name: str) -> Seen:
        """A person of the scenario.

        Raises:
            KeyError: The scenario has no such person.
        """
        return self._seen[name]

    @property
    def walkers(self) -> tuple[Walker, ...]:
        """People who are walking."""
        seen = (each for each in self._seen.values() if each.is_seen and is_walking(each.velocity))
        return tuple(Walker(each.person, each.velocity) for each in seen)

    def learn(self, name: str, *, distance_m: float, speed_m_s: float | None) -> None:
        """Set how a person wants the robot to move near them, as `SimRobot.learn`."""
        one = self._seen[name]
        person = replace(one.person, personal_distance_m=distance_m, approach_speed_m_s=speed_m_s)
        self._seen = {**self._seen, name: replace(one, person=person)}

    def take_in(
        self, tracks: Iterable[PersonTrack], eye: Pose, now_s: float, *, is_free: IsFree | None = None
    ) -> None:
        """Update with the newest tracks.

        Args:
            tracks: The tracks, with times since the start of the episode.
            eye: The robot's pose.
            now_s: The current time [s].
            is_free: Whether the floor around a position is seen to be free; None if the robot cannot tell.
        """
        named = {track.person: track for track in tracks if track.person in self._seen}
        self._seen = {
            name: _tracked(one, named[name], now_s) if name in named else self._unseen(one, eye, is_free)
            for name, one in self._seen.items()
        }
        self._missing.take_in(self._seen, eye, self._last_s)
        self._last_s = now_s

    def _unseen(self, before: Seen, eye: Pose, is_free: IsFree | None) -> Seen:
        """A person after a tick without a track of them."""
        if before.stamp_s is None:
            return before
        vanishes = before.has_vanished
        if before.is_seen:
            vanishes = is_walking(before.velocity) or self._sight.sees(eye, [before.person])[0]
        x, y, radius_m = before.person.x_m, before.person.y_m, before.person.radius_m
        if vanishes and is_free is not None and is_free(x, y, radius_m + GROWS_M):
            vanishes = False
        return replace(before, is_seen=False, has_vanished=vanishes)


def _tracked(before: Seen, track: PersonTrack, now_s: float) -> Seen:
    """A tracked person; without a known orientation they face where they walk, or as before."""
    (vx, vy), age_s = track.velocity_m_s, max(0.0, now_s - track.stamp_s)
    heading = before.person.heading_rad if track.heading_rad is None else track.heading_rad
    if track.heading_rad is None and is_walking((vx, vy)):
        heading = atan2(vy, vx)
    x_m, y_m = track.x_m + vx * age_s, track.y_m + vy * age_s
    person = replace(before.person, x_m=x_m, y_m=y_m, heading_rad=wrap_angle(heading))
    has_heading = track.heading_rad is not None
    return Seen(person, (vx, vy), is_seen=True, has_heading=has_heading, stamp_s=track.stamp_s)
