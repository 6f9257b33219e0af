"""Backing out: in a narrow place the robot retreats along its own path from an approaching person.

The walking person goes first. Otherwise both would wait where neither can pass the other.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Collection

import numpy as np

from comity_sim2d.avoidance.oncoming import HELD_UP_M, Oncoming, OncomingPerson
from comity_sim2d.avoidance.right_of_way import PassersBySeen
from comity_sim2d.avoidance.waiting_place import waiting_place
from comity_sim2d.base.base import Base
from comity_sim2d.pose import XY, direction_to
from comity_sim2d.scene.obstacles import FloorPlan

HELD_S, RESTS_M_S = 3.0, 0.02
"""A person slower than `RESTS_M_S` [m/s] for `HELD_S` [s] is blocked (our choice)."""
ASKED_S = 6.0
"""The same for a person who has not come close [s]: the robot may have asked them, and they need time to
go."""
STUCK_S = 12.0
"""The same for a person close before the robot who has room to pass it, but does not [s] (our choice)."""
NEAR_M = 0.6
"""Gap between the bodies below which a passer-by blocks the robot [m]: passers-by stop about this far before
it."""
BESIDE_M = 0.05
"""Clearance that two bodies need in addition to their widths to pass each other [m]."""
AROUND = 48
"""Number of places around the robot that are tested for a person to get by."""
BACK_M, BACK_M_S = 0.9, 0.3
"""Minimum distance to back up [m] and its speed [m/s]: the person who comes out can then turn aside (our
choice)."""
LETS_BY_S = 5.0
"""Time without progress after which the robot goes on, whether or not they have passed [s] (our choice)."""
BY_S = 1.0
"""Time without an approaching known person after which they have passed or turned round [s] (our choice)."""
NEARER_M = 0.05
"""A person who has come nearer by this distance is still approaching [m]."""
MARK_M, MARKS = 0.1, 100
"""Spacing [m] and maximum number of the marks by which the robot remembers its path."""
SETTLES_S, THERE_M = 0.5, 0.03
"""Time in which the robot comes to rest at the waiting place [s], and its tolerance there [m]."""


class BackingOut:
    """Moves one robot out of doorways and passages that others want to use.

    Args:
        radius_m: Radius of the robot [m].
        oncoming: The known people who may block it.
    """

    def __init__(self, radius_m: float, oncoming: Oncoming) -> None:
        self._radius_m = radius_m
        self._oncoming = oncoming
        self._passers_by: PassersBySeen | None = None
        self._marks: deque[XY] = deque(maxlen=MARKS)
        self._held_s = 0.0
        self._is_barred = False
        """Whether the blocking person cannot get past the robot."""
        self._by: OncomingPerson | None = None
        """The current or last blocking person, and their position at that time."""
        self._held_at: XY | None = None
        """Where they blocked the robot, if it backs out for that."""
        self._waits_at: XY | None = None
        """Where the robot waits, once out, until they have passed."""
        self._idle_s = self._alone_s = 0.0
        """Time without progress, and time without an approaching known person [s]."""
        self._nearest_m = math.inf

    def let_pass(self, passers_by: PassersBySeen) -> None:
        """Register passers-by, who are in no plan: they may block the robot, too."""
        self._passers_by = passers_by

    @property
    def before(self) -> str | None:
        """The person for whom the robot backs out or waits."""
        return self._by.name if self._by and self._held_at else None

    @property
    def held_up_by(self) -> str | None:
        """The person for whom the robot will back out if they stay."""
        expects = self._held_s and self._is_barred and self._by is not None and self._by.is_close
        return self._by.name if self._by and expects else None

    def velocity(self, base: Base, plan: FloorPlan, *, visited: str | None) -> XY | None:
        """The velocity for backing out [m/s], (0, 0) while waiting; None if the robot does neither.

        Args:
            base: Current motion of the robot's base.
            plan: The static obstacles.
            visited: The person the robot visits: it does not back out for them.
        """
        if self._held_at is None or self._by is None:
            while len(self._marks) > 1 and math.dist(base.xy, self._marks[-2]) < MARK_M:
                self._marks.pop()  # it went back by itself: no mark may lie ahead
            if not self._marks or math.dist(base.xy, self._marks[-1]) >= MARK_M:
                self._marks.append(base.xy)
            return None
        self._watch(base, self._by, self._held_at, visited)
        if self._waits_at is None and self._is_out(base.xy, self._by, self._held_at, plan):
            self._waits_at = self._place_to_wait(base.xy, self._by, self._held_at, plan)
        if self._idle_s >= LETS_BY_S or (self._waits_at is not None and self._is_by(self._held_at)):
            self._oncoming.forget(self._by.name)
            self._held_at = self._waits_at = None
            return None
        if self._waits_at is not None:
            return _towards(base.xy, self._waits_at)
        self._alone_s = 0.0
        return _towards(base.xy, self._marks[-1], stops=False)

    def note(self, base: Base, allowed: XY, plan: FloorPlan, *, to: str, stand: Collection[str] = ()) -> None:
        """Observe how far others let the robot go; back out if they block it for long.

        Args:
            base: Current motion of the robot's base.
            allowed: The velocity command after all limits.
            plan: The static obstacles.
            to: The person or place the robot is going to; empty if it is going nowhere.
            stand: Passers-by who stood in its path before it reached them: the robot asks them to make way.
        """
        rests = max(base.speed_m_s, math.hypot(*allowed)) < RESTS_M_S and self._held_at is None
        comer = self._holder(base.xy, to, stand, plan) if rests else None
        if comer is None:
            self._held_s = 0.0
            return
        if not self._held_s or self._by is None or comer.name != self._by.name:
            self._by, self._is_barred = comer, self._bars(base.xy, comer, plan)
        self._held_s += base.step_s
        if self._held_s < (HELD_S if comer.is_close else ASKED_S):
            return
        if self._bars(base.xy, comer, plan) or (comer.is_close and self._held_s >= STUCK_S):
            self._held_s = 0.0
            self._by, self._held_at = comer, base.xy
            self._idle_s, self._alone_s, self._nearest_m = 0.0, 0.0, math.inf

    def _holder(self, xy: XY, visited: str, stand: Collection[str], plan: FloorPlan) -> OncomingPerson | None:
        """The nearest person in front who may block the robot; a passer-by only if the robot blocks them."""
        before = self._before(xy)
        known = [
            comer
            for comer in self._oncoming.comers(xy)
            if comer.name != visited
            and comer.gap_m <= HELD_UP_M
            and not (before and _are_on_one_side(xy, comer.xy, before))
        ]
        strangers = [comer for comer in self._strangers(xy) if comer.name not in stand]
        if len(strangers) > 1:  # one may stand next to it, another in front
            strangers = [comer for comer in strangers if self._bars(xy, comer, plan)] or strangers
        return min([*known, *strangers], key=lambda comer: comer.gap_m, default=None)

    def _strangers(self, xy: XY) -> list[OncomingPerson]:
        """The passers-by near a robot at this position."""
        passers_by = self._passers_by
        if passers_by is None:
            return []
        gaps = np.abs(passers_by.at - complex(*xy)) - passers_by.radius_m - self._radius_m
        return [
            OncomingPerson(
                passers_by.names[i],
                (float(passers_by.at[i].real), float(passers_by.at[i].imag)),
                float(passers_by.radius_m[i]),
                float(gaps[i]),
            )
            for i in np.flatnonzero(gaps <= NEAR_M).tolist()
        ]

    def _watch(self, base: Base, by: OncomingPerson, held_at: XY, visited: str | None) -> None:
        """Observe progress: the robot backed up, or the person came nearer."""
        self._idle_s += base.step_s
        self._alone_s += base.step_s
        while self._marks and math.dist(base.xy, self._marks[-1]) < MARK_M:
            self._marks.pop()
            self._idle_s, self._nearest_m = 0.0, math.inf
        for comer in self._oncoming.comers(base.xy, within_s=BY_S / 2):
            if comer.name == visited or not _are_on_one_side(base.xy, comer.xy, held_at):
                continue
            self._alone_s = 0.0
            if comer.name == by.name and comer.gap_m < self._nearest_m - NEARER_M:
                self._idle_s, self._nearest_m = 0.0, comer.gap_m

    def _is_out(self, xy: XY, by: OncomingPerson, held_at: XY, plan: FloorPlan) -> bool:
        """Whether they can get past the robot there, or its path allows no further retreat."""
        if not self._marks:
            return True
        away_m = math.dist(xy, held_at)
        if away_m >= BACK_M / 2 and math.dist(self._marks[-1], held_at) < away_m - MARK_M / 2:
            return True
        return away_m >= BACK_M and not self._bars(xy, by, plan)

    def _place_to_wait(self, xy: XY, by: OncomingPerson, held_at: XY, plan: FloorPlan) -> XY:
        """A place off the line of a known person; for passers-by, who choose their path, where it stands."""
        if self._oncoming.knows(by.name):
            return waiting_place(xy, held_at, self._radius_m, by.radius_m, plan)
        return xy

    def _is_by(self, held_at: XY) -> bool:
        """Whether no person is where it was blocked, or comes from there."""
        return not self._strangers(held_at) and self._alone_s >= BY_S

    def _before(self, xy: XY) -> XY | None:
        """Where the robot came from; None if it has not moved far."""
        return next((mark for mark in reversed(self._marks) if math.dist(mark, xy) >= BACK_M / 2), None)

    def _bars(self, xy: XY, who: OncomingPerson, plan: FloorPlan) -> bool:
        """Whether the robot leaves no room to pass on either side between `xy` and where it came from."""
        before = self._before(xy)
        if before is None:
            return False
        angles = np.arange(AROUND) * (math.tau / AROUND)
        ring = np.column_stack([np.cos(angles), np.sin(angles)])
        free = plan.are_free(np.array(xy) + (self._radius_m + who.radius_m + BESIDE_M) * ring, who.radius_m)
        one, other = sorted(
            round(direction_to(xy, end) / math.tau * AROUND) % AROUND for end in (who.xy, before)
        )
        return not free[one : other + 1].all() and not (free[other:].all() and free[: one + 1].all())


def _towards(xy: XY, goal: XY, *, stops: bool = True) -> XY:
    """The velocity towards a place [m/s]; (0, 0) at the place if the robot is to stop there."""
    left_m = math.dist(xy, goal)
    if stops and left_m <= THERE_M:
        return (0.0, 0.0)
    share = min(BACK_M_S, left_m / SETTLES_S if stops else math.inf) / max(left_m, 1e-9)
    return ((goal[0] - xy[0]) * share, (goal[1] - xy[1]) * share)


def _are_on_one_side(xy: XY, one: XY, other: XY) -> bool:
    """Whether two points lie on the same side of a third, less than a right angle apart."""
    (x, y), (ax, ay), (bx, by) = xy, one, other
    return (ax - x) * (bx - x) + (ay - y) * (by - y) > 0.0
