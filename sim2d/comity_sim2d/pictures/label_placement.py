"""Label placement on a map: labels do not overlap, and hide little that matters."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from comity_sim2d.pose import XY

DIRECTIONS = 24
APART_PX = 6.0
"""Labels nearer to each other than this seem to overlap [px] (our choice)."""
REACHES_PX = (4.0, 9.0, 16.0, 26.0, 42.0, 64.0, 90.0, 125.0, 170.0, 230.0)
FAR_PX, FAR = 125.0, 10.0
"""A label farther from its object than this seems to belong to another [px], and the cost of that: equal to
20 covered pieces of a wall (our choice)."""
TAIL = 0.1
"""Cost of a body or a label under a bubble's tail, relative to one under the bubble (our choice)."""
PIECE = 0.5
"""Cost of a covered piece of a wall or a path: equal to 30 px more distance (our choice)."""

Disc = tuple[XY, float]
"""A body: its centre and its radius."""

Cost = tuple[float, float]
"""Number of hidden labels and bodies, which counts first, and the remaining cost."""


@dataclass(frozen=True, slots=True)
class Box:
    """An upright rectangle on the page, in pixels."""

    left: float
    bottom: float
    right: float
    top: float

    @classmethod
    def around(cls, centre: XY, width: float, height: float) -> Box:
        """A box with a given centre."""
        x, y = centre
        return cls(x - width / 2, y - height / 2, x + width / 2, y + height / 2)

    @property
    def centre(self) -> XY:
        """Its centre."""
        return ((self.left + self.right) / 2, (self.bottom + self.top) / 2)

    def overlap(self, other: Box) -> float:
        """The area that two boxes share."""
        width = min(self.right, other.right) - max(self.left, other.left)
        height = min(self.top, other.top) - max(self.bottom, other.bottom)
        return max(width, 0.0) * max(height, 0.0)

    def nearest(self, point: XY) -> XY:
        """The point of the box that is nearest to another one."""
        x, y = point
        return (min(max(x, self.left), self.right), min(max(y, self.bottom), self.top))

    def moved_into(self, page: Box) -> Box:
        """The box moved onto the page as little as possible; centred if it is larger."""
        across = _shift(self.left, self.right, page.left, page.right)
        along = _shift(self.bottom, self.top, page.bottom, page.top)
        return Box(self.left + across, self.bottom + along, self.right + across, self.top + along)

    def grown(self, margin: float) -> Box:
        """The box with a margin around it."""
        return Box(self.left - margin, self.bottom - margin, self.right + margin, self.top + margin)


@dataclass(slots=True)
class Page:
    """A map with its contents; every placed label is an obstacle for the next."""

    area: Box
    labels: list[Box]
    """Must not be covered."""
    marks: list[Box]
    """Should not be covered: bodies and what belongs to them."""
    lines: list[Box] = field(default_factory=list)
    """Walls and paths in pieces: even a thin line spoils text, however small its area."""
    room: Box | None = None
    """Bounding box of the floor: labels across its edge are also tried inside it."""
    bodies: list[Disc] = field(default_factory=list)
    """Bodies of people and the robot: labels hide none, if there is another place."""

    def place(
        self,
        anchor: XY,
        radius: float,
        size: XY,
        prefer_rad: float | None = None,
        *,
        besides: Sequence[Box] = (),
        keep_off: Sequence[Disc] | None = None,
    ) -> Box:
        """Place a label at the best position near its anchor; an obstacle for later ones. See `best`."""
        _, box = self.best(anchor, radius, size, prefer_rad, besides=besides, keep_off=keep_off)
        self.labels.append(box)
        return box

    def best(
        self,
        anchor: XY,
        radius: float,
        size: XY,
        prefer_rad: float | None = None,
        *,
        besides: Sequence[Box] = (),
        keep_off: Sequence[Disc] | None = None,
    ) -> tuple[Cost, Box]:
        """Find the best position of a label near its anchor, without overlapping others if possible.

        Args:
            anchor: Point that it belongs to [px].
            radius: Extent of the labelled object around the anchor [px].
            size: The label's width and height [px].
            prefer_rad: Preferred direction from the anchor [rad]; None: no preference.
            besides: Further boxes that this label should not cover.
            keep_off: Discs, by centre and radius [px], that this label covers only if no position on the page
                is free of them and of other labels. By area alone, a large label would hide a small body.
                It has a tail, which avoids them and other labels as well. None: the bodies, without a tail.

        Returns:
            The cost, to compare with other sizes of the label, and the box.
        """
        labels, marks = _edges(self.labels), _edges([*self.marks, *besides])
        lines = _edges(self.lines)
        discs = np.array([(*at, r) for at, r in (self.bodies if keep_off is None else keep_off)]).reshape(
            -1, 3
        )
        best, cheapest = None, (math.inf, math.inf)
        for tried, angle, reach in self._candidates(anchor, radius, size):
            box = tried.moved_into(self.area)
            hides = float(_covered(box.grown(APART_PX), labels) > 0.0)
            hides += _discs_in(box, discs)
            if keep_off is not None:
                under_tail = _discs_between(box.centre, anchor, discs) + _boxes_between(
                    box.centre, anchor, labels
                )
                hides += TAIL * under_tail
            if hides > cheapest[0]:
                continue
            aside = 0.0 if prefer_rad is None else 1.0 - math.cos(angle - prefer_rad)
            hidden = _covered(box.grown(3.0), labels) * 40.0 + _covered(box.grown(2.0), marks) * 8.0
            away = reach / 60.0 + FAR * (reach > FAR_PX)
            crossed = PIECE * _count_covered(box.grown(1.0), lines)
            cost = (hides, hidden / (size[0] * size[1]) + crossed + away + 0.6 * aside)
            if cost < cheapest:
                best, cheapest = box, cost
        assert best is not None
        return cheapest, best

    def _candidates(self, anchor: XY, radius: float, size: XY) -> Iterable[tuple[Box, float, float]]:
        """Candidate boxes around the anchor, just outside its extent, with direction and distance."""
        width, height = size
        for reach in REACHES_PX:
            for k in range(DIRECTIONS):
                angle = math.tau * k / DIRECTIONS
                c, s = math.cos(angle), math.sin(angle)
                span = min(width / 2 / max(abs(c), 1e-9), height / 2 / max(abs(s), 1e-9))
                away = radius + reach + span
                box = Box.around((anchor[0] + away * c, anchor[1] + away * s), width, height)
                yield box, angle, reach
                if self.room is not None and 0.0 < box.overlap(self.room) < width * height:
                    yield box.moved_into(self.room), angle, reach


def _discs_in(box: Box, discs: NDArray[np.float64]) -> int:
    """Number of discs that a box covers or touches."""
    x, y, radius = discs.T
    across = np.maximum(np.maximum(box.left - x, x - box.right), 0.0)
    along = np.maximum(np.maximum(box.bottom - y, y - box.top), 0.0)
    return int((np.hypot(across, along) < radius).sum())


def _discs_between(start: XY, end: XY, discs: NDArray[np.float64]) -> int:
    """Number of discs, other than one around its end, that the line from a label to its anchor crosses."""
    line = complex(*end) - complex(*start)
    if line == 0.0:
        return 0
    centres = discs[:, 0] + 1j * discs[:, 1]
    along = (centres - complex(*start)) / line
    away = np.abs(along - np.clip(along.real, 0.0, 1.0)) * abs(line)
    return int(((away < discs[:, 2]) & (centres != complex(*end))).sum())


def _boxes_between(start: XY, end: XY, edges: NDArray[np.float64]) -> int:
    """Number of boxes that the line from a label to its anchor crosses."""
    x, y = np.linspace(start, end, max(2, math.ceil(math.dist(start, end) / APART_PX))).T
    left, bottom, right, top = edges
    inside = (x[:, None] > left) & (x[:, None] < right) & (y[:, None] > bottom) & (y[:, None] < top)
    return int(inside.any(axis=0).sum())


def _shift(low: float, high: float, least: float, most: float) -> float:
    """Shift that moves an interval into another one."""
    if high - low > most - least:
        return (least + most - low - high) / 2
    return max(least - low, 0.0) + min(most - high, 0.0)


def _edges(boxes: Sequence[Box]) -> NDArray[np.float64]:
    """Shape (4, n): left, bottom, right, top."""
    return np.array([(b.left, b.bottom, b.right, b.top) for b in boxes], dtype=np.float64).reshape(-1, 4).T


def _count_covered(box: Box, others: NDArray[np.float64]) -> int:
    """Number of boxes that overlap a box."""
    left, bottom, right, top = others
    across = (left < box.right) & (box.left < right)
    return int((across & (bottom < box.top) & (box.bottom < top)).sum())


def _covered(box: Box, others: NDArray[np.float64]) -> float:
    """Area of a box covered by others, counted once per covering box."""
    left, bottom, right, top = others
    width = np.minimum(right, box.right) - np.maximum(left, box.left)
    height = np.minimum(top, box.top) - np.maximum(bottom, box.bottom)
    return float((np.maximum(width, 0.0) * np.maximum(height, 0.0)).sum())
