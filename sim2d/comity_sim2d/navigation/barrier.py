"""Barriers: people who block a path together, abreast or as groups with the space between them."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass

from comity_sim2d.pose import XY
from comity_sim2d.scene.surroundings import Surroundings

MOST_TRIED = 8
"""Maximum number of people of one barrier that are tested, the nearest ones (our choice)."""

Bars = Callable[[Collection[str]], bool]
"""Whether these people, if alone there, would leave no path."""


@dataclass(frozen=True, slots=True)
class _Disc:
    """A region closed to the robot's centre, and the person who closes it."""

    xy: XY
    radius_m: float
    names: tuple[str, ...]

    def touches(self, other: _Disc) -> bool:
        return math.dist(self.xy, other.xy) < self.radius_m + other.radius_m


def barrier(place: Surroundings, first: Collection[str], visited: str) -> tuple[str, ...]:
    """All people between whom the robot cannot pass, starting from those met first.

    Overlapping discs block a path from wall to wall, so the blocking people are among them.

    Args:
        place: The place with all people.
        first: The people met first.
        visited: The visited person, who never counts as obstructing.
    """
    discs = list(_discs(place, visited))
    found, last = set[str](), set(first)
    while last:
        found |= last
        reached = [disc for disc in discs if found.intersection(disc.names)]
        touched = (disc for disc in discs if any(disc.touches(other) for other in reached))
        last = {name for disc in touched for name in disc.names} - found
    return tuple(person.name for person in place.people if person.name in found)


def _discs(place: Surroundings, visited: str) -> Iterator[_Disc]:
    for person in place.people:
        if person.name != visited:
            reach = person.radius_m + place.robot_radius_m + person.margin_m
            yield _Disc(person.xy, reach, (person.name,))
    for space in place.o_spaces:
        members = tuple(name for name in space.members if name != visited)
        yield _Disc(space.xy, space.radius_m + place.robot_radius_m, members)


def who_bars(people: Sequence[str], bars: Bars) -> tuple[str, ...]:
    """Each person without whom the path would be free; else the fewest who have to move together."""
    alone = tuple(name for name in people if not bars([other for other in people if other != name]))
    if alone:
        return alone
    needed = list(people)
    for name in people:
        fewer = [other for other in needed if other != name]
        if not bars([other for other in people if other not in fewer]):
            needed = fewer
    return tuple(needed)
