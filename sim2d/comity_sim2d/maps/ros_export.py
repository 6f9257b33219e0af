"""Exports a place as a ROS map: a picture of its cells, `map.yaml`, and a file of named places."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from comity_fis.errors import InputError
from comity_fis.validation.yaml_file import dump_yaml
from comity_sim2d.maps.grey_picture import MAX_CELLS
from comity_sim2d.maps.ros_map import PLACES_SUFFIX
from comity_sim2d.scene.obstacles import floor_plan_of

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

    from comity_sim2d.maps.place_map import PlaceMap
    from comity_sim2d.scene.area import Location
    from comity_sim2d.scene.scene import Scene

CELL_M = 0.05
"""Cell size of most ROS maps [m]."""
FREE, OCCUPIED, UNKNOWN = 254, 0, 205
"""Grey values that `map_saver` writes."""
PGM_MARK = b"# Comity"
YAML_MARK = b"# Comity:"
"""Mark near the start of files written by Comity."""
TOUCHING = 1e-6
"""Cells that overlap an obstacle by less than this are free [cells]."""


def ros_map_files(place: PlaceMap | Scene, name: str, cell_m: float = CELL_M) -> dict[str, bytes]:
    """The files of a place as a ROS map, by name; `ward.yaml` first.

    A cell is free if it is entirely floor without wall or furniture; outside it is unknown. Doors are drawn
    open, since the format has none: the robot's sensors are to see a shut one. Names of rooms are lost.

    Args:
        place: A map or a scene.
        name: Name of the files, without suffix.
        cell_m: Side of a cell [m].

    Raises:
        InputError: If there are more cells than a map may have.
    """
    plan = floor_plan_of(place.room, place.walls, place.furniture, doors=())
    room = plan.room
    low_x, low_y, high_x, high_y = (bound / cell_m for bound in room.bounds)
    left, bottom = math.floor(low_x) - 1, math.floor(low_y) - 1
    columns, rows = math.ceil(high_x) + 1 - left, math.ceil(high_y) + 1 - bottom
    if rows * columns > MAX_CELLS:
        raise InputError(
            expected=f"a place of at most {MAX_CELLS:,} cells of {cell_m:g} m",
            got=f"{columns} x {rows}",
            remedy="Cut the map.",
        )
    corner = (left * cell_m, bottom * cell_m)
    taken = _touched(plan.clear_space(0.0, at_least=False), corner, cell_m, (rows, columns), outside=True)
    floor = _touched(room, corner, cell_m, (rows, columns), outside=False)
    shades = np.where(_and_around(floor), OCCUPIED, UNKNOWN).astype(np.uint8)
    shades[~taken] = FREE
    header = f"P5\n{PGM_MARK.decode()}\n{columns} {rows}\n255\n"
    # The file of named places is written without any, too: one of an earlier export must not stay.
    places = {"schema_version": 1, "locations": {one.name: _place(one) for one in place.locations}}
    return {
        f"{name}.yaml": _yaml(name, cell_m, corner),
        f"{name}.pgm": header.encode() + shades[::-1].tobytes(),
        f"{name}{PLACES_SUFFIX}": _marked(dump_yaml(places, inline=True)),
    }


def _touched(
    shape: BaseGeometry, corner: tuple[float, float], cell_m: float, size: tuple[int, int], *, outside: bool
) -> NDArray[np.bool_]:
    """The cells that overlap a shape, or its outside; the bottom row first."""
    from shapely import bounds, box, difference, get_parts, intersection, is_empty, prepare

    rows, columns = size
    left, bottom = corner
    low = bottom + cell_m * (np.arange(rows) + TOUCHING)
    high = low + cell_m * (1 - 2 * TOUCHING)
    strips = box(np.full(rows, left), low, np.full(rows, left + columns * cell_m), high)
    prepare(shape)
    parts, row = get_parts((difference if outside else intersection)(strips, shape), return_index=True)
    parts, row = parts[~is_empty(parts)], row[~is_empty(parts)]
    # A connected piece within a strip covers all cells between its ends.
    ends = (bounds(parts)[:, (0, 2)] - left) / cell_m
    first = np.floor(ends[:, 0] + TOUCHING).astype(int)
    behind = np.ceil(ends[:, 1] - TOUCHING).astype(int)
    steps = np.zeros((rows, columns + 1), dtype=int)
    some = first < behind
    np.add.at(steps, (row[some], first[some]), 1)
    np.add.at(steps, (row[some], behind[some]), -1)
    return np.asarray(steps.cumsum(axis=1)[:, :-1] > 0)


def _and_around(cells: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The cells and all their neighbours."""
    from scipy.ndimage import binary_dilation

    return np.asarray(binary_dilation(cells, np.ones((3, 3), dtype=bool)))


def _yaml(name: str, cell_m: float, corner: tuple[float, float]) -> bytes:
    content = {
        "image": f"{name}.pgm",
        "mode": "trinary",
        "resolution": cell_m,
        "origin": [round(corner[0], 6), round(corner[1], 6), 0.0],
        "negate": 0,
        "occupied_thresh": 0.65,
        "free_thresh": 0.196,
    }
    return _marked(dump_yaml(content, inline=True))


def _place(location: Location) -> dict[str, Any]:
    facing = location.heading_rad
    told: dict[str, Any] = {"at_m": [location.x_m, location.y_m]}
    return told if facing is None else told | {"facing_deg": round(math.degrees(facing), 6)}


def _marked(text: str) -> bytes:
    return YAML_MARK + b" lengths in metres\n" + text.encode()
