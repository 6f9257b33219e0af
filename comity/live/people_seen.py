"""Whom a robot's tracker sees, and where everybody else was seen last."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from math import atan2, hypot
from typing import TYPE_CHECKING

from comity_sim2d.navigation.yielding import Walker, is_walking
from comity_sim2d.scene.obstacles import floor_plan
from comity_sim2d.senses.missing import Missing
from comity_sim2d.senses.sight import Sight

if TYPE_CHECKING:
    from comity_executor import PersonTrack
    from comity_sim2d import Person, Pose, Scene

STANDING = (0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Seen:
    """A person of the scenario as the robot knows them."""

    person: Person
    """Where they are, or were when they were seen last."""
    velocity: tuple[float, float] = STANDING
    """In m/s; of a person who is not seen, 0."""
    is_seen: bool = False
    """In the newest tracks."""
    stamp_s: float | None = None
    """When they were seen last, by the clock of the episode; None: never."""

    def ahead(self, seconds: float) -> Person:
        """Where they are so much later, at that velocity."""
        (vx, vy), person = self.velocity, self.person
        return replace(person, x_m=person.x_m + vx * seconds, y_m=person.y_m + vy * seconds)


class PeopleSeen:
    """Takes in what a tracker says, tick by tick.

    Args:
        scene: With everybody where they are taken to be before they are seen.
    """

    def __init__(self, scene: Scene) -> None:
        sensor = scene.robot.sensor
        self._seen: Mapping[str, Seen] = {person.name: Seen(person) for person in scene.people}
        self._missing = Missing(Sight(sensor, floor_plan(scene)), sensor.sigma_m)
        self._last_s: float | None = None

    @property
    def people(self) -> tuple[Person, ...]:
        """All people of the scenario where the robot believes them to be."""
        return tuple(each.person for each in self._seen.values())

    @property
    def present(self) -> tuple[Person, ...]:
        """Those whose places it knows."""
        return tuple(person for person in self.people if person.name not in self._missing.lost)

    @property
    def lost(self) -> Mapping[str, float | None]:
        """Who is not where they were seen last, although that place is in plain view, and since when [s]."""
        return dict(self._missing.lost)

    def of(self, name: str) -> Seen:
        """One person.

        Raises:
            KeyError: The scenario has no such person.
        """
        return self._seen[name]

    @property
    def walkers(self) -> tuple[Walker, ...]:
        """Who is under way."""
        return tuple(Walker(each.person, each.velocity) for each in self._seen.values() if self.walks(each))

    def walks(self, seen: Seen) -> bool:
        """Whether a person is under way."""
        return is_walking(seen.velocity)

    def learn(self, name: str, *, distance_m: float, speed_m_s: float | None) -> None:
        """Know how a person wants the robot to move near them, as `SimRobot.learn`."""
        one = self._seen[name]
        person = replace(one.person, personal_distance_m=distance_m, approach_speed_m_s=speed_m_s)
        self._seen = {**self._seen, name: replace(one, person=person)}

    def take_in(self, tracks: Iterable[PersonTrack], eye: Pose, now_s: float) -> None:
        """Take in the newest tracks.

        Args:
            tracks: Times by the clock of the episode.
            eye: Where the robot is.
            now_s: The time.
        """
        named = {track.person: track for track in tracks if track.person in self._seen}
        self._seen = {name: _after(one, named.get(name), now_s) for name, one in self._seen.items()}
        self._missing.take_in(self._seen, eye, self._last_s)
        self._last_s = now_s


def _after(before: Seen, track: PersonTrack | None, now_s: float) -> Seen:
    """A person after a tick; one whose heading is not known faces where they walk, or as before."""
    if track is None:
        return replace(before, velocity=STANDING, is_seen=False)
    (vx, vy), age_s = track.velocity_m_s, max(0.0, now_s - track.stamp_s)
    heading = before.person.heading_rad if track.heading_rad is None else track.heading_rad
    if track.heading_rad is None and is_walking((vx, vy)) and hypot(vx, vy) > 0.0:
        heading = atan2(vy, vx)
    person = replace(
        before.person, x_m=track.x_m + vx * age_s, y_m=track.y_m + vy * age_s, heading_rad=heading
    )
    return Seen(person, (vx, vy), is_seen=True, stamp_s=track.stamp_s)
