"""Collision filter: no step of a person comes near another body before the next decision."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

from comity_sim2d.pose import XY


class Stride(NamedTuple):
    """A body's straight line between two decisions; of a standing person, a single point."""

    start: XY
    end: XY
    radius_m: float

    def distance_m(self, xy: XY) -> float:
        """Smallest distance from a point to the body's centre on this line [m]."""
        if self.start == self.end:
            return math.dist(xy, self.start)
        (x, y), (dx, dy) = self.start, (self.end[0] - self.start[0], self.end[1] - self.start[1])
        share = ((xy[0] - x) * dx + (xy[1] - y) * dy) / (dx * dx + dy * dy)
        share = min(max(share, 0.0), 1.0)
        return math.dist(xy, (x + share * dx, y + share * dy))


def is_taken(xy: XY, here: XY, radius_m: float, others: Iterable[Stride], gap_m: float = 0.0) -> bool:
    """Whether a step brings a person too near to another body; a person already too near may move away.

    Args:
        xy: End of the step [m].
        here: Start of the step [m].
        radius_m: Radius of the person [m].
        others: All other bodies.
        gap_m: Minimum gap between surfaces [m].
    """
    for other in others:
        there_m = other.distance_m(xy)
        if there_m - other.radius_m - radius_m < gap_m and there_m < other.distance_m(here):
            return True
    return False
