"""The cheapest path if not everyone's personal space can be kept: a search over a cost grid.

A metre of path costs a metre plus `WEIGHT` times the cost to each person (`personal_space`). So people lose
about the same share of their own distances, and the robot passes nearer to a person with a smaller one.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from comity_sim2d.paths.personal_space import PersonalSpace, Points, bounding_box
from comity_sim2d.pose import XY

if TYPE_CHECKING:
    from scipy.sparse import csr_matrix
    from shapely import Polygon

WEIGHT = 25.0
"""Metres of detour that one metre of a person's own distance is worth, if all of it is taken (our choice). A
straight path that takes half of a distance of 0.8 m is worth 5 m of detour."""
CELL_M = 0.10
MOST_CELLS = 1_000_000
"""Maximum number of cells: one hectare at the default cell size; larger places have larger cells (our
choice)."""
NEIGHBOURS = ((1, 0), (0, 1), (1, 1), (1, -1), (2, 1), (1, 2), (2, -1), (1, -2))
"""Half of the sixteen step directions; edges are undirected."""
PULL_CELLS = 3
"""The path is pulled taut between every `PULL_CELLS`-th of its cells."""
LONGEST_PULL = 40
"""Maximum number of such cells handled at a time."""
CORNER_M = 0.02
"""Cost of a corner [m], so that a path has as few as its cost allows."""
SAMPLES = np.linspace(0.02, 0.98, 25)
"""Positions along a line at which its cost is sampled, in (0, 1)."""
POLISH_M, POLISH_ROUNDS = (0.04, 0.02, 0.01), 3
"""Steps by which corners move off the grid while the path gets cheaper [m], and the maximum rounds of
each."""
APART_M = 0.4
"""Minimum distance of corners added for this from other corners [m]."""
POLISH_STEP_M = 0.08
"""Spacing of the cost samples meanwhile [m]."""
AROUND = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1]])
"""Moves of a corner: none, or a step in one of eight directions."""


def line_costs(starts: Points, ends: Points, spaces: Sequence[PersonalSpace]) -> NDArray[np.float64]:
    """Cost of straight lines [m], shape (n,)."""
    lines = ends - starts
    length = np.hypot(lines[:, 0], lines[:, 1])
    points = (starts[:, None] + SAMPLES[:, None] * lines[:, None]).reshape(-1, 2)
    pain = _pain(points, spaces).reshape(len(lines), -1)
    return np.asarray(length * (1.0 + WEIGHT * pain.mean(axis=1)))


def way_cost(points: Sequence[XY], spaces: Sequence[PersonalSpace]) -> float:
    """Cost of a path through corner points [m]."""
    at = np.array(points)
    return float(line_costs(at[:-1], at[1:], spaces).sum())


class CostGrid:
    """The grid over a free polygon; its cells and steps do not depend on people.

    Args:
        free: Region in which the robot's centre may be.
    """

    def __init__(self, free: Polygon) -> None:
        from shapely import contains_xy

        self._free = free
        low_x, low_y, high_x, high_y = free.bounds
        cell_m = max(CELL_M, math.sqrt((high_x - low_x) * (high_y - low_y) / MOST_CELLS))
        self._cell_m = cell_m
        x, y = _marks(low_x, high_x, cell_m), _marks(low_y, high_y, cell_m)
        grid = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1)
        is_free = contains_xy(free, grid[..., 0], grid[..., 1])
        number = np.where(is_free, np.cumsum(is_free).reshape(is_free.shape) - 1, -1)
        self._cells = grid[is_free]
        pairs = [_neighbours(number, dx, dy) for dx, dy in NEIGHBOURS]
        one, other = (np.concatenate(ends) for ends in zip(*pairs, strict=True))
        steps = np.repeat([math.hypot(*step) for step in NEIGHBOURS], [len(pair[0]) for pair in pairs])
        clear = _are_clear(free, self._cells, one, other, ~_is_deep_inside(is_free)[is_free])
        self._one, self._other, self._steps = one[clear], other[clear], steps[clear]

    def cheapest_way(self, start: XY, goal: XY, spaces: Sequence[PersonalSpace]) -> list[XY] | None:
        """Corner points of the cheapest path; None if the grid has none.

        Args:
            start: Start of the robot's centre [m].
            goal: Goal of the robot's centre [m].
            spaces: Personal spaces of the people near the path.
        """
        cells = self._search(start, goal, spaces)
        return None if cells is None else self.polished(_pulled(self._free, cells, spaces), spaces)

    def polished(self, corners: Sequence[XY], spaces: Sequence[PersonalSpace]) -> list[XY]:
        """A path with its corners moved off the grid to lower its cost, to within a centimetre or two.

        Args:
            corners: Corner points of the path.
            spaces: Personal spaces of the people near the path.
        """
        return _polished(self._free, corners, spaces)

    def _search(self, start: XY, goal: XY, spaces: Sequence[PersonalSpace]) -> list[XY] | None:
        """The cells of the cheapest path over the grid (Dijkstra), including both ends."""
        from scipy.sparse.csgraph import dijkstra

        first, last = (_nearest_cell(self._free, self._cells, xy, self._cell_m) for xy in (start, goal))
        if first is None or last is None:
            return None
        graph = self._graph(spaces)
        cost, before = dijkstra(graph, directed=False, indices=[first], return_predecessors=True)
        if not math.isfinite(cost[0, last]):
            return None
        back = [last]
        while back[-1] != first:
            back.append(int(before[0, back[-1]]))
        return [start, *((float(x), float(y)) for x, y in self._cells[back[::-1]]), goal]

    def _graph(self, spaces: Sequence[PersonalSpace]) -> csr_matrix[np.float64]:
        """Costs between adjacent cells."""
        from scipy.sparse import csr_matrix

        price = self._cell_m * (1.0 + WEIGHT * _pain(self._cells, spaces))
        cost = self._steps * (price[self._one] + price[self._other]) / 2.0
        return csr_matrix((cost, (self._one, self._other)), shape=(len(price), len(price)))


def _pain(points: Points, spaces: Sequence[PersonalSpace]) -> NDArray[np.float64]:
    return sum((space.discomfort(points) for space in spaces), start=np.zeros(len(points)))


def _marks(low: float, high: float, cell_m: float) -> NDArray[np.float64]:
    """Coordinates one cell apart, centred in the interval: a mirrored room has a mirrored grid."""
    count = math.ceil((high - low) / cell_m)
    return np.asarray((low + high) / 2.0 + cell_m * (np.arange(count) - (count - 1) / 2.0), dtype=float)


def _is_deep_inside(is_free: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Whether all cells within one step of a cell are free."""
    inside = np.pad(is_free, 2)
    for _ in range(2):  # along one axis, then along the other; scipy.ndimage takes longer to import than this
        inside = inside[:-4] & inside[1:-3] & inside[2:-2] & inside[3:-1] & inside[4:]
        inside = inside.T
    return inside


def _are_clear(
    free: Polygon,
    cells: Points,
    one: NDArray[np.int64],
    other: NDArray[np.int64],
    at_edge: NDArray[np.bool_],
) -> NDArray[np.bool_]:
    """Whether steps are clear of obstacles; tested only if both ends are at the edge of the free space.

    A step with an end deep inside crosses only free cells, and obstacles are wider than a cell.
    """
    from shapely import covers, linestrings

    clear = np.ones(len(one), dtype=bool)
    asked = at_edge[one] & at_edge[other]
    clear[asked] = covers(free, linestrings(np.stack([cells[one[asked]], cells[other[asked]]], axis=1)))
    return clear


def _neighbours(number: NDArray[np.int64], dx: int, dy: int) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Indices of all pairs of free cells that are one step apart."""
    wide, high = number.shape
    here = number[: wide - dx, max(0, -dy) : high - max(0, dy)]
    there = number[dx:, max(0, dy) : high + min(0, dy)]
    both = (here >= 0) & (there >= 0)
    return here[both], there[both]


def _nearest_cell(free: Polygon, cells: Points, xy: XY, cell_m: float) -> int | None:
    """Index of the nearest cell that can be reached in a straight line."""
    from shapely import LineString

    apart = np.hypot(*(cells - np.array(xy)).T)
    for i in np.argsort(apart)[:8].tolist():
        line = LineString([xy, cells[i]])
        if apart[i] < 3 * cell_m and line.difference(free).length < apart[i] / 2 + 1e-6:
            return int(i)
    return None


def _pulled(free: Polygon, cells: list[XY], spaces: Sequence[PersonalSpace]) -> list[XY]:
    """The cheapest path of straight lines between some of the cells (dynamic programming)."""
    from shapely import covers, linestrings

    at = np.array(_corner_candidates(free, cells))
    pairs = [(i, j) for i, j in itertools.combinations(range(len(at)), 2) if j - i <= LONGEST_PULL]
    one, other = np.array(pairs).T
    cost = line_costs(at[one], at[other], spaces) + CORNER_M
    clear = covers(free, linestrings(np.stack([at[one], at[other]], axis=1)))
    cost[~(clear | (other - one == 1))] = np.inf
    best, before = np.full(len(at), np.inf), np.zeros(len(at), dtype=int)
    best[0] = 0.0
    for i, j, price in zip(one.tolist(), other.tolist(), cost.tolist(), strict=True):
        if best[i] + price < best[j]:
            best[j], before[j] = best[i] + price, i
    corners = [len(at) - 1]
    while corners[-1]:
        corners.append(int(before[corners[-1]]))
    return [(float(x), float(y)) for x, y in at[corners[::-1]]]


def _corner_candidates(free: Polygon, cells: list[XY]) -> list[XY]:
    """Every third cell, those between them where a straight line would cut a corner, and both ends."""
    from shapely import LineString

    marks = [0, *range(1, len(cells) - 1, PULL_CELLS), len(cells) - 1]
    found = [cells[0]]
    for i, j in itertools.pairwise(marks):
        if not free.covers(LineString([cells[i], cells[j]])):
            found.extend(cells[i + 1 : j])
        found.append(cells[j])
    return found


def _polished(free: Polygon, corners: Sequence[XY], spaces: Sequence[PersonalSpace]) -> list[XY]:
    """The corners moved off the grid to lower the cost, odd and even ones in turn."""
    farthest = POLISH_ROUNDS * sum(POLISH_M)
    box = bounding_box(np.concatenate([np.array(corners) - farthest, np.array(corners) + farthest]))
    near = [space for space in spaces if not space.is_beyond(box)]
    at = _with_corners_beside(np.array(corners), near)
    for step_m in POLISH_M:
        for _ in range(POLISH_ROUNDS):
            moved = [_move_corners(free, at, np.arange(i, len(at) - 1, 2), step_m, near) for i in (1, 2)]
            if not any(moved):
                break
    return [(float(x), float(y)) for x, y in at]


def _with_corners_beside(at: Points, spaces: Sequence[PersonalSpace]) -> Points:
    """The path with a corner added next to each person whose space a long segment crosses."""
    found = [at[0]]
    for start, end in itertools.pairwise(at):
        length = math.dist(start, end)
        ahead = (end - start) / max(length, 1e-9)
        crossed = [space for space in spaces if not space.is_beyond(bounding_box(np.array([start, end])))]
        for along in sorted(float((np.array(space.xy) - start) @ ahead) for space in crossed):
            beside = start + along * ahead
            if along < length - APART_M and math.dist(found[-1], beside) > APART_M and along > APART_M:
                found.append(beside)
        found.append(end)
    return np.array(found)


def _move_corners(
    free: Polygon, at: Points, which: NDArray[np.int64], step_m: float, spaces: Sequence[PersonalSpace]
) -> bool:
    """Move corners, no two of them adjacent, to the cheapest clear place nearby; whether any moved."""
    from shapely import covers, linestrings

    if not len(which):
        return False
    tried = at[which][:, None] + step_m * AROUND
    ways = np.stack(np.broadcast_arrays(at[which - 1][:, None], tried, at[which + 1][:, None]), axis=2)
    lines = np.stack([ways[:, :, :2], ways[:, :, 1:]]).reshape(-1, 2, 2)
    cost = _fine_costs(lines, spaces).reshape(2, len(which), -1).sum(axis=0)
    is_clear = np.array(covers(free, linestrings(ways)))
    is_clear[:, 0] = True  # the current place is clear
    cost[~is_clear] = np.inf
    best = cost.argmin(axis=1)
    at[which] = tried[np.arange(len(which)), best]
    return bool(best.any())


def _fine_costs(lines: NDArray[np.float64], spaces: Sequence[PersonalSpace]) -> NDArray[np.float64]:
    """Cost of straight lines [m], sampled at equal spacing on all of them; shape (n,)."""
    length = np.hypot(*(lines[:, 1] - lines[:, 0]).T)
    count = np.maximum(np.ceil(length / POLISH_STEP_M).astype(int), 1)
    first = np.cumsum(count) - count
    line = np.repeat(np.arange(len(lines)), count)
    along = (np.arange(len(line)) - first[line] + 0.5) / count[line]
    points = lines[line, 0] + along[:, None] * (lines[line, 1] - lines[line, 0])
    pain = np.add.reduceat(_pain(points, spaces), first) / count
    return np.asarray(length * (1.0 + WEIGHT * pain))
