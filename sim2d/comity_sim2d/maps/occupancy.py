"""Turns a grid of free cells into one floor outline with few corners, inside the free cells."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from comity_sim2d.pose import XY

if TYPE_CHECKING:
    from shapely import Polygon
    from shapely.geometry.base import BaseGeometry

ROUNDING = 1e-9
"""Tolerance for a corner to be on a line [cells]."""


@dataclass(frozen=True, slots=True)
class FloorOutline:
    """The largest connected free region, as outlines [cells] from the lower left corner."""

    outline: tuple[XY, ...]
    holes: tuple[tuple[XY, ...], ...]
    share: float
    """Share of all free cells that it covers, in [0, 1]."""


def floor_of_cells(free: NDArray[np.bool_], tolerance: float) -> FloorOutline | None:
    """The floor outline of free cells.

    Every point of the floor, its edge included, lies in a free cell. It contains every point connected to it
    that is farther than the tolerance from all cells that are not free.

    Args:
        free: Shape (rows, columns), the bottom row first.
        tolerance: Maximum distance by which the outline cuts corners off the free region [cells].

    Returns:
        None if nothing is left.
    """
    from shapely import difference, get_parts, union_all

    count = int(free.sum())
    exact = _largest(_joined(_largest_patch(free)).simplify(0.0))
    if exact is None:
        return None
    pockets = [pocket for ring in _rings(exact) for pocket in _pockets(ring, tolerance)]
    rest = difference(exact, union_all(pockets)) if pockets else exact
    floor = _largest(*get_parts(rest.simplify(0.0)))
    if floor is None:
        return None
    holes = tuple(_corners(np.asarray(hole.coords)) for hole in floor.interiors)
    return FloorOutline(_corners(np.asarray(floor.exterior.coords)), holes, floor.area / count)


def corners_of_cells(free: NDArray[np.bool_]) -> int:
    """Number of corners of the free cells' outlines; a noisy picture has hundreds of thousands."""
    around = np.pad(free, 1)
    low, high = around[:-1], around[1:]
    four = np.stack([low[:, :-1], low[:, 1:], high[:, :-1], high[:, 1:]]).astype(np.int8)
    count = four.sum(axis=0)
    crossing = (count == 2) & (four[0] == four[3])  # two cells touch at a corner only
    return int((count % 2).sum() + 2 * crossing.sum())


def _corners(ring: NDArray[np.float64]) -> tuple[XY, ...]:
    return tuple((float(x), float(y)) for x, y in ring[:-1])


def _largest_patch(free: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The largest region of cells connected by their edges; of equally large ones the lowest."""
    from scipy.ndimage import label

    numbers, found = label(free)
    if not found:
        return free
    counts = np.bincount(numbers.ravel())[1:]
    return np.asarray(numbers == 1 + int(counts.argmax()))


def _joined(free: NDArray[np.bool_]) -> BaseGeometry:
    """The union of the cells: runs along rows, merged with equal runs above."""
    from shapely import box, union_all

    padded = np.zeros((free.shape[0], free.shape[1] + 2), dtype=np.int8)
    padded[:, 1:-1] = free
    step = np.diff(padded, axis=1)
    rows, starts = np.nonzero(step == 1)
    ends = np.nonzero(step == -1)[1]
    # Sorted by columns and then by rows, a run that continues in the next row comes next.
    order = np.lexsort((rows, ends, starts))
    rows, starts, ends = rows[order], starts[order], ends[order]
    goes_on = (np.diff(rows) == 1) & (np.diff(starts) == 0) & (np.diff(ends) == 0)
    first = np.flatnonzero(np.concatenate([[True], ~goes_on])) if len(rows) else np.array([], dtype=int)
    last = np.concatenate([first[1:] - 1, [len(rows) - 1]]) if len(rows) else first
    return union_all(box(starts[first], rows[first], ends[first], rows[last] + 1))


def _largest(*shapes: BaseGeometry) -> Polygon | None:
    """The polygon with the largest area; of equally large ones the leftmost."""
    from shapely import Polygon

    polygons = [shape for shape in shapes if isinstance(shape, Polygon) and shape.area > 0.0]
    return max(polygons, key=lambda shape: (round(shape.area, 6), *(-b for b in shape.bounds)), default=None)


def _rings(shape: Polygon) -> Iterator[NDArray[np.float64]]:
    """Its outlines, each of shape (n, 2), first point repeated, free side on the left."""
    from shapely.geometry.polygon import orient

    turned = orient(shape, 1.0)
    for ring in (turned.exterior, *turned.interiors):
        yield np.asarray(ring.coords)


def _pockets(ring: NDArray[np.float64], tolerance: float) -> Iterator[Polygon]:
    """The polygons that straight lines cut off the free side of an outline.

    Args:
        ring: Shape (n, 2), first point repeated, free side on the left.
        tolerance: Maximum distance of a corner from the line.
    """
    from shapely import Polygon

    corners = ring[:-1]
    kept = _kept(corners, tolerance)
    for start, end in pairwise([*kept, kept[0] + len(corners)]):
        path = _path(corners, start, end)
        left, _ = _off_chord(path)
        on_it = 1 + np.flatnonzero(left > -ROUNDING)
        for one, other in pairwise((0, *on_it.tolist(), end - start)):
            if other - one > 1:
                yield Polygon(path[one : other + 1])


def _kept(corners: NDArray[np.float64], tolerance: float) -> list[int]:
    """Indices of the corners to keep: Douglas and Peucker (1973), then dropping those that can go."""
    count = len(corners)
    far = int(np.hypot(*(corners - corners[0]).T).argmax())
    kept, todo = {0, far}, [(0, far), (far, count)]
    while todo:
        start, end = todo.pop()
        if (worst := _worst(_path(corners, start, end), tolerance)) is not None:
            middle = start + worst
            kept.add(middle % count)
            todo += [(start, middle), (middle, end)]
    stays = sorted(kept)
    i = 0
    while i < len(stays) and len(stays) > 3:
        before, after = stays[i - 1] - count * (i == 0), stays[(i + 1) % len(stays)]
        after += count * (i == len(stays) - 1)
        if _worst(_path(corners, before, after), tolerance) is None:
            del stays[i]
            i = max(i - 1, 0)
        else:
            i += 1
    return stays


def _path(corners: NDArray[np.float64], start: int, end: int) -> NDArray[np.float64]:
    return corners[np.arange(start, end + 1) % len(corners)]


def _worst(path: NDArray[np.float64], tolerance: float) -> int | None:
    """The corner that prevents a path from being replaced by the straight line between its ends.

    Returns:
        Its index; None if the line can replace it: all corners are near it and on its right, which is not
        free.
    """
    if len(path) < 3:
        return None
    left, past = _off_chord(path)
    excess = np.maximum.reduce([left, -left - tolerance, past])
    return None if excess.max() <= ROUNDING else 1 + int(excess.argmax())


def _off_chord(path: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Distances of the inner corners of a path to the left of the chord, and past its ends."""
    chord, between = path[-1] - path[0], path[1:-1] - path[0]
    length = float(np.hypot(*chord))
    along = between @ chord / length
    left = (chord[0] * between[:, 1] - chord[1] * between[:, 0]) / length
    return left, np.maximum(-along, along - length)
