"""Collision filter: a person steps nowhere near another body, now or until it chooses again."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

from comity_sim2d.pose import XY


class Stride(NamedTuple):
    """A body's straight line from one choice to the next; a standing person stays at one place."""

    start: XY
    end: XY
    radius_m: float

    def distance_m(self, xy: XY) -> float:
        """From a place to the nearest that its centre gets."""
        if self.start == self.end:
            return math.dist(xy, self.start)
        (x, y), (dx, dy) = self.start, (self.end[0] - self.start[0], self.end[1] - self.start[1])
        share = ((xy[0] - x) * dx + (xy[1] - y) * dy) / (dx * dx + dy * dy)
        share = min(max(share, 0.0), 1.0)
        return math.dist(xy, (x + share * dx, y + share * dy))


def is_taken(xy: XY, here: XY, radius_m: float, others: Iterable[Stride], gap_m: float = 0.0) -> bool:
    """Whether a step would bring a person too near to another body; a person who is too near may go away.

    Args:
        xy: Where the step leads.
        here: From where.
        radius_m: Of who makes it.
        others: All bodies that count.
        gap_m: What is too near, between surfaces.
    """
    for other in others:
        there_m = other.distance_m(xy)
        if there_m - other.radius_m - radius_m < gap_m and there_m < other.distance_m(here):
            return True
    return False
