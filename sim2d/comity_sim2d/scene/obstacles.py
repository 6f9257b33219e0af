"""Obstacles: the floor plan as static shapes, and the people on it as discs."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

from comity_fis.proxemics import PERSON_MARGIN_M
from comity_sim2d.pose import XY
from comity_sim2d.scene.door import Door
from comity_sim2d.scene.room import Furniture, Room, Wall

if TYPE_CHECKING:
    from shapely import Polygon
    from shapely.geometry.base import BaseGeometry

WALL_MARGIN_M = 0.05
"""Clearance of the robot from walls and furniture [m] (our choice: ten times the error of the drive)."""
FREE_FROM_M = PERSON_MARGIN_M + 0.005
"""Gap to a bystander at which a place is free [m]: the path to it, around the same person, comes millimetres
nearer."""
KEPT = 256
"""Size of the caches of blockers of discs and lines: the same poses recur."""
ROOM = "the room's outer wall"
FEW_LINES = 3
"""Number of lines up to which a loop is faster (measured)."""


@dataclass(frozen=True, slots=True)
class Blocker:
    """An obstacle that a disc overlaps."""

    name: str
    """Its name in a sentence: `the table`, `table 2`, `wall 2`, `marta`, `the room's outer wall`."""
    gap_m: float
    """Gap between the disc and the obstacle [m]; negative if they overlap."""

    @property
    def relation(self) -> str:
        """The relation of the disc to the obstacle, as the end of a sentence."""
        if self.name == ROOM and self.gap_m < 0.0:
            return "is not inside the room"
        return f"is {self.gap_m:.2f} m from {self.name}" if self.gap_m >= 0.0 else f"overlaps {self.name}"


@dataclass(frozen=True, slots=True)
class Segments:
    """Thick line segments: outlines of the floor and of furniture, inner walls, shut doors."""

    ends: NDArray[np.float64]
    """Shape (n, 2, 2): line, start or end, x or y [m]."""
    half_m: NDArray[np.float64]
    """Half the thickness, with round ends [m]; shape (n,)."""


class FloorPlan:
    """All static obstacles: the room, its walls with shut doors, and its furniture."""

    def __init__(self, room: Room, walls: tuple[Wall, ...], furniture: tuple[Furniture, ...]) -> None:
        from shapely import LineString, Polygon, STRtree, prepare

        self.room: Polygon = Polygon(room.corners, room.holes)
        self._edge = self.room.boundary
        prepare(self.room)
        prepare(self._edge)
        lines = [LineString([wall.start, wall.end]) for wall in walls]
        pieces = [Polygon(piece.corners) for piece in furniture]
        # Solid i is at most reach[i] wider than its shape: walls are lines plus half their thickness.
        self._shapes: list[BaseGeometry] = [*lines, *pieces]
        self._reach = np.array([wall.thickness_m / 2 for wall in walls] + [0.0] * len(pieces))
        self._names: list[str] = [wall.name or f"wall {i}" for i, wall in enumerate(walls, start=1)]
        self._names += [piece.called for piece in furniture]
        self._wall_count = len(walls)
        self._widest_m = float(self._reach.max(initial=0.0))
        self._tree = STRtree(self._shapes)
        self._clear = lru_cache(maxsize=None)(self._clear_space)
        self.blocker = lru_cache(maxsize=KEPT)(self._find_blocker)
        """The nearest obstacle that a disc (centre, radius) overlaps; None if it is free inside the room."""
        self.wall_between = lru_cache(maxsize=KEPT)(self._find_wall_between)
        """Name of a wall or shut door that crosses a line (its ends); furniture does not block the view."""
        self._outlines = (*room.outlines, *(piece.corners for piece in furniture))
        self._walls = walls
        self._made_of = room, walls, furniture

    def __reduce__(self) -> tuple[type[FloorPlan], tuple[Room, tuple[Wall, ...], tuple[Furniture, ...]]]:
        """Only the inputs are pickled; shapes and caches are rebuilt."""
        return FloorPlan, self._made_of

    @cached_property
    def bare(self) -> FloorPlan:
        """The floor plan without furniture, on which people may sit."""
        room, walls, _ = self._made_of
        return _floor_plan(room, walls, ())

    @cached_property
    def segments(self) -> Segments:
        """All obstacles as line segments."""
        edges = [
            pair
            for outline in self._outlines
            for pair in zip(outline, (*outline[1:], outline[0]), strict=True)
        ]
        ends = [*edges, *((wall.start, wall.end) for wall in self._walls)]
        half_m = [0.0] * len(edges) + [wall.thickness_m / 2 for wall in self._walls]
        return Segments(np.array(ends), np.array(half_m))

    def is_floor(self, xy: XY) -> bool:
        """Whether a point is in the room, edge included, whatever stands there; False for NaN."""
        from shapely import intersects_xy

        return bool(intersects_xy(self.room, *xy))

    def _find_blocker(self, xy: XY, radius_m: float) -> Blocker | None:
        from shapely import Point

        point = Point(xy)
        inside = self.room.contains(point)
        edge = self._edge.distance(point)
        found = [] if inside and edge >= radius_m else [Blocker(ROOM, (edge if inside else -edge) - radius_m)]
        for i in sorted(self._tree.query(point, predicate="dwithin", distance=radius_m + self._widest_m)):
            gap = self._shapes[i].distance(point) - float(self._reach[i]) - radius_m
            if gap < 0.0:
                found.append(Blocker(self._names[i], gap))
        return min(found, key=lambda blocker: blocker.gap_m, default=None)

    def within(self, region: BaseGeometry, xy: XY) -> Blocker | None:
        """The obstacle in a region that is nearest to a point, with its distance, or None.

        Args:
            region: Any shape.
            xy: The point, such as the centre of a robot whose arms sweep the region.
        """
        from shapely import Point

        point = Point(xy)
        shapes: list[tuple[str, BaseGeometry]] = [(ROOM, self._edge)]
        for i in self._tree.query(region, predicate="dwithin", distance=self._widest_m):
            half_m = float(self._reach[i])
            shapes.append((self._names[i], self._shapes[i].buffer(half_m) if half_m else self._shapes[i]))
        found = [(name, shape.intersection(region)) for name, shape in shapes]
        gaps = [Blocker(name, part.distance(point)) for name, part in found if not part.is_empty]
        return min(gaps, key=lambda blocker: blocker.gap_m, default=None)

    def _find_wall_between(self, start: XY, end: XY) -> str | None:
        from shapely import LineString

        line = LineString([start, end])
        if not self.room.covers(line):
            return ROOM
        for i in sorted(self._tree.query(line, predicate="dwithin", distance=self._widest_m).tolist()):
            # With their thickness: there is a seam between the lines of a wall and a shut door.
            if i < self._wall_count and self._shapes[i].distance(line) <= self._reach[i]:
                return self._names[int(i)]
        return None

    def are_free(self, points: NDArray[np.float64], radius_m: float) -> NDArray[np.bool_]:
        """Whether discs are free inside the room: `blocker` for many at once; shape (n, 2) to (n,)."""
        from shapely import contains_xy, distance
        from shapely import points as as_points

        shapes = np.asarray(as_points(points))
        free = contains_xy(self.room, points[:, 0], points[:, 1]) & ~(distance(self._edge, shapes) < radius_m)
        near, solid = self._tree.query(shapes, predicate="dwithin", distance=radius_m + self._widest_m)
        gap_m = distance(shapes[near], self._tree.geometries[solid]) - self._reach[solid] - radius_m
        free[near[gap_m < 0.0]] = False
        return np.asarray(free)

    def are_in_view(self, start: XY, ends: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Whether no wall is between a point and others: `wall_between` for many; shape (n, 2) to (n,)."""
        from shapely import covers, distance, linestrings

        lines = np.asarray(linestrings(np.stack([np.broadcast_to(start, ends.shape), ends], axis=1)))
        seen = np.asarray(covers(self.room, lines))
        near, solid = self._tree.query(lines, predicate="dwithin", distance=self._widest_m)
        is_wall = solid < self._wall_count
        near, solid = near[is_wall], solid[is_wall]
        seen[near[distance(lines[near], self._tree.geometries[solid]) <= self._reach[solid]]] = False
        return seen

    def view_blockers(self) -> NDArray[np.float64]:
        """Lines that block the view: inner walls, and outlines of a non-convex room; shape (n, 2, 2)."""
        lines = [_with_ends(wall) for wall in self._walls]
        if self.room.convex_hull.area > self.room.area + 1e-9:
            for ring in (self.room.exterior, *self.room.interiors):
                lines += list(np.stack([ring.coords[:-1], ring.coords[1:]], axis=1))
        return np.array(lines).reshape(-1, 2, 2)

    def clear_space(self, clearance_m: float, *, at_least: bool = True) -> BaseGeometry:
        """The region that keeps a clearance from all static obstacles, as polygons with rounded corners.

        Args:
            clearance_m: The clearance [m].
            at_least: True: all its points keep the clearance; False: it contains all points that do.
        """
        return self._clear(clearance_m, at_least)

    def _clear_space(self, clearance_m: float, at_least: bool) -> BaseGeometry:
        from shapely import difference, union_all

        solids = [
            offset(shape, clearance_m + reach, at_least=at_least)
            for shape, reach in zip(self._shapes, self._reach, strict=True)
        ]
        return difference(offset(self.room, -clearance_m, at_least=at_least), union_all(solids))

    def leave_clear(self, lines: Sequence[NDArray[np.float64]], clearance_m: float) -> NDArray[np.bool_]:
        """Whether polylines are inside the room and keep a clearance from all static obstacles.

        Args:
            lines: Each of shape (n, 2), with at least two points [m].
            clearance_m: The clearance [m].

        Returns:
            Shape (number of lines,).
        """
        from shapely import contains_xy, distance, dwithin, linestrings

        if len(lines) <= FEW_LINES:
            shapes = np.array([linestrings(line) for line in lines])
        else:
            which = np.repeat(np.arange(len(lines)), [len(line) for line in lines])
            shapes = np.asarray(linestrings(np.concatenate(lines), indices=which))
        first = np.array([line[0] for line in lines])
        # A line far from the edge is inside if any of its points is.
        clear = contains_xy(self.room, first[:, 0], first[:, 1]) & ~dwithin(self._edge, shapes, clearance_m)
        if not clear.any():
            return np.asarray(clear)
        near, solid = self._tree.query(shapes, predicate="dwithin", distance=clearance_m + self._widest_m)
        gap_m = distance(shapes[near], self._tree.geometries[solid]) - self._reach[solid]
        clear[near[gap_m < clearance_m]] = False
        return np.asarray(clear)


def _with_ends(wall: Wall) -> NDArray[np.float64]:
    """A wall from one round end to the other, shape (2, 2)."""
    start, end = np.array(wall.start), np.array(wall.end)
    length = math.dist(wall.start, wall.end)
    more = (end - start) * (wall.thickness_m / 2 / length) if length else np.zeros(2)
    return np.asarray(np.stack([start - more, end + more]))


CORNER_SEGMENTS = 8
"""Number of straight pieces per quarter circle."""


def offset(shape: BaseGeometry, distance_m: float, *, at_least: bool = True) -> BaseGeometry:
    """A shape grown (or shrunk) by at least, or at most, a distance.

    Its rounded corners are polygons outside or inside the arcs.
    """
    outside = 1.0 / math.cos(math.pi / (4 * CORNER_SEGMENTS)) if at_least else 1.0
    return shape.buffer(distance_m * outside, quad_segs=CORNER_SEGMENTS)


@lru_cache(maxsize=64)
def _floor_plan(room: Room, walls: tuple[Wall, ...], furniture: tuple[Furniture, ...]) -> FloorPlan:
    return FloorPlan(room, walls, furniture)


class Floor(Protocol):
    """The parts of a floor plan, as in a scene or a map."""

    @property
    def room(self) -> Room:
        """The outline."""
        ...

    @property
    def walls(self) -> tuple[Wall, ...]:
        """The inner walls."""
        ...

    @property
    def furniture(self) -> tuple[Furniture, ...]:
        """The furniture."""
        ...

    @property
    def doors(self) -> tuple[Door, ...]:
        """The doors, each in a gap of the walls."""
        ...


def floor_plan(place: Floor, doors: Iterable[Door] | None = None) -> FloorPlan:
    """The floor plan of a place, optionally with its doors in other states."""
    return floor_plan_of(place.room, place.walls, place.furniture, place.doors if doors is None else doors)


def floor_plan_of(
    room: Room, walls: tuple[Wall, ...], furniture: tuple[Furniture, ...], doors: Iterable[Door]
) -> FloorPlan:
    """The floor plan of a place, shared by all places with the same room, walls, furniture and shut doors."""
    shut = [door for door in doors if not door.is_open]
    leaves = (Wall(door.start, door.end, door.thickness_m, door.shut_name) for door in shut)
    return _floor_plan(room, (*walls, *leaves), furniture)
