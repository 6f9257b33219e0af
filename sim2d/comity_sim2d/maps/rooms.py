"""Derives the floor of a map from its rooms, and the walls between rooms that touch.

Coordinates are rounded to a grid of one millimetre, so that corners meant to coincide do.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from comity_fis.listing import listed
from comity_sim2d.pose import XY
from comity_sim2d.scene.area import Area
from comity_sim2d.scene.room import Room, Wall
from comity_sim2d.scene_error import SceneError

if TYPE_CHECKING:
    from shapely import LinearRing, LineString, Polygon
    from shapely.geometry.base import BaseGeometry

GRID_M = 0.001
THICKNESS_M = 0.10
"""Thickness of the walls between rooms [m] (our choice: a light partition)."""


def floor_of(areas: Sequence[Area], holes: Sequence[Sequence[XY]] = ()) -> Room:
    """The union of the rooms, minus the holes.

    Raises:
        SceneError: For the first room that does not touch the others.
    """
    from shapely import Point, Polygon, difference, get_parts, union_all

    floor = union_all([shape_of(area) for area in areas], grid_size=GRID_M).simplify(0.0)
    if holes:
        floor = difference(floor, union_all([Polygon(hole) for hole in holes]), grid_size=GRID_M).simplify(
            0.0
        )
    if not isinstance(floor, Polygon):
        first = next(part for part in get_parts(floor) if part.intersects(shape_of(areas[0])))
        apart = next(area for area in areas if not first.covers(Point(_inside(area))))
        raise SceneError(
            entity=f"room {apart.name}",
            expected="rooms that touch or overlap, so that their union is one floor",
            got=f"{apart.name!r} apart from {areas[0].name!r}",
            remedy="Move it so that it shares a part of its outline with another room, or remove it.",
        )
    return Room(_corners(floor.exterior), tuple(_corners(hole) for hole in floor.interiors))


def walls_between(areas: Sequence[Area], floor: Room) -> tuple[Wall, ...]:
    """Straight walls where rooms touch, named after both rooms; none where rooms overlap."""
    from shapely import Polygon, difference, get_parts, line_merge, union_all

    shapes = [shape_of(area) for area in areas]
    outlines = union_all([shape.boundary for shape in shapes], grid_size=GRID_M)
    edge = Polygon(floor.corners, floor.holes).boundary
    inner = difference(outlines, edge, grid_size=GRID_M)
    pieces = [piece for line in get_parts(inner) for piece in _straight(line)]
    kept = [piece for piece in pieces if not _inside_any(piece, shapes)]
    lines = get_parts(line_merge(union_all(kept))) if kept else ()
    found = [piece for line in lines for piece in _straight(line.simplify(GRID_M / 2))]
    ends = sorted(tuple(sorted(_ends(piece))) for piece in found)
    return tuple(Wall(start, end, THICKNESS_M, _between(start, end, areas, shapes)) for start, end in ends)


def shape_of(area: Area) -> Polygon:
    """The polygon of a room, on the grid."""
    from shapely import Polygon, set_precision

    return set_precision(Polygon(area.corners), GRID_M)


def _inside(area: Area) -> XY:
    point = shape_of(area).representative_point()
    return (point.x, point.y)


def _corners(ring: LinearRing) -> tuple[XY, ...]:
    return tuple((float(x), float(y)) for x, y in np.asarray(ring.coords)[:-1])


def _straight(line: BaseGeometry) -> list[LineString]:
    """The straight pieces of a line; none of other geometries, such as a point of contact."""
    from shapely import LineString

    return [LineString(pair) for pair in pairwise(line.coords)] if line.length > 0.0 else []


def _ends(piece: LineString) -> tuple[XY, XY]:
    (ax, ay), (bx, by) = np.asarray(piece.coords).round(3).tolist()
    return ((ax, ay), (bx, by))


def _inside_any(piece: LineString, shapes: Sequence[Polygon]) -> bool:
    """Whether a piece of one room's outline runs inside another room, where the two overlap."""
    middle = piece.interpolate(0.5, normalized=True)
    return any(shape.contains(middle) and shape.boundary.distance(middle) > GRID_M for shape in shapes)


def _between(start: XY, end: XY, areas: Sequence[Area], shapes: Sequence[Polygon]) -> str:
    from shapely import Point

    (ax, ay), (bx, by) = start, end
    length = float(np.hypot(bx - ax, by - ay))
    aside = (10.0 * GRID_M * (ay - by) / length, 10.0 * GRID_M * (bx - ax) / length)
    sides = [Point((ax + bx) / 2 + side * aside[0], (ay + by) / 2 + side * aside[1]) for side in (1.0, -1.0)]
    names = [
        next((area.name for area, shape in zip(areas, shapes, strict=True) if shape.contains(side)), "")
        for side in sides
    ]
    return f"the wall between {listed(sorted(names))}"
