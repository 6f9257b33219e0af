"""Right of way of passers-by: the robot is slow near them, and stops before those in its path."""

from __future__ import annotations

import math
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from comity_fis.proxemics import PERSON_MARGIN_M
from comity_sim2d.base.drive import KEEP_OFF_M, NEAR_PEOPLE_M, NEAR_PEOPLE_M_S, NEAR_PEOPLE_SLACK_M
from comity_sim2d.pose import XY

SIDEWAYS_COS = 0.1
"""Cosine of the angle to the path (84 deg); a person farther to the side is not in the path."""
CLOSES_M_S = 0.015
"""Maximum closing speed while passing them [m/s]: less than what counts as approaching (our choice)."""
AWAY_COS = -0.3
"""Cosine of 107 degrees; a path at a larger angle to a person's direction leads away from them (our
choice)."""
GRAZES_M = 0.02
"""A person already inside the margin does not block a path that leads nearer to them by no more than this
[m], and not below the minimum gap (our choice). Otherwise a person next to the robot would block it for
good."""


class PassersBySeen(Protocol):
    """People around the robot who are in no plan."""

    @property
    def names(self) -> tuple[str, ...]:
        """Their names in the frames."""
        ...

    @property
    def at(self) -> NDArray[np.complex128]:
        """Their positions [m], x + iy; shape (n,)."""
        ...

    @property
    def radius_m(self) -> NDArray[np.float64]:
        """Radii of their bodies [m], shape (n,)."""
        ...


def yield_to(
    wanted: XY,
    xy: XY,
    people: NDArray[np.complex128],
    reach_m: NDArray[np.float64],
    *,
    braking: float,
    ahead_m: float,
    stands_beside: bool = False,
) -> XY:
    """The velocity command, slowed down so that the robot can stop before people and passes them slowly.

    Args:
        wanted: The velocity command, people ignored [m/s].
        xy: Position of the robot's centre [m].
        people: Positions of their centres [m], x + iy, shape (n,).
        reach_m: Sum of the robot's and each person's radius [m], shape (n,).
        braking: The assumed deceleration [m/s^2].
        ahead_m: Distance that the robot covers before the next command [m].
        stands_beside: Whether the robot stands still next to people inside the margin, unless it moves away
            from them: a walking person may come nearer still.
    """
    speed = math.hypot(*wanted)
    if not len(people) or speed == 0.0:
        return wanted
    apart = people - complex(*xy)
    gap = np.abs(apart) - reach_m
    slow_m = NEAR_PEOPLE_M + NEAR_PEOPLE_SLACK_M + ahead_m
    matter = (gap <= slow_m + speed**2 / (2.0 * braking)).nonzero()[0]
    if not len(matter):
        return wanted
    gaps = gap[matter].tolist()
    # Speed and separation monitoring (ISO/TS 15066): the speed is at most that from which the base, braking
    # at `braking`, still stops before the margin, v = sqrt(2 a d), after what it covers before the next
    # command takes hold. Only the length of the velocity changes and never its direction: to evade is for the
    # layers above, and two layers that steer would oscillate. A person next to the line, or grazed by it
    # inside the margin, does not stop the robot: else a person who stands next to it would block it there for
    # good (the frozen robot; Trautman and Krause 2010).
    most = math.sqrt(NEAR_PEOPLE_M_S**2 + 2.0 * braking * max(min(gaps) - slow_m, 0.0))
    for beside, gap_m in zip(apart[matter].tolist(), gaps, strict=True):
        towards = (beside.real * wanted[0] + beside.imag * wanted[1]) / (max(abs(beside), 1e-9) * speed)
        if stands_beside and gap_m < PERSON_MARGIN_M:
            most = most if towards < AWAY_COS else 0.0
        elif towards > SIDEWAYS_COS and not _grazes(abs(beside), gap_m, towards):
            before_m = max(gap_m - PERSON_MARGIN_M - ahead_m, 0.0)
            most = min(most, math.sqrt(2.0 * braking * before_m))
        elif towards > 0.0 and gap_m < PERSON_MARGIN_M:
            most = min(most, CLOSES_M_S / towards)
    share = min(1.0, most / speed)
    return (wanted[0] * share, wanted[1] * share)


def _grazes(apart_m: float, gap_m: float, towards: float) -> bool:
    """Whether a person is inside the margin, and a path at an angle with this cosine passes them."""
    nearer_m = apart_m * (1.0 - math.sqrt(max(0.0, 1.0 - towards * towards)))
    return gap_m < PERSON_MARGIN_M and nearer_m <= min(GRAZES_M, gap_m - KEEP_OFF_M)
