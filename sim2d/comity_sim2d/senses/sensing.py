"""The robot's knowledge about people: filtered, delayed estimates of their poses."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Collection, Mapping
from dataclasses import replace

import numpy as np

from comity_fis.proxemics import PERSON_MARGIN_M
from comity_sim2d.clock import Clock
from comity_sim2d.navigation.yielding import Walker, is_walking
from comity_sim2d.pose import XY, Pose, direction_to
from comity_sim2d.scene.obstacles import FloorPlan
from comity_sim2d.scene.person import Person, find_person
from comity_sim2d.scene.robot_body import Sensor
from comity_sim2d.senses.active_faults import SENSORS, ActiveFaults
from comity_sim2d.senses.missing import Missing
from comity_sim2d.senses.sight import Sight, too_short_for
from comity_sim2d.senses.tracking import Track
from comity_sim2d.senses.visibility_memory import Numbers, VisibilityMemory, WalkedOut

DRIFTS_M_S = 0.05
"""A person who seems to move more slowly than this may stand [m/s]: noise, or shuffling feet (our choice)."""


class SensedPeople:
    """The robot's belief about every person, updated once per tick.

    Args:
        sensor: Noise and delay.
        sight: Determines which people it can see.
        mapped: All people as on the map of the scene.
        people: All people at their true poses; the world replaces those who move.
        clock: Simulated time.
        seed: Seed of the noise.
        faults: Active faults; with a sensor fault the robot sees no one.
    """

    def __init__(
        self,
        sensor: Sensor,
        sight: Sight,
        mapped: tuple[Person, ...],
        people: Mapping[str, Person],
        *,
        clock: Clock,
        seed: int,
        faults: ActiveFaults | None = None,
    ) -> None:
        self._sensor = sensor
        self._faults = faults or ActiveFaults()
        self._sight = sight
        self._people = people
        self._clock = clock
        self._rng = np.random.Generator(np.random.PCG64(seed))
        self._on_the_way: deque[tuple[list[Person | None], Pose | None]] = deque()
        self._lag = round(sensor.delay_s * clock.hz)
        self._tracks = {person.name: Track(sensor, clock.step_s, person) for person in mapped}
        self._missing = Missing(sight, sensor.sigma_m)
        self._told: dict[str, dict[str, float | None]] = {}
        """What people asked of the robot's movement near them, replacing the values of the map."""
        self._margin_m: dict[str, float] = {}
        """Margins of the people with less than the full margin [m]."""
        self._believed = self._present = mapped
        self._walkers: tuple[Walker, ...] = ()
        self._stamp_s: float | None = None
        self._floor = VisibilityMemory(sensor)
        self._looked_at = VisibilityMemory(sensor) if self._lag else self._floor
        self.sees_all_round = sensor.field_of_view_deg >= 360.0
        """Whether its field of view is 360 deg; otherwise it remembers what it saw."""

    @property
    def stamp_s(self) -> float | None:
        """Time of the newest available measurement [s]; None before the first."""
        return self._stamp_s

    @property
    def noise_m(self) -> float:
        """Standard deviation of one measurement per axis [m]."""
        return self._sensor.sigma_m

    @property
    def people(self) -> tuple[Person, ...]:
        """All people at their believed positions now; before the first measurement, as mapped.

        A lost person is placed where they were last seen.
        """
        return self._believed

    @property
    def present(self) -> tuple[Person, ...]:
        """People whose positions are known, each with the current margin to them."""
        return self._present

    @property
    def walkers(self) -> tuple[Walker, ...]:
        """People who walk."""
        return self._walkers

    def observe(self, robot: Pose, felt: Collection[str] = ()) -> None:
        """Measure all people in view, or just touched, and process the measurements that arrive now."""
        people = tuple(self._people.values())
        eye = None if self._faults.of(SENSORS) else robot
        seen = zip(people, self._sight.sees(robot, people), strict=True)
        arrived = [
            self._measure(person) if eye and (is_seen or person.name in felt) else None
            for person, is_seen in seen
        ]
        if self._lag:
            if eye is not None and not self.sees_all_round:
                self._looked_at.take_in(eye, self._clock.now_s)
            self._on_the_way.append((arrived, eye))
            if len(self._on_the_way) <= self._lag:
                return
            arrived, eye = self._on_the_way.popleft()
        before_s, self._stamp_s = self._stamp_s, (self._clock.tick - self._lag) / self._clock.hz
        if eye is not None and not self.sees_all_round:
            self._floor.take_in(eye, self._stamp_s)
        changed = [track.update(seen) for track, seen in zip(self._tracks.values(), arrived, strict=True)]
        if self._missing.take_in(self._tracks, eye, before_s) or any(changed):
            self._believe()
        if not self.sees_all_round:
            self._doubt_floor()

    def _doubt_floor(self) -> None:
        """Invalidate free floor that people who walked out of view may have reached."""
        for name, unseen in self._missing.unseen.items():
            track = self._tracks[name]
            if unseen.last_s is not None and is_walking(track.last_velocity):
                out = WalkedOut(track.ahead(0.0).xy, track.last_velocity, unseen.last_s)
                for floor in {self._floor, self._looked_at}:
                    floor.doubt(out, self._clock.now_s)

    def _believe(self) -> None:
        """Update the believed positions of all people from their tracks."""
        ahead_s, lost = self._lag * self._clock.step_s, self._missing.lost
        self._believed = tuple(self._as_told(track.ahead(ahead_s)) for track in self._tracks.values())
        moving = zip(self._believed, self._tracks.values(), strict=True)
        self._walkers = tuple(
            Walker(person, track.velocity) for person, track in moving if is_walking(track.velocity)
        )
        self._present = (
            tuple(self._let_pass(person) for person in self._believed if person.name not in lost)
            if lost or self._margin_m
            else self._believed
        )

    def _as_told(self, person: Person) -> Person:
        told = self._told.get(person.name)
        return person if told is None else _as(person, told)

    def _let_pass(self, person: Person) -> Person:
        margin_m = self._margin_m.get(person.name)
        return person if margin_m is None else replace(person, margin_m=margin_m)

    def learn(self, name: str, *, distance_m: float, speed_m_s: float | None) -> None:
        """Store how a person wants the robot to move near them, wherever they are.

        Args:
            name: Name of the person.
            distance_m: Distance for passing them, between the surfaces [m].
            speed_m_s: Maximum speed within 1.5 m of their body, as they asked [m/s]; None: they did not.

        Raises:
            SceneError: For an invalid distance or speed.
            ValueError: If there is no such person.
        """
        told = {"personal_distance_m": distance_m, "approach_speed_m_s": speed_m_s}
        _as(self.person(name), told)  # refuses invalid values
        self._told[name] = told
        self._believe()

    def keep(self, name: str, margin_m: float) -> None:
        """Change the margin to a person, between the surfaces [m], wherever they are."""
        if margin_m < PERSON_MARGIN_M:
            self._margin_m[name] = margin_m
        else:
            self._margin_m.pop(name, None)
        self._believe()

    def sees(self, name: str) -> bool:
        """Whether the newest available measurement shows a person; if not, they are believed to stay."""
        return self._stamp_s is not None and self._tracks[name].is_seen

    def too_short_for(self, apart_m: float) -> str | None:
        """Why its sensor might not show a person at a distance, in words; None if it would.

        Args:
            apart_m: Distance from the robot's centre to the surface of the person's body [m].
        """
        return too_short_for(self._sensor, apart_m)

    def would_see(self, name: str, robot: XY) -> bool:
        """Whether a look from there would check the believed place of an unseen person."""
        if self.sees(name) or self.has_lost(name):
            return False
        person = self.person(name)
        return self._sight.is_plain(Pose(*robot, direction_to(robot, person.xy)), person, self.noise_m)

    def has_to_watch(self, name: str, robot: XY) -> bool:
        """Whether it has to face a person from there to notice that they leave (no all-round view).

        Passers-by are known in all directions.
        """
        if self.sees_all_round or name not in self._tracks:
            return False
        return self.sees(name) or self.would_see(name, robot)

    @property
    def lost(self) -> frozenset[str]:
        """People known not to be at their believed place."""
        return frozenset(self._missing.lost)

    def has_lost(self, name: str) -> bool:
        """Whether a person is lost."""
        return name in self._missing.lost

    def last_seen_s(self, name: str) -> float | None:
        """Time when a lost person was last seen [s]; None: never."""
        return self._missing.lost[name]

    def unseen_floor(self, xy: XY, for_s: float, within_m: float) -> Numbers:
        """Places around a point that were not in view for some time; shape (n, 2) [m]."""
        since_s = self._clock.now_s - self._lag * self._clock.step_s - for_s
        return self._floor.unseen(xy, since_s, within_m)

    def floor_to_look_at(self, xy: XY, for_s: float, within_m: float) -> Numbers:
        """Those of them for which no measurement is pending either; shape (n, 2) [m]."""
        return self._looked_at.unseen(xy, self._clock.now_s - for_s, within_m)

    def use_plan(self, plan: FloorPlan) -> None:
        """Replace the floor plan."""
        self._sight.use_plan(plan)

    def person(self, name: str) -> Person:
        """One person at their believed pose."""
        return find_person(self._believed, name)

    def heading_rad(self, name: str) -> float:
        """Believed heading of a person [rad]."""
        return self.person(name).heading_rad

    def velocity(self, name: str) -> tuple[XY, float]:
        """The person's believed velocity [m/s] and turning rate [rad/s]."""
        track = self._tracks[name]
        return track.velocity, track.turn_rad_s

    def walks(self, name: str) -> bool:
        """Whether a person is believed to be walking."""
        return math.hypot(*self._tracks[name].velocity) >= DRIFTS_M_S

    def velocity_beside(self, name: str, spot: XY) -> XY:
        """Velocity of a place next to a person as they walk and turn [m/s]."""
        x, y = self.person(name).xy
        (vx, vy), turn = self.velocity(name)
        return (vx - turn * (spot[1] - y), vy + turn * (spot[0] - x))

    def speed_beside(self, name: str, robot: Pose, velocity: XY) -> float:
        """Speed of the robot [m/s]: over the ground or relative to a walking person, whichever is less."""
        speed = math.hypot(*velocity)
        if not self.walks(name):
            return speed
        return min(speed, math.dist(velocity, self.velocity_beside(name, robot.xy)))

    def _measure(self, person: Person) -> Person:
        if self._sensor.sigma_m == 0.0:
            return person
        dx, dy = self._rng.normal(0.0, self._sensor.sigma_m, 2)
        return replace(person, x_m=person.x_m + float(dx), y_m=person.y_m + float(dy))


def _as(person: Person, told: Mapping[str, float | None]) -> Person:
    return replace(
        person,
        personal_distance_m=told["personal_distance_m"],
        approach_speed_m_s=told["approach_speed_m_s"],
    )
