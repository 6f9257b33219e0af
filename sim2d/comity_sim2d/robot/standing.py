"""Standing people: routes lead around them. The robot reacts to moving people tick by tick.

Routes are planned among static obstacles, as by the global planner of a navigation stack. So the route map
contains standing people, and changes only when they do.
"""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import replace
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from comity_sim2d.avoidance.right_of_way import PassersBySeen
from comity_sim2d.clock import Clock
from comity_sim2d.navigation.route_map import RouteMap
from comity_sim2d.navigation.yielding import Walker
from comity_sim2d.pose import XY
from comity_sim2d.scene.obstacles import FloorPlan
from comity_sim2d.scene.person import Person
from comity_sim2d.senses.sensing import SensedPeople

STANDS_S = 1.0
"""Time without walking after which a person stands [s] (our choice)."""
STANDS_M = 0.1
"""A passer-by who stays within this distance of one place for `STANDS_S` stands [m] (our choice)."""
ROCKS_S, ROCKS_M = 3.0, 0.7
"""A person within `ROCKS_M` of one place for `ROCKS_S` stands, even if walking to and fro (our choice)."""
HELD_UP_S = 2.0
"""Waiting time of the robot after which a person counts as standing [s] (our choice)."""
LONGEST_HELD_S, FORGETS = 4.0, 0.2
"""Maximum counted waiting time [s], and its decrease per second without waiting [s]."""
EVERY_TICKS = 5
"""Interval of that check for passers-by [control ticks]."""
RENEWS_S = 0.5
"""Minimum time between changes of the map [s]."""
MOVED_M = 0.02
"""A standing person who has moved by more than this is mapped again [m]; sensor noise is added."""


class PassersByKnown(PassersBySeen, Protocol):
    """Passers-by with their headings."""

    @property
    def poses(self) -> NDArray[np.float64]:
        """Positions x and y [m] and heading [rad] of each; shape (n, 3)."""
        ...


class DetourMap:
    """A map of routes around standing people.

    Args:
        senses: Believed positions of people.
        clock: Simulated time.
        route_map: The map at the start.
    """

    def __init__(self, senses: SensedPeople, clock: Clock, route_map: RouteMap) -> None:
        self._senses, self._clock = senses, clock
        self.map = route_map
        self._renewed_s = -math.inf
        self._walked_s: dict[str, float] = {}
        """When each person last walked [s]."""
        self._place: dict[str, tuple[XY, float]] = {}
        """Reference place of each walking person, and since when they have stayed near it [s]."""
        self._held_s: dict[str, float] = {}
        """How long each person has recently blocked the robot [s]."""
        self._counted: set[str] = set()
        self._loiterers: Loiterers | None = None

    def let_pass(self, passers_by: PassersByKnown) -> None:
        """Include standing passers-by."""
        self._loiterers = Loiterers(passers_by, self._clock)

    @property
    def passers_by(self) -> tuple[str, ...]:
        """The names of all passers-by."""
        return self._loiterers.names if self._loiterers else ()

    def look(self, visited: str, waits_for: Collection[str], *, lets_by: str | None, waits: bool) -> RouteMap:
        """The current map; the same object until a standing person has changed. Call it in every tick.

        Args:
            visited: The person the robot visits, who is on the map even while walking.
            waits_for: People the robot waits for in this tick. After a while they count as standing, too: a
                person who walks to and fro in the only doorway can be asked to make way.
            lets_by: The person for whom the robot is about to back out; a passer-by is then not on the map.
            waits: Whether the robot waits for the path to become free.
        """
        now_s = self._clock.now_s
        for walker in self._senses.walkers:
            self._note_walk(walker.person, now_s)
        self._note_waiting(waits_for)
        if now_s - self._renewed_s >= RENEWS_S - 1e-9:
            people = self._mapped(visited, lets_by)
            noise_m = 0.0 if waits else 3.0 * self._senses.noise_m  # it may be waiting because of noise
            if differ(people, self.map.surroundings.people, MOVED_M + noise_m):
                self.map = RouteMap(self.map.surroundings.with_people(people))
                self._renewed_s = now_s
        return self.map

    def _note_walk(self, person: Person, now_s: float) -> None:
        if person.name not in self._place or math.dist(self._place[person.name][0], person.xy) > ROCKS_M:
            self._place[person.name] = (person.xy, now_s)
        if now_s - self._place[person.name][1] < ROCKS_S:
            self._walked_s[person.name] = now_s

    def touched(self, person: str) -> None:
        """Count a touched person as standing for a while."""
        self._held_s[person] = LONGEST_HELD_S
        self._counted.add(person)

    def _note_waiting(self, waits_for: Collection[str]) -> None:
        step_s = self._clock.step_s
        for name in {*waits_for, *self._held_s}:
            held_s = self._held_s.get(name, 0.0) + step_s * (1.0 if name in waits_for else -FORGETS)
            if held_s <= 0.0:
                del self._held_s[name]
                self._counted.discard(name)
                continue
            self._held_s[name] = min(held_s, LONGEST_HELD_S)
            if held_s >= HELD_UP_S:
                self._counted.add(name)

    def movers(self, visited: str) -> list[Walker]:
        """People of the scene, except the visited person, who are not on the map or walked recently."""
        mapped = {person.name for person in self.map.surroundings.people}
        walking = {walker.person.name: walker for walker in self._senses.walkers}
        mapped -= {*walking, *(name for name in self._walked_s if self._has_just_walked(name))}
        return [
            walking.get(person.name) or Walker(person, (0.0, 0.0))
            for person in self._senses.present
            if person.name != visited and person.name not in mapped
        ]

    def standing_people(self) -> list[Person]:
        """People on the map who stand, where they are believed to be."""
        walking = {walker.person.name for walker in self._senses.walkers}
        present = {person.name: person for person in self._senses.present}
        return [
            present.get(person.name, person)
            for person in self.map.surroundings.people
            if person.name not in walking and not self._has_just_walked(person.name)
        ]

    def everybody(self) -> RouteMap:
        """The map with all people whose position is known."""
        people = (*self._senses.present, *(self._loiterers.look() if self._loiterers else ()))
        if not differ(people, self.map.surroundings.people, 0.0):
            return self.map
        return RouteMap(self.map.surroundings.with_people(people))

    def use_plan(self, plan: FloorPlan) -> None:
        """Replace the static obstacles."""
        self.map = RouteMap(replace(self.map.surroundings, plan=plan))

    def _mapped(self, visited: str, lets_by: str | None) -> tuple[Person, ...]:
        stand = (
            person
            for person in self._senses.present
            if person.name == visited
            or person.name in self._counted
            or not self._has_just_walked(person.name)
        )
        loiterers = self._loiterers.look() if self._loiterers else ()
        return (*stand, *(person for person in loiterers if person.name != lets_by))

    def _has_just_walked(self, person: str) -> bool:
        return self._clock.now_s - self._walked_s.get(person, -math.inf) < STANDS_S - 1e-9


def differ(some: tuple[Person, ...], others: tuple[Person, ...], tolerance_m: float) -> bool:
    """Whether two sets of people differ in name, heading, passing distance, or position by a tolerance."""
    if len(some) != len(others):
        return True
    return any(_differs(one, other, tolerance_m) for one, other in zip(some, others, strict=True))


def _differs(one: Person, other: Person, tolerance_m: float) -> bool:
    if one is other:
        return False
    if _kept(one) != _kept(other):
        return True
    return math.dist(one.xy, other.xy) > tolerance_m


def _kept(person: Person) -> tuple[object, ...]:
    """The attributes of a person that determine the space routes keep, except the position."""
    return person.name, person.heading_rad, person.personal_distance_m, person.margin_m


class Loiterers:
    """The passers-by who stand.

    Args:
        passers_by: All passers-by; their positions are read again at every call.
        clock: Simulated time.
    """

    def __init__(self, passers_by: PassersByKnown, clock: Clock) -> None:
        self._passers_by, self._clock = passers_by, clock
        self._place = passers_by.at.copy()
        self._since_s = np.full(len(self._place), clock.now_s)
        self._stand = np.zeros(len(self._place), dtype=bool)
        self._people: tuple[Person, ...] = ()
        self._due = clock.tick

    @property
    def names(self) -> tuple[str, ...]:
        """Names of all passers-by."""
        return self._passers_by.names

    def look(self) -> tuple[Person, ...]:
        """Passers-by who stand, at their places; the same tuple as long as the same people stand."""
        if self._clock.tick < self._due:
            return self._people
        self._due = self._clock.tick + EVERY_TICKS
        at, now_s = self._passers_by.at, self._clock.now_s
        moved = np.abs(at - self._place) > STANDS_M
        self._place[moved], self._since_s[moved] = at[moved], now_s
        stand = now_s - self._since_s >= STANDS_S - 1e-9
        if not np.array_equal(stand, self._stand):
            self._stand = stand
            self._people = tuple(self._person(i) for i in np.flatnonzero(stand).tolist())
        return self._people

    def _person(self, index: int) -> Person:
        x, y, heading = self._passers_by.poses[index].tolist()
        radius_m = float(self._passers_by.radius_m[index])
        return Person(self._passers_by.names[index], x, y, heading, radius_m)
