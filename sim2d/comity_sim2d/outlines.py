"""Walls and furniture as people meet them: straight lines in arrays, and who is near which."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from comity_sim2d.neighbours import Indices
from comity_sim2d.obstacles import FloorPlan, floor_plan
from comity_sim2d.social_force import Numbers, Vectors

if TYPE_CHECKING:
    from comity_sim2d.scene import Scene

BLOCK = 4096
"""Lines that are compared with people at a time, so that large maps stay small in memory."""


class Outlines:
    """All that stands still. Places are complex numbers, x + iy [m].

    Args:
        starts: Where each line begins, shape (m,).
        ends: Where it ends.
        half_m: Half its thickness, round about the ends.
    """

    def __init__(self, starts: Vectors, ends: Vectors, half_m: Numbers) -> None:
        self._starts, self._legs, self._half_m = starts, ends - starts, half_m
        self._squares = np.maximum(np.abs(self._legs) ** 2, 1e-18)

    @classmethod
    def of(cls, scene: Scene) -> Outlines:
        """The outlines of a scene."""
        return cls.of_plan(floor_plan(scene))

    @classmethod
    def of_plan(cls, plan: FloorPlan) -> Outlines:
        """The outlines of a floor plan, as its doors stand."""
        segments = plan.segments
        places = segments.ends[..., 0] + 1j * segments.ends[..., 1]
        return cls(places[:, 0], places[:, 1], segments.half_m)

    def nearest(self, at: Vectors, lines: Indices) -> tuple[Vectors, Numbers]:
        """Unit vectors from the lines' nearest points to places, and the distances from the lines' edges."""
        start, leg = self._starts[lines], self._legs[lines]
        from_start = at - start
        along = (from_start * leg.conj()).real / self._squares[lines]
        away = from_start - np.minimum(np.maximum(along, 0.0), 1.0) * leg
        distance = np.abs(away)
        return away / np.maximum(distance, 1e-12), distance - self._half_m[lines]

    def within(self, at: Vectors, distance_m: float) -> tuple[Indices, Indices]:
        """All pairs of a place and a line that is not farther from it, by place and then by line."""
        found = [self._block(at, first, distance_m) for first in range(0, len(self._starts), BLOCK)]
        who, lines = (np.concatenate(part) for part in zip(*found, strict=True))
        order = np.lexsort((lines, who))
        return who[order], lines[order]

    def _block(self, at: Vectors, first: int, distance_m: float) -> tuple[Indices, Indices]:
        lines = np.arange(first, min(first + BLOCK, len(self._starts)))
        _, gap = self.nearest(at[:, None], lines)
        who, which = np.nonzero(gap <= distance_m)
        return who, lines[which]


class WallList:
    """The lines that are near each person, found anew only when somebody has moved by half the skin."""

    def __init__(self, outlines: Outlines, distance_m: float, skin_m: float) -> None:
        self._outlines, self._distance_m, self._skin_m = outlines, distance_m, skin_m
        self._listed_at: Vectors | None = None
        self.who: Indices = np.empty(0, dtype=np.intp)
        self._lines: Indices = np.empty(0, dtype=np.intp)

    def update(self, at: Vectors) -> tuple[Vectors, Numbers]:
        """For each of `who`: the unit vector from the line to the place, and the distance from its edge."""
        listed = self._listed_at
        if listed is None or np.abs(at - listed).max() > self._skin_m / 2:
            self._listed_at = at.copy()
            self.who, self._lines = self._outlines.within(at, self._distance_m + self._skin_m)
        return self._outlines.nearest(at[self.who], self._lines)
