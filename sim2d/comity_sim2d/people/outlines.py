"""Walls and furniture as pedestrians avoid them: line segments in arrays, and those near each person."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from comity_sim2d.people.neighbours import Indices
from comity_sim2d.people.social_force import Numbers, Vectors
from comity_sim2d.scene.obstacles import FloorPlan, floor_plan

if TYPE_CHECKING:
    from comity_sim2d.scene.scene import Scene

BLOCK = 4096
"""Number of lines compared with people at a time, to limit memory on large maps."""
FEW_PAIRS = 250
"""Number of person-line pairs up to which all are listed permanently (measured)."""


@dataclass(frozen=True, slots=True)
class Lines:
    """Line segments in arrays of shape (k,)."""

    starts: Vectors
    legs: Vectors
    unit: Vectors
    """Factor that turns a vector into its share of the segment (real part)."""
    half_m: Numbers

    def nearest(self, at: Vectors) -> tuple[Vectors, Numbers]:
        """Unit vectors from the lines' nearest points to `at`, and distances from the lines' edges [m]."""
        from_start = at - self.starts
        along = np.minimum(np.maximum((from_start * self.unit).real, 0.0), 1.0)
        away = from_start - along * self.legs
        distance = np.abs(away)
        return away / np.maximum(distance, 1e-12), distance - self.half_m


class Outlines:
    """All static obstacles as line segments; positions are complex numbers, x + iy [m].

    Args:
        starts: Start of each line, shape (m,).
        ends: End of each line, shape (m,).
        half_m: Half its thickness, with round ends [m].
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
        """The outlines of a floor plan with its doors in their current state."""
        segments = plan.segments
        places = segments.ends[..., 0] + 1j * segments.ends[..., 1]
        return cls(places[:, 0], places[:, 1], segments.half_m)

    def __len__(self) -> int:
        return len(self._starts)

    def lines(self, which: Indices) -> Lines:
        """A selection of lines, one per point."""
        return Lines(
            self._starts[which],
            self._legs[which],
            self._legs[which].conj() / self._squares[which],
            self._half_m[which],
        )

    def within(self, at: Vectors, distance_m: float) -> tuple[Indices, Indices]:
        """All pairs of a point and a line within a distance, sorted by point and then by line."""
        found = [self._block(at, first, distance_m) for first in range(0, len(self._starts), BLOCK)]
        who, lines = (np.concatenate(part) for part in zip(*found, strict=True))
        order = np.lexsort((lines, who))
        return who[order], lines[order]

    def _block(self, at: Vectors, first: int, distance_m: float) -> tuple[Indices, Indices]:
        lines = np.arange(first, min(first + BLOCK, len(self._starts)))
        _, gap = self.lines(lines).nearest(at[:, None])
        who, which = np.nonzero(gap <= distance_m)
        return who, lines[which]


class WallList:
    """The lines near each person, searched again only when a person has moved by half the skin.

    Args:
        outlines: The static obstacles.
        walkers: Indices of the bodies that avoid them.
        radius_m: Radii of all bodies [m], shape (n,).
        distance_m: Maximum distance of lines from a body's centre that matter [m].
        skin_m: Additional distance up to which lines are listed, so that the list stays valid [m].
    """

    def __init__(
        self, outlines: Outlines, walkers: Indices, radius_m: Numbers, distance_m: float, skin_m: float
    ) -> None:
        self._outlines, self._distance_m, self._skin_m = outlines, distance_m, skin_m
        self._walkers, self._radius_m = walkers, radius_m
        self._listed_at: Vectors | None = None
        self._lasts = len(walkers) * len(outlines) <= FEW_PAIRS
        self.who: Indices = np.empty(0, dtype=np.intp)

    def update(self, at: Vectors) -> tuple[Vectors, Numbers]:
        """For each index in `who`: unit vector from the line to the body, and the gap between them [m]."""
        listed = self._listed_at
        if listed is None or not (
            self._lasts or np.abs(at[self._walkers] - listed).max() <= self._skin_m / 2
        ):
            self._list(at[self._walkers])
        away, distance = self._lines.nearest(at[self.who])
        return away, distance - self._reach_m

    def _list(self, at: Vectors) -> None:
        self._listed_at = at
        farthest_m = np.inf if self._lasts else self._distance_m + self._skin_m
        who, which = self._outlines.within(at, farthest_m)
        self.who, self._lines = self._walkers[who], self._outlines.lines(which)
        self._reach_m = self._radius_m[self.who]
