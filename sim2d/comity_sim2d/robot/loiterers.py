"""Passers-by who stand about: the robot goes round them as round anybody who stands, until they go on.

Whoever walks is let pass; to let somebody pass who stands would be to wait for as long as they like.
"""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from comity_sim2d.avoidance.right_of_way import PassersBySeen
from comity_sim2d.clock import Clock
from comity_sim2d.navigation.route_map import RouteMap
from comity_sim2d.scene.person import Person

STANDS_S, STANDS_M = 1.0, 0.1
"""Who has stayed within the second of one place for the first stands (our choice: nobody walks as slowly)."""
EVERY_TICKS = 5
"""So often is often enough to find out."""


class PassersByKnown(PassersBySeen, Protocol):
    """Passers-by, and how they face."""

    @property
    def poses(self) -> NDArray[np.float64]:
        """x, y and heading of each; shape (n, 3)."""
        ...


class Loiterers:
    """Those of the passers-by who stand.

    Args:
        passers_by: All of them; where they are is read anew at every look.
        clock: The ticks.
    """

    def __init__(self, passers_by: PassersByKnown, clock: Clock) -> None:
        self._passers_by, self._clock = passers_by, clock
        self._place = passers_by.at.copy()
        self._since_s = np.full(len(self._place), clock.now_s)
        self._stand = np.zeros(len(self._place), dtype=bool)
        self._people: tuple[Person, ...] = ()
        self._maps: tuple[RouteMap, tuple[Person, ...], RouteMap] | None = None
        self._due = clock.tick

    @property
    def names(self) -> tuple[str, ...]:
        """Of all passers-by."""
        return self._passers_by.names

    def look(self) -> tuple[Person, ...]:
        """Who stands now, where they came to stand; the same tuple as long as the same people stand."""
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

    def on(self, route_map: RouteMap) -> RouteMap:
        """A map with those on it who stand; the same map where nobody does."""
        people = self.look()
        if not people:
            return route_map
        if self._maps is None or self._maps[0] is not route_map or self._maps[1] is not people:
            place = route_map.surroundings
            self._maps = (route_map, people, RouteMap(place.with_people((*place.people, *people))))
        return self._maps[2]

    def _person(self, index: int) -> Person:
        x, y, heading = self._passers_by.poses[index].tolist()
        radius_m = float(self._passers_by.radius_m[index])
        return Person(self._passers_by.names[index], x, y, heading, radius_m)
