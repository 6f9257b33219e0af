"""Stepping aside: a robot in the way of somebody who comes leaves their line, to the side that is free.

Going back before them instead would take both of them to where the walk ends, and into a corner if it ends
in one. The robot tries some directions out against where everybody will be, as the dynamic window does (Fox,
Burgard and Thrun 1997, "The dynamic window approach to collision avoidance"), each with the time that its
base takes to turn and to get going: two wheels set out in time, or where they need not turn first.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from comity_sim2d.base import Base, Wanted
from comity_sim2d.drive import MAX_TURN_RAD_S, NEAR_PEOPLE_M_S, SPEED_SHARE, stopping_speed
from comity_sim2d.obstacles import PERSON_MARGIN_M, FloorPlan
from comity_sim2d.pose import XY
from comity_sim2d.scene import Person
from comity_sim2d.yielding import Walker

HORIZON_S, STEP_S = 3.0, 0.25
"""People are taken to walk on straight for so long; it is looked at in steps."""
IN_THE_WAY_M, OUT_M = 0.15, 0.25
"""Whoever would come nearer than the first finds the robot in their way, until they would pass at the second
(our choice: a walk stops 0.10 m before it; a robot stands 0.30 m from people at least)."""
PASSES_M = 0.1
"""A way that ends nearer to their line leaves them no way."""
LEAST_M = 0.02
"""With less than this left it does not set out before somebody who comes: at rest it is no surprise."""
STANDS_M = 0.25
"""Who came at the robot and stands nearer than this waits for it: it never stands so near by itself."""
WAITS_S = 1.0
"""Who waited goes on as soon as they can, a little at a time, and is waited for by the robot no sooner."""
AHEAD_M = 1.5
"""So far ahead of somebody who waits their line is kept free."""
COMES_S = 0.35
"""Who has walked for less may only lean in, or step up (our choice)."""
DRIFTS_M_S = 0.3
"""Who is approached and comes more slowly is followed, and not left (our choice)."""
MAY_COME, FORGETS_S = 2, 60.0
"""So often within this time it steps aside for the same person, unless they wait for it (our choice)."""
NEAR_WALL_M = 0.03
FAR_M, MARK_M = 1.5, 0.1
"""Ways aside are looked at so far, at marks so far apart."""
OFF_COURSE = np.radians([45.0, 60.0, 75.0, 90.0, 105.0, 120.0, 135.0, 150.0])
"""Directions to try on either side, off the course of whoever comes."""
TOWARDS = 0.1
"""Going against their course is worth so many metres less."""
SAME_WAY = 0.05
"""By so many metres another direction has to be better than the one it is going."""
MOMENTS = np.arange(0.0, HORIZON_S + STEP_S / 2, STEP_S)

Numbers = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Comer:
    """Somebody who comes at the robot, or has come and waits for it."""

    person: Person
    course: XY
    """Of length one."""
    velocity: XY
    """None where they wait."""

    @property
    def waits(self) -> bool:
        """Whether they stand until the robot is out of their way."""
        return self.velocity == (0.0, 0.0)


class SteppingAside:
    """Keeps one robot out of the lines of those who come.

    Args:
        radius_m: Of the robot.
    """

    def __init__(self, radius_m: float) -> None:
        self._radius_m = radius_m
        self._now_s = 0.0
        self._courses: dict[str, XY] = {}
        """On which those near the robot came."""
        self._still_s: dict[str, float] = {}
        """When those near the robot last stood."""
        self._waited_s: dict[str, float] = {}
        """When somebody last stood before the robot."""
        self._begun_s: dict[str, deque[float]] = {}
        """When it last stepped aside for somebody."""
        self._before: frozenset[str] = frozenset()
        """For whom it steps aside."""
        self._direction: XY = (0.0, 0.0)

    def velocity(
        self,
        base: Base,
        wanted: Wanted,
        walkers: Iterable[Walker],
        people: Sequence[Person],
        plan: FloorPlan,
        *,
        approached: str | None,
    ) -> XY | None:
        """How to go out of the way; None where what is wanted does.

        Args:
            base: How the robot's base moves now.
            wanted: By whoever steers it.
            walkers: Those who are under way.
            people: Everybody.
            plan: What stands still.
            approached: Whose pose the robot is under way to, if there is a way.
        """
        self._now_s += base.step_s
        moving = {walker.person.name: walker.velocity for walker in walkers}
        comers = list(self._comers(base.xy, moving, people, approached))
        self._before &= {comer.person.name for comer in comers}
        if not comers:
            return None
        scene = _Foresight(base, self._radius_m, moving, people, comers=comers, plan=plan)
        in_way = frozenset(
            comer.person.name
            for comer in comers
            if scene.is_in_the_way(comer, OUT_M if comer.person.name in self._before else IN_THE_WAY_M)
        )
        if not in_way or scene.is_fine(wanted.velocity):
            return None
        return self._aside(scene, in_way)

    def _aside(self, scene: _Foresight, in_way: frozenset[str]) -> XY | None:
        """The best of the directions; None where none helps."""
        lead = next(comer for comer in scene.comers if comer.person.name in in_way)
        ways = scene.tried(_directions(lead.course, scene.base), in_way)
        going = in_way & self._before
        least_m = -math.inf if going else LEAST_M
        found = [
            (
                score
                + TOWARDS * min(_cos(way, lead.course), 0.0)
                + (SAME_WAY if _cos(way, self._direction) > 0.9 else 0.0),
                way,
                speed,
            )
            for score, gap_m, way, speed in ways
            if gap_m >= least_m and speed > 0.0
        ]
        best = max(found, key=lambda each: each[0], default=None)
        if best is None or best[0] <= scene.score_at_rest(in_way) + SAME_WAY:
            return None
        for name in in_way - self._before:
            self._begun_s.setdefault(name, deque(maxlen=MAY_COME)).append(self._now_s)
        self._before |= in_way
        self._direction = best[1]
        return (best[1][0] * best[2], best[1][1] * best[2])

    def _comers(
        self, xy: XY, moving: Mapping[str, XY], people: Sequence[Person], approached: str | None
    ) -> Iterator[Comer]:
        """Who comes at the robot, and who has come and waits."""
        for person in people:
            gap_m = math.dist(xy, person.xy) - person.radius_m - self._radius_m
            velocity = moving.get(person.name, (0.0, 0.0))
            speed = math.hypot(*velocity)
            if speed:
                self._courses[person.name] = (velocity[0] / speed, velocity[1] / speed)
            else:
                self._still_s[person.name] = self._now_s
                if gap_m > AHEAD_M:
                    self._courses.pop(person.name, None)
            course = self._courses.get(person.name)
            if course is None or gap_m > FAR_M + speed * HORIZON_S or not _is_ahead(person, course, xy):
                continue
            if gap_m < STANDS_M and not speed:
                self._waited_s[person.name] = self._now_s
            waited_s = self._now_s - self._waited_s.get(person.name, -math.inf)
            if gap_m < 2 * STANDS_M and waited_s <= WAITS_S:
                yield Comer(person, course, (0.0, 0.0))
            elif (
                self._now_s - self._still_s.get(person.name, -math.inf) >= COMES_S
                and self._is_to_be_let_by(person.name)
                and (person.name != approached or speed > DRIFTS_M_S)
            ):
                yield Comer(person, course, velocity)

    def _is_to_be_let_by(self, name: str) -> bool:
        """Or has come again and again of late: a robot that left its way each time would not get anywhere."""
        begun_s: Sequence[float] = self._begun_s.get(name, ())
        often = len(begun_s) == MAY_COME and self._now_s - begun_s[0] < FORGETS_S
        return name in self._before or not often


class _Foresight:
    """Where everybody will be, and how near each way of the robot comes to them."""

    def __init__(
        self,
        base: Base,
        radius_m: float,
        moving: Mapping[str, XY],
        people: Sequence[Person],
        *,
        comers: Sequence[Comer],
        plan: FloorPlan,
    ) -> None:
        self.base = base
        self.comers = comers
        self._radius_m = radius_m
        self._plan = plan
        velocities = {**moving} | {comer.person.name: comer.velocity for comer in comers}
        at = np.array([person.xy for person in people])
        moves = np.array([velocities.get(person.name, (0.0, 0.0)) for person in people])
        self._paths = at[:, None] + MOMENTS[:, None] * moves[:, None]
        self._names = [person.name for person in people]
        self._reach_m = np.array([person.radius_m + radius_m for person in people])
        speed = base.speed_m_s / (2.0 * base.acceleration_m_s2)
        self._start = (base.xy[0] + base.velocity[0] * speed, base.xy[1] + base.velocity[1] * speed)
        """Where it would come to rest."""

    def is_in_the_way(self, comer: Comer, within_m: float) -> bool:
        """Whether they would come so near to the robot at rest."""
        start = np.array([self._start])
        if comer.waits:
            return bool(self._off_line(start, comer)[0] < within_m)
        gaps = self._gaps(start[:, None])[0, self._names.index(comer.person.name)]
        return bool(gaps.min() < within_m and gaps.argmin() > 0)

    def is_fine(self, velocity: XY) -> bool:
        """Whether what is wanted keeps the robot out of everybody's way as well as it may."""
        speed = math.hypot(*velocity)
        if speed < 1e-6:
            return not any(self.is_in_the_way(comer, IN_THE_WAY_M) for comer in self.comers)
        way = (velocity[0] / speed, velocity[1] / speed)
        points = self._driven([way], np.array([FAR_M]), min(speed, NEAR_PEOPLE_M_S))
        gaps = self._gaps(points)[0]
        for comer in self.comers:
            ahead = gaps[self._names.index(comer.person.name)]
            if ahead.min() < min(IN_THE_WAY_M, ahead[0] - 1e-3):
                return False
            if comer.waits and self._off_line(points[:, -1], comer)[0] < OUT_M:
                return False
        return True

    def tried(self, ways: list[XY], in_way: frozenset[str]) -> Iterator[tuple[float, float, XY, float]]:
        """How good each direction is, how near it comes to somebody, and the speed to go it with."""
        free_m = self._free_m(ways)
        scores, least = self._scores(self._driven(ways, free_m, NEAR_PEOPLE_M_S), in_way)
        ends = np.array(self._start) + free_m[:, None] * np.array(ways)
        free_m = np.where(self._off_lines(ends, in_way) >= PASSES_M, free_m, 0.0)
        braking = SPEED_SHARE * self.base.acceleration_m_s2
        for way, far_m, score, gap_m in zip(ways, free_m, scores, least, strict=True):
            speed = min(NEAR_PEOPLE_M_S, stopping_speed(float(far_m), braking, self.base.step_s))
            yield float(score), float(gap_m), way, speed

    def score_at_rest(self, in_way: frozenset[str]) -> float:
        """How good it is to stay."""
        return float(self._scores(np.broadcast_to(self._start, (1, len(MOMENTS), 2)), in_way)[0][0])

    def _scores(self, points: Numbers, in_way: frozenset[str]) -> tuple[Numbers, Numbers]:
        """Of ways (n, moments, 2): metres gained, and the least gap; both of shape (n,)."""
        gaps = np.minimum(self._gaps(points), PERSON_MARGIN_M).min(axis=1)
        least = gaps.min(axis=1)
        out = np.minimum(self._off_lines(points[:, -1], in_way), PERSON_MARGIN_M)
        return least + gaps.mean(axis=1) + out, least

    def _gaps(self, points: Numbers) -> Numbers:
        """Between the bodies, for ways (n, moments or 1, 2) and all people; (n, people, moments)."""
        apart = points[:, None] - self._paths[None]
        return np.asarray(np.hypot(apart[..., 0], apart[..., 1]) - self._reach_m[:, None])

    def _off_lines(self, points: Numbers, in_way: frozenset[str]) -> Numbers:
        """How far places (n, 2) are beside the nearest of their lines; (n,)."""
        off = [self._off_line(points, comer) for comer in self.comers if comer.person.name in in_way]
        return np.asarray(np.min(off, axis=0))

    def _off_line(self, points: Numbers, comer: Comer) -> Numbers:
        """How far places (n, 2) are beside the line that somebody comes on; (n,)."""
        apart = points - np.array(comer.person.xy)
        along = apart @ np.array(comer.course)
        across = np.abs(apart @ np.array((-comer.course[1], comer.course[0])))
        beside = np.where(along >= 0.0, across, np.hypot(*apart.T))
        return np.asarray(beside - comer.person.radius_m - self._radius_m)

    def _free_m(self, ways: list[XY]) -> Numbers:
        """How far the robot can go each way before something that stands still; (n,)."""
        marks = np.arange(MARK_M, FAR_M + MARK_M / 2, MARK_M)
        points = np.array(self._start) + marks[:, None] * np.array(ways)[:, None]
        free = self._plan.are_free(points.reshape(-1, 2), self._radius_m + NEAR_WALL_M)
        free = np.logical_and.accumulate(free.reshape(len(ways), -1), axis=1)
        return np.asarray(free.sum(axis=1) * MARK_M)

    def _driven(self, ways: list[XY], free_m: Numbers, most_m_s: float) -> Numbers:
        """Where the robot is at each moment on its way; shape (n, moments, 2)."""
        faster = SPEED_SHARE * self.base.acceleration_m_s2
        after_s = np.array([self._turning_s(way) for way in ways])
        time_s = np.maximum(MOMENTS[None] - after_s[:, None], 0.0)
        gaining_s = most_m_s / faster
        gone_m = np.where(time_s < gaining_s, faster * time_s**2 / 2.0, most_m_s * (time_s - gaining_s / 2.0))
        gone_m = np.minimum(gone_m, free_m[:, None])
        return np.asarray(np.array(self._start) + gone_m[..., None] * np.array(ways)[:, None])

    def _turning_s(self, way: XY) -> float:
        """How long until the base goes that way, forwards or back."""
        if not self.base.turns_to_go:
            return 0.0
        heading = self.base.pose.heading_rad
        off = math.acos(min(1.0, abs(way[0] * math.cos(heading) + way[1] * math.sin(heading))))
        return off / MAX_TURN_RAD_S + (0.5 if off > 0.1 else 0.0)


def _directions(course: XY, base: Base) -> list[XY]:
    """The ways aside, and those for which two wheels need not turn."""
    along = math.atan2(course[1], course[0])
    angles = [along + sign * float(off) for off in OFF_COURSE[::-1] for sign in (1.0, -1.0)]
    if base.turns_to_go:
        angles += [base.pose.heading_rad, base.pose.heading_rad + math.pi]
    return [(math.cos(angle), math.sin(angle)) for angle in angles]


def _is_ahead(person: Person, course: XY, xy: XY) -> bool:
    return (xy[0] - person.x_m) * course[0] + (xy[1] - person.y_m) * course[1] > 0.0


def _cos(one: XY, other: XY) -> float:
    return one[0] * other[0] + one[1] * other[1]
