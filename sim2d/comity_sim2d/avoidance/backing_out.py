"""Backing out: a robot in a doorway before a passer-by goes back the way it came, and lets them by.

It lets whoever walks go first. Where neither gets by the other, both would wait.
"""

from __future__ import annotations

import math
from collections import deque

import numpy as np

from comity_sim2d.avoidance.right_of_way import PassersBySeen
from comity_sim2d.base.base import Base
from comity_sim2d.pose import XY, direction_to
from comity_sim2d.scene.obstacles import FloorPlan

HELD_S, RESTS_M_S = 3.0, 0.02
"""Who is slower than the second for the first is held up (our choice)."""
NEAR_M = 0.6
"""So near a passer-by holds the robot up, between their bodies: they stop before it no farther away."""
BESIDE_M = 0.05
"""So much more than their bodies do two need to get by one another."""
AROUND = 48
"""In so many places around the robot it is looked for whether somebody gets by."""
BACK_M, BACK_M_S = 0.9, 0.3
"""So far back it goes at least, and so fast: who comes out has room to turn aside (our choice)."""
LETS_BY_S = 5.0
"""There it waits so long; then it has its turn, whether or not they went by (our choice)."""
MARK_M, MARKS = 0.1, 60
"""It remembers its way in marks so far apart, and so many of them."""


class BackingOut:
    """Gets one robot out of doorways that passers-by want through.

    Args:
        radius_m: Of the robot.
        passers_by: Who may hold it up.
    """

    def __init__(self, radius_m: float, passers_by: PassersBySeen) -> None:
        self._radius_m = radius_m
        self._passers_by = passers_by
        self._marks: deque[XY] = deque(maxlen=MARKS)
        self._held_s = self._waits_s = 0.0
        self._held_at: XY | None = None
        """Where somebody held it up for whom it backs out now."""

    @property
    def lets_by(self) -> bool:
        """Whether it backs out, or waits there."""
        return self._held_at is not None

    def velocity(self, base: Base, plan: FloorPlan) -> XY | None:
        """How it goes back now; None where it does not."""
        if self._held_at is None:
            if not self._marks or math.dist(base.xy, self._marks[-1]) >= MARK_M:
                self._marks.append(base.xy)
            return None
        while self._marks and math.dist(base.xy, self._marks[-1]) < MARK_M:
            self._marks.pop()
        there = math.dist(base.xy, self._held_at) >= BACK_M and not self._bars(base.xy, self._held_at, plan)
        if self._waits_s or there or not self._marks:
            self._wait(base)
            return (0.0, 0.0)
        (x, y), mark = base.xy, self._marks[-1]
        share = BACK_M_S / math.dist(base.xy, mark)
        return ((mark[0] - x) * share, (mark[1] - y) * share)

    def note(self, base: Base, wanted: XY, allowed: XY, plan: FloorPlan) -> None:
        """Take note of what passers-by leave of what is wanted; where that is nothing for long, back out."""
        rests = max(base.speed_m_s, math.hypot(*allowed)) < RESTS_M_S and wanted != (0.0, 0.0)
        near = complex(*base.xy) if rests and not self.lets_by else None
        who = None if near is None else self._nearest(near, NEAR_M + self._radius_m)
        self._held_s = 0.0 if who is None else self._held_s + base.step_s
        if who is not None and self._held_s >= HELD_S:
            self._held_s = 0.0
            if self._bars(base.xy, who, plan):
                self._held_at, self._waits_s = base.xy, 0.0

    def _wait(self, base: Base) -> None:
        self._waits_s += base.step_s
        gone = self._held_at and self._nearest(complex(*self._held_at), NEAR_M + self._radius_m) is None
        if gone or self._waits_s >= LETS_BY_S:
            self._held_at = None

    def _nearest(self, place: complex, within_m: float) -> XY | None:
        """Where the nearest of them is; None where none is so near."""
        gaps = np.abs(self._passers_by.at - place) - self._passers_by.radius_m
        if gaps.min(initial=math.inf) > within_m:
            return None
        nearest = complex(self._passers_by.at[gaps.argmin()])
        return (nearest.real, nearest.imag)

    def _bars(self, xy: XY, who: XY, plan: FloorPlan) -> bool:
        """Whether nobody gets by the robot, on either side, from there to where it came from."""
        before = next((mark for mark in reversed(self._marks) if math.dist(mark, xy) >= BACK_M / 2), None)
        if before is None:
            return False
        radius_m = float(self._passers_by.radius_m.min())
        angles = np.arange(AROUND) * (math.tau / AROUND)
        ring = np.column_stack([np.cos(angles), np.sin(angles)])
        free = plan.are_free(np.array(xy) + (self._radius_m + radius_m + BESIDE_M) * ring, radius_m)
        one, other = sorted(
            round(direction_to(xy, end) / math.tau * AROUND) % AROUND for end in (who, before)
        )
        return not free[one : other + 1].all() and not (free[other:].all() and free[: one + 1].all())
