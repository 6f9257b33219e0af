"""Prediction of each direction in which a robot can leave a person's line: future positions and gaps.

Candidate directions are simulated against people who keep their velocity, as in the dynamic window approach
(Fox, Burgard and Thrun 1997, "The dynamic window approach to collision avoidance"). Each includes the time
that the base takes to turn and to accelerate.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from comity_fis.proxemics import PERSON_MARGIN_M
from comity_sim2d.base.base import Base
from comity_sim2d.base.drive import MAX_TURN_RAD_S, NEAR_PEOPLE_M_S, SPEED_SHARE, stopping_speed
from comity_sim2d.pose import XY
from comity_sim2d.scene.obstacles import FloorPlan
from comity_sim2d.scene.person import Person

HORIZON_S, STEP_S = 3.0, 0.25
"""Prediction horizon [s], for which people are assumed to walk straight on, and its time step [s]."""
MOMENTS = np.arange(0.0, HORIZON_S + STEP_S / 2, STEP_S)
IN_THE_WAY_M, OUT_M = 0.15, 0.25
"""The robot obstructs a person who would come nearer than `IN_THE_WAY_M` [m], until they would pass at
`OUT_M` [m] (our choice: a walking person stops 0.10 m before it; a robot stands at least 0.30 m from
people)."""
PASSES_M = 0.1
"""A path that ends nearer to their line than this blocks them [m]."""
FAR_M, MARK_M = 1.5, 0.1
"""Length of the candidate paths [m], and spacing of the sample points on them [m]."""
NEAR_WALL_M = 0.03
"""A path ends where it comes nearer than this to a wall or furniture [m] (our choice: it drives slowly
there)."""

Numbers = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class ApproachingPerson:
    """A person who approaches the robot, or who has arrived and waits for it."""

    person: Person
    course: XY
    """Unit vector."""
    velocity: XY
    """Velocity [m/s]; (0, 0) if they wait."""

    @property
    def waits(self) -> bool:
        """Whether they stand until the robot is out of their way."""
        return self.velocity == (0.0, 0.0)


@dataclass(frozen=True, slots=True)
class CandidateDirection:
    """A candidate direction with its predicted outcome."""

    direction: XY
    """Unit vector."""
    speed_m_s: float
    """Speed in that direction [m/s]; 0 if there is no path."""
    score_m: float
    """Distance gained [m]; higher is better."""
    gap_m: float
    """Smallest gap to a person [m]."""


class Foresight:
    """Predicted positions of all people, and the gaps between them and each candidate path."""

    def __init__(
        self,
        base: Base,
        radius_m: float,
        moving: Mapping[str, XY],
        people: Sequence[Person],
        *,
        comers: Sequence[ApproachingPerson],
        plan: FloorPlan,
    ) -> None:
        self.base = base
        self.comers = comers
        self._radius_m = radius_m
        self._plan = plan
        velocities = dict(moving) | {comer.person.name: comer.velocity for comer in comers}
        at = np.array([person.xy for person in people])
        moves = np.array([velocities.get(person.name, (0.0, 0.0)) for person in people])
        self._paths = at[:, None] + MOMENTS[:, None] * moves[:, None]
        self._names = [person.name for person in people]
        self._reach_m = np.array([person.radius_m + radius_m for person in people])
        speed = base.speed_m_s / (2.0 * base.acceleration_m_s2)
        self._start = (base.xy[0] + base.velocity[0] * speed, base.xy[1] + base.velocity[1] * speed)
        """Where the robot would come to rest [m]."""

    def is_in_the_way(self, comer: ApproachingPerson, within_m: float) -> bool:
        """Whether they would come nearer than this gap to the robot at rest."""
        start = np.array([self._start])
        if comer.waits:
            return bool(self._off_line(start, comer)[0] < within_m)
        gaps = self._gaps(start[:, None])[0, self._names.index(comer.person.name)]
        return bool(gaps.min() < within_m and gaps.argmin() > 0)

    def is_fine(self, velocity: XY) -> bool:
        """Whether the velocity command already keeps the robot clear of all people as well as possible."""
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

    def tried(self, ways: list[XY], in_way: frozenset[str]) -> Iterator[CandidateDirection]:
        """Evaluate each candidate direction."""
        # Each direction is simulated with the base's own acceleration and time to turn, against people who
        # walk on straight (dynamic window; Fox, Burgard and Thrun 1997). Directions and not velocities are
        # sampled, since near people the speed is given by the limit there and by how far the way is free. The
        # score adds the least gap, the mean gap and the distance from their line at the end, each at most the
        # margin: past the margin more room is worth nothing, or the robot would flee across the room. A
        # direction that ends on their line counts as no way at all: the person would have to stop.
        free_m = self._free_m(ways)
        scores, least = self._scores(self._driven(ways, free_m, NEAR_PEOPLE_M_S), in_way)
        ends = np.array(self._start) + free_m[:, None] * np.array(ways)
        free_m = np.where(self._off_lines(ends, in_way) >= PASSES_M, free_m, 0.0)
        braking = SPEED_SHARE * self.base.acceleration_m_s2
        for way, far_m, score, gap_m in zip(ways, free_m, scores, least, strict=True):
            speed = min(NEAR_PEOPLE_M_S, stopping_speed(float(far_m), braking, self.base.step_s))
            yield CandidateDirection(way, speed, float(score), float(gap_m))

    def score_at_rest(self, in_way: frozenset[str]) -> float:
        """The score of standing still [m]."""
        return float(self._scores(np.broadcast_to(self._start, (1, len(MOMENTS), 2)), in_way)[0][0])

    def _scores(self, points: Numbers, in_way: frozenset[str]) -> tuple[Numbers, Numbers]:
        """Score [m] and smallest gap [m] of paths (n, moments, 2); both of shape (n,)."""
        gaps = np.minimum(self._gaps(points), PERSON_MARGIN_M).min(axis=1)
        least = gaps.min(axis=1)
        out = np.minimum(self._off_lines(points[:, -1], in_way), PERSON_MARGIN_M)
        return least + gaps.mean(axis=1) + out, least

    def _gaps(self, points: Numbers) -> Numbers:
        """Gaps between bodies [m], for paths (n, moments or 1, 2); shape (n, people, moments)."""
        apart = points[:, None] - self._paths[None]
        return np.asarray(np.hypot(apart[..., 0], apart[..., 1]) - self._reach_m[:, None])

    def _off_lines(self, points: Numbers, in_way: frozenset[str]) -> Numbers:
        """Distance of points (n, 2) from the nearest of the approaching people's lines [m]; shape (n,)."""
        off = [self._off_line(points, comer) for comer in self.comers if comer.person.name in in_way]
        return np.asarray(np.min(off, axis=0))

    def _off_line(self, points: Numbers, comer: ApproachingPerson) -> Numbers:
        """Distance of points (n, 2) from the line along which a person approaches [m]; shape (n,)."""
        apart = points - np.array(comer.person.xy)
        along = apart @ np.array(comer.course)
        across = np.abs(apart @ np.array((-comer.course[1], comer.course[0])))
        beside = np.where(along >= 0.0, across, np.hypot(*apart.T))
        return np.asarray(beside - comer.person.radius_m - self._radius_m)

    def _free_m(self, ways: list[XY]) -> Numbers:
        """Free distance in each direction before a static obstacle [m]; shape (n,)."""
        marks = np.arange(MARK_M, FAR_M + MARK_M / 2, MARK_M)
        points = np.array(self._start) + marks[:, None] * np.array(ways)[:, None]
        free = self._plan.are_free(points.reshape(-1, 2), self._radius_m + NEAR_WALL_M)
        free = np.logical_and.accumulate(free.reshape(len(ways), -1), axis=1)
        return np.asarray(free.sum(axis=1) * MARK_M)

    def _driven(self, ways: list[XY], free_m: Numbers, most_m_s: float) -> Numbers:
        """Positions of the robot on each path at each moment [m]; shape (n, moments, 2)."""
        faster = SPEED_SHARE * self.base.acceleration_m_s2
        after_s = np.array([self._turning_s(way) for way in ways])
        time_s = np.maximum(MOMENTS[None] - after_s[:, None], 0.0)
        gaining_s = most_m_s / faster
        gone_m = np.where(time_s < gaining_s, faster * time_s**2 / 2.0, most_m_s * (time_s - gaining_s / 2.0))
        gone_m = np.minimum(gone_m, free_m[:, None])
        return np.asarray(np.array(self._start) + gone_m[..., None] * np.array(ways)[:, None])

    def _turning_s(self, way: XY) -> float:
        """Time until the base can drive in that direction, forwards or backwards [s]."""
        if not self.base.turns_to_go:
            return 0.0
        heading = self.base.pose.heading_rad
        off = math.acos(min(1.0, abs(way[0] * math.cos(heading) + way[1] * math.sin(heading))))
        return off / MAX_TURN_RAD_S + (0.5 if off > 0.1 else 0.0)
