"""The gap next to people that is too narrow for the robot if they block all routes, and the width needed.

The margin to people is lowered, by bisection, until there is a path; if none exists, the robot's radius is.
The gap that opens then is the widest blocking one. Static obstacles keep their margin.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from operator import itemgetter
from typing import TYPE_CHECKING

import numpy as np

from comity_fis.listing import with_verb
from comity_fis.proxemics import PERSON_MARGIN_M
from comity_sim2d import RouteMap
from comity_sim2d.navigation.route_map import SLACK_M
from comity_sim2d.pose import XY
from comity_sim2d.robot.reduced_margin import could_pass
from comity_sim2d.scene.obstacles import WALL_MARGIN_M, floor_plan
from comity_sim2d.scene.surroundings import Surroundings

if TYPE_CHECKING:
    from comity_sim2d import Scene
    from comity_sim2d.scene.person import Person

MOST_GOALS = 4
"""Places to stand that are tried: beside one person, nearly all open at the same gap (our choice)."""
STEP_M = 0.002
"""To this the margin is found at which a path opens [m] (our choice)."""
THINNEST_M = 0.02
"""Radius of the thinnest robot that is tried [m] (our choice)."""
POLYGON_M = 0.002
"""Routes keep up to so much more from a wall: a circle is a polygon to them [m]."""
TINY_CM = 1e-6
"""Floating-point error that rounding disregards [cm]."""
SAME_M = 0.02
"""A gap that would open by a margin so near to that is the one [m]: paths keep off by up to so much more."""


@dataclass(frozen=True, slots=True)
class NarrowGap:
    """A gap that the robot does not get through."""

    people: tuple[str, ...]
    """The two on both sides; or one, and something that stands on the other."""
    width_m: float
    """Between surfaces."""
    needed_m: float
    """The robot's width and the full margins on both sides."""
    passable: tuple[str, ...] = ()
    """Which of the two people the robot may pass at the scenario's margin, if they let it."""
    margin_m: float = PERSON_MARGIN_M
    """The scenario's margin."""

    @property
    def needed_past_them_m(self) -> float:
        """The same where all who are passable let the robot pass."""
        return self.needed_m - len(self.passable) * (PERSON_MARGIN_M - self.margin_m)

    @property
    def where(self) -> str:
        """Where it is, in words."""
        one, *other = self.people
        return f"between {one} and {other[0]}" if other else f"beside {one}"

    @property
    def words(self) -> str:
        """Where it is, its width, and the widths that the robot needs."""
        needed = f"{self._suffices_cm(self.needed_m) / 100:.2f} m"
        told = f"the widest gap, {self.where}, is {self._width_cm / 100:.2f} m, and the robot needs {needed}"
        if not self.passable:
            return told
        past_them = f"{self._suffices_cm(self.needed_past_them_m) / 100:.2f} m"
        let = with_verb(self.passable, "lets", "let")
        return f"{told}, or {past_them} where {let} it pass at {self.margin_m:.2f} m"

    @property
    def lacks_cm(self) -> int:
        """The difference of the widths in `words` [cm]; 0 if people who let the robot pass suffice."""
        if self.needed_past_them_m + self._more_m <= self.width_m:
            return 0
        return self._suffices_cm(self.needed_past_them_m) - self._width_cm

    @property
    def lacks(self) -> str:
        """The same in words, after the widths; empty for 0."""
        return f"{self.words}; make it {self.lacks_cm} cm wider" if self.lacks_cm else ""

    @property
    def _more_m(self) -> float:
        """What routes need beyond that: of two people each `SLACK_M`; beside a wall it is off at the wall."""
        return 2 * SLACK_M if len(self.people) == 2 else POLYGON_M

    @property
    def _width_cm(self) -> int:
        """The width, rounded down, so that a gap that is too narrow never reads as wide enough [cm]."""
        return math.floor(100 * self.width_m + TINY_CM)

    def _suffices_cm(self, needed_m: float) -> int:
        """A needed width with all that routes need, rounded up [cm]."""
        return math.ceil(100 * (needed_m + self._more_m) - TINY_CM)


def narrow_gap(
    scene: Scene, visited: str, goals: Sequence[XY], *, beside_visited: bool = False
) -> NarrowGap | None:
    """The widest gap beside people that is too narrow; None where no lower margin would give a way.

    Args:
        scene: As everything is: people bar every way.
        visited: The person whom the robot visits; it never passes them at the scenario's margin.
        goals: Where the robot could stand, had it a way there; the first few are tried.
        beside_visited: Whether gaps beside the visited person count, too.
    """
    place, start = Surroundings.of(scene), scene.robot.pose.xy

    def opens(spare_m: float) -> bool:
        people = tuple(replace(person, margin_m=max(spare_m, 0.0)) for person in scene.people)
        thinner = replace(place, robot_radius_m=place.robot_radius_m + min(spare_m, 0.0))
        ways = RouteMap(thinner.with_people(people))
        return any(ways.reaches(start, goal) for goal in goals[:MOST_GOALS])

    tried = np.arange(THINNEST_M - scene.robot.radius_m, PERSON_MARGIN_M, STEP_M).tolist()
    open_until = bisect_left(tried, True, key=lambda spare_m: not opens(spare_m))
    if not open_until:
        return None
    opens_m = tried[open_until - 1] + STEP_M / 2
    near = (
        (abs(spare_m - opens_m), gap)
        for spare_m, gap in _gaps(scene, visited)
        if beside_visited or visited not in gap.people
    )
    off_m, gap = min(near, key=itemgetter(0))
    return gap if off_m <= SAME_M else None


def _gaps(scene: Scene, visited: str) -> Iterator[tuple[float, NarrowGap]]:
    """All gaps beside people, each with the margin to people that would let the robot through [m].

    Where the gap is narrower than the robot, it is how much smaller its radius would have to be, negative.
    """
    body_m, margin_m = 2 * scene.robot.radius_m, scene.robot.margin_m
    people = scene.people
    passable = {person.name for person in people if could_pass(scene.robot, person)} - {visited}

    def gap_of(width_m: float, needed_m: float, *names: str) -> NarrowGap:
        return NarrowGap(
            names, width_m, needed_m, tuple(name for name in names if name in passable), margin_m
        )

    for one, other in combinations(people, 2):
        width_m = math.dist(one.xy, other.xy) - one.radius_m - other.radius_m
        needed_m = body_m + 2 * PERSON_MARGIN_M
        yield (width_m - body_m) / 2, gap_of(width_m, needed_m, one.name, other.name)
    beside_m = body_m + WALL_MARGIN_M
    for person in people:
        for width_m in _to_solids_m(scene, person):
            spare_m = width_m - beside_m
            gap = gap_of(width_m, beside_m + PERSON_MARGIN_M, person.name)
            yield spare_m if spare_m >= 0.0 else spare_m / 2, gap


def _to_solids_m(scene: Scene, person: Person) -> list[float]:
    """How far everything that stands is from a person's surface, side by side of it."""
    from shapely import Point, distance, linestrings

    sides = floor_plan(scene).segments
    away_m = distance(linestrings(sides.ends), Point(person.xy)) - sides.half_m - person.radius_m
    return [float(gap_m) for gap_m in away_m]
