"""Stepping aside: a robot in the path of an approaching person moves off their line, to the free side.

If it retreated instead, both would move to where the walk ends, possibly into a corner. The robot takes the
best direction that `foresight.py` finds; a two-wheeled base sets out early, or in a direction for which it
need not turn first.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterable, Iterator, Mapping, Sequence

import numpy as np

from comity_sim2d.avoidance.foresight import (
    FAR_M,
    HORIZON_S,
    IN_THE_WAY_M,
    OUT_M,
    ApproachingPerson,
    CandidateDirection,
    Foresight,
)
from comity_sim2d.avoidance.oncoming import COMES_S
from comity_sim2d.base.base import Base, VelocityCommand
from comity_sim2d.navigation.yielding import Walker
from comity_sim2d.pose import XY
from comity_sim2d.scene.obstacles import FloorPlan
from comity_sim2d.scene.person import Person

LEAST_M = 0.02
"""With a smaller gap it does not set out in front of an approaching person [m]: a robot at rest is no
surprise."""
STANDS_M = 0.25
"""A person who approached and stands nearer than this waits for the robot [m]: the robot never stops so
near."""
WAITS_S = 1.0
"""Time for which a person who stood still counts as waiting [s]: they go on as soon as they can, bit by
bit."""
AHEAD_M = 1.5
"""Length of the line that is kept free ahead of a waiting person [m]."""
DRIFTS_M_S = 0.3
"""The robot follows a visited person who approaches more slowly than this, and does not step aside [m/s] (our
choice)."""
MAY_COME, FORGETS_S = 10, 60.0
"""The robot steps aside for the same person at most `MAY_COME` times within `FORGETS_S` [s], unless they wait
for it (our choice)."""
OFF_COURSE = np.radians([45.0, 60.0, 75.0, 90.0, 105.0, 120.0, 135.0, 150.0])
"""Directions to try on either side, relative to the course of the approaching person [rad]."""
TOWARDS = 0.1
"""Penalty for moving against their course [m]."""
SAME_WAY = 0.05
"""Margin by which another direction must be better than the current one [m]."""


class SteppingAside:
    """Keeps one robot off the lines of approaching people.

    Args:
        radius_m: Radius of the robot [m].
    """

    def __init__(self, radius_m: float) -> None:
        self._radius_m = radius_m
        self._now_s = 0.0
        self._courses: dict[str, XY] = {}
        """Courses of the people who approached, by name; unit vectors."""
        self._still_s: dict[str, float] = {}
        """When each person near the robot last stood still [s]."""
        self._waited_s: dict[str, float] = {}
        """When each person last stood in front of the robot [s]."""
        self._begun_s: dict[str, deque[float]] = {}
        """When it last stepped aside, by person [s]."""
        self._before: frozenset[str] = frozenset()
        """The people for whom it steps aside."""
        self._direction: XY = (0.0, 0.0)

    def velocity(
        self,
        base: Base,
        wanted: VelocityCommand,
        walkers: Iterable[Walker],
        people: Sequence[Person],
        plan: FloorPlan,
        *,
        approached: str | None,
    ) -> XY | None:
        """The velocity that steps aside; None where the velocity command is enough.

        Args:
            base: Current motion of the robot's base.
            wanted: The velocity command.
            walkers: People who walk.
            people: All people.
            plan: The static obstacles.
            approached: The person whose docking pose the robot is going to, if there is a route.
        """
        self._now_s += base.step_s
        moving = {walker.person.name: walker.velocity for walker in walkers}
        comers = list(self._comers(base.xy, moving, people, approached))
        self._before &= {comer.person.name for comer in comers}
        if not comers:
            return None
        scene = Foresight(base, self._radius_m, moving, people, comers=comers, plan=plan)
        in_way = frozenset(
            comer.person.name
            for comer in comers
            if scene.is_in_the_way(comer, OUT_M if comer.person.name in self._before else IN_THE_WAY_M)
        )
        if not in_way or scene.is_fine(wanted.velocity):
            return None
        return self._aside(scene, in_way)

    def _aside(self, scene: Foresight, in_way: frozenset[str]) -> XY | None:
        """The velocity in the best direction [m/s]; None if no direction helps."""
        lead = next(comer for comer in scene.comers if comer.person.name in in_way)
        ways = scene.tried(_directions(lead.course, scene.base), in_way)
        going = in_way & self._before
        least_m = -math.inf if going else LEAST_M
        open_ways = [way for way in ways if way.gap_m >= least_m and way.speed_m_s > 0.0]
        best = max(open_ways, key=lambda way: self._worth(way, lead), default=None)
        if best is None or self._worth(best, lead) <= scene.score_at_rest(in_way) + SAME_WAY:
            return None
        for name in in_way - self._before:
            self._begun_s.setdefault(name, deque(maxlen=MAY_COME)).append(self._now_s)
        self._before |= in_way
        self._direction = best.direction
        return (best.direction[0] * best.speed_m_s, best.direction[1] * best.speed_m_s)

    def _worth(self, way: CandidateDirection, lead: ApproachingPerson) -> float:
        """Score [m]: gain, penalty for moving against their course, bonus for the current direction."""
        against = TOWARDS * min(_cos(way.direction, lead.course), 0.0)
        return way.score_m + against + (SAME_WAY if _cos(way.direction, self._direction) > 0.9 else 0.0)

    def _comers(
        self, xy: XY, moving: Mapping[str, XY], people: Sequence[Person], approached: str | None
    ) -> Iterator[ApproachingPerson]:
        """People who approach the robot, and people who have arrived and wait."""
        for person in people:
            velocity = moving.get(person.name, (0.0, 0.0))
            speed = math.hypot(*velocity)
            if speed:
                self._courses[person.name] = (velocity[0] / speed, velocity[1] / speed)
            else:
                self._still_s[person.name] = self._now_s
            if person.name not in self._courses:
                continue  # as most people stand, and have not come
            gap_m = person.gap_m(xy, self._radius_m)
            if not speed and gap_m > AHEAD_M:
                del self._courses[person.name]
                continue
            course = self._courses[person.name]
            if gap_m > FAR_M + speed * HORIZON_S or not _is_ahead(person, course, xy):
                continue
            if gap_m < STANDS_M and not speed:
                self._waited_s[person.name] = self._now_s
            waited_s = self._now_s - self._waited_s.get(person.name, -math.inf)
            if gap_m < 2 * STANDS_M and waited_s <= WAITS_S:
                yield ApproachingPerson(person, course, (0.0, 0.0))
                continue
            walked_s = self._now_s - self._still_s.get(person.name, -math.inf)
            drifts = person.name == approached and speed <= DRIFTS_M_S
            if walked_s >= COMES_S and not drifts and self._is_to_be_let_by(person.name):
                yield ApproachingPerson(person, course, velocity)

    def _is_to_be_let_by(self, name: str) -> bool:
        """Whether the person waits for the robot, or has not made it step aside too often recently."""
        begun_s: Sequence[float] = self._begun_s.get(name, ())
        often = len(begun_s) == MAY_COME and self._now_s - begun_s[0] < FORGETS_S
        return name in self._before or not often


def _directions(course: XY, base: Base) -> list[XY]:
    """Directions to step aside, and those for which a two-wheeled base need not turn."""
    along = math.atan2(course[1], course[0])
    angles = [along + sign * float(off) for off in OFF_COURSE[::-1] for sign in (1.0, -1.0)]
    if base.turns_to_go:
        angles += [base.pose.heading_rad, base.pose.heading_rad + math.pi]
    return [(math.cos(angle), math.sin(angle)) for angle in angles]


def _is_ahead(person: Person, course: XY, xy: XY) -> bool:
    return (xy[0] - person.x_m) * course[0] + (xy[1] - person.y_m) * course[1] > 0.0


def _cos(one: XY, other: XY) -> float:
    return one[0] * other[0] + one[1] * other[1]
