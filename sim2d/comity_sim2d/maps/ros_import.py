"""Converts a ROS map to a place: one room, its holes, and the places named beside it.

The thresholds and modes are those of `nav2_map_server`. Only free cells become floor. Unknown cells do not:
nothing shows that a robot could stand there.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from comity_fis.errors import InputError
from comity_fis.validation.yaml_file import YamlFile, read_yaml
from comity_sim2d.maps.building import furniture_of
from comity_sim2d.maps.check import WAY_M
from comity_sim2d.maps.file import MAX_HOLES, FurniturePiece
from comity_sim2d.maps.grey_picture import GreyPicture, read_grey
from comity_sim2d.maps.occupancy import FloorOutline, corners_of_cells, floor_of_cells
from comity_sim2d.maps.ros_map import PlacesFile, RosMap, RosMapFile, places_beside
from comity_sim2d.pose import XY
from comity_sim2d.scene.robot_body import ROBOT_RADIUS_M
from comity_sim2d.scene_error import FARTHEST_M

FLOOR = "floor"
"""Name of the only room of such a map."""
MILLIMETRES = 3
"""Decimals of coordinates in metres, as in every map."""
USUALLY_UNKNOWN = 205 / 255
"""The grey value that `map_saver` writes for an unknown cell."""
MAX_CELL_CORNERS = 150_000
"""Maximum number of corners of the free cells' outlines: polygons of these take about 12 s on one core (our
choice)."""
BESIDE = ("locations", "furniture")
"""Keys of the file beside a ROS map that are those of a map, too."""
TOUCHING = 0.05
"""Depth from which furniture reaches into a cell [cells] (our choice: that of rounded coordinates)."""
SMALL_M2 = 25.0
"""Area from which a floor without room for a robot is no matter of the resolution [m^2] (our choice)."""
KEPT = 8
"""Number of pictures whose floor is cached: each test case requests it again."""


def converted(file: YamlFile) -> RosMap:
    """A ROS map in our format: one room, its holes, and the places named in the file next to it.

    Raises:
        InputError: If one of the three files cannot be used.
    """
    ros = file.check(RosMapFile)
    beside = places_beside(file.path)
    places = read_yaml(beside, str(Path(file.name).with_name(beside.name))) if beside.exists() else None
    told = places.check(PlacesFile) if places is not None else PlacesFile(schema_version=1)
    with file.placing("image"):
        picture = read_grey(file.path.parent / ros.image, ros.image)
    free, unknown = cells(picture, ros)
    free |= _under_furniture(told.furniture, free.shape, ros)
    corners = corners_of_cells(free)
    if corners > MAX_CELL_CORNERS:
        raise _noisy(f"free cells have at most {MAX_CELL_CORNERS:,} corners", corners).at(
            file.where(("image",))
        )
    tolerance_m = told.tolerance_m or ros.resolution
    floor = _floor(free.tobytes(), free.shape, tolerance_m / ros.resolution)
    if floor is None:
        raise _no_floor(ros).at(file.where(("image",)))
    if len(floor.holes) > MAX_HOLES:
        raise _noisy(f"floor has at most {MAX_HOLES:,} holes", len(floor.holes)).at(file.where(("image",)))
    outline_m = _in_metres(floor.outline, ros)
    farthest_m = max(abs(length_m) for corner in outline_m for length_m in corner)
    if farthest_m > FARTHEST_M:
        raise _too_far(farthest_m, ros).at(file.where(("resolution",)))
    if _is_too_small(floor, ros):
        raise _too_small(floor, ros).at(file.where(("resolution",)))
    notes = " ".join(_notes(ros, (free, unknown), picture, floor, tolerance_m))
    data: dict[str, Any] = {
        "schema_version": 1,
        "name": re.sub(r"\.(map|yaml|yml)", "", file.path.name) or file.path.name,
        "about": f"{told.about.strip()} {notes}".strip(),
        "rooms": {FLOOR: {"polygon_m": outline_m}},
        "holes_m": [_in_metres(hole, ros) for hole in floor.holes],
        **({} if places is None else {key: places.data[key] for key in BESIDE if key in places.data}),
    }
    return RosMap(
        path=file.path,
        name=file.name,
        data=data,
        lines=file.lines,
        text=file.text,
        spans=file.spans,
        places=places,
    )


def cells(picture: GreyPicture, ros: RosMapFile) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """The free cells, and those that are neither free nor occupied; the bottom row first.

    Args:
        picture: The picture that the map names.
        ros: Its thresholds and mode. `trinary` averages red, green, blue and opacity, as nav2's map server
            does, so that a translucent cell is darker; `scale` treats it as unknown; `raw` has the values of
            an occupancy grid, 0 to 100 %, above which cells are unknown.
    """
    grey, opaque = picture.grey, picture.opaque
    known = np.ones(grey.shape, dtype=bool)
    if ros.mode == "raw":
        occupied = grey * 255.0 / 100.0
        known = occupied <= 1.0
    else:
        shade = grey
        if ros.mode == "trinary" and picture.has_alpha:
            shade = (3.0 * grey + opaque) / 4.0
        occupied = shade if ros.negate else 1.0 - shade
        if ros.mode == "scale":
            known = opaque >= 1.0
    free = known & (occupied < ros.free_thresh)
    unknown = ~free & ~(known & (occupied > ros.occupied_thresh))
    return np.ascontiguousarray(free[::-1]), unknown[::-1]


def _under_furniture(
    furniture: Sequence[FurniturePiece], shape: tuple[int, int], ros: RosMapFile
) -> NDArray[np.bool_]:
    """The cells that pieces of furniture reach into, the bottom row first."""
    from shapely import Polygon, box, intersects

    under = np.zeros(shape, dtype=bool)
    x, y, yaw = ros.origin
    turn = np.array([[math.cos(yaw), -math.sin(yaw)], [math.sin(yaw), math.cos(yaw)]])
    for piece in furniture:
        corners = (np.array(furniture_of(piece).corners) - (x, y)) @ turn / ros.resolution
        left, bottom = np.floor(corners.min(axis=0)).astype(int).clip(0, shape[::-1])
        right, top = np.ceil(corners.max(axis=0)).astype(int).clip(0, shape[::-1])
        rows, columns = np.mgrid[bottom:top, left:right]
        # One that only touches a cell, such as a bench at a wall, does not reach into it.
        inner = Polygon(corners).buffer(-TOUCHING)
        under[rows, columns] |= intersects(inner, box(columns, rows, columns + 1, rows + 1))
    return under


@lru_cache(maxsize=KEPT)
def _floor(free: bytes, shape: tuple[int, int], tolerance: float) -> FloorOutline | None:
    return floor_of_cells(np.frombuffer(free, dtype=bool).reshape(shape), tolerance)


def _in_metres(corners: tuple[XY, ...], ros: RosMapFile) -> list[list[float]]:
    x, y, yaw = ros.origin
    at = np.array(corners) * ros.resolution
    turned = at @ np.array([[math.cos(yaw), math.sin(yaw)], [-math.sin(yaw), math.cos(yaw)]])
    return [[float(x + u), float(y + v)] for u, v in turned.round(MILLIMETRES)]


def _notes(
    ros: RosMapFile,
    found: tuple[NDArray[np.bool_], NDArray[np.bool_]],
    picture: GreyPicture,
    floor: FloorOutline,
    tolerance_m: float,
) -> Iterator[str]:
    """Notes on the conversion: size, origin, accuracy, and the shares that are unknown or dropped."""
    free, unknown = found
    rows, columns = free.shape
    x, y, yaw = ros.origin
    turned = f", turned by {math.degrees(yaw):.4g} degrees" if yaw else ""
    yield f"{columns} x {rows} cells of {ros.resolution:g} m, origin ({x:g}, {y:g}) m{turned}."
    yield f"Walls are exact to {tolerance_m:g} m."
    if unknown.any():
        yield f"Unknown cells, {_percent(unknown.mean())}, count as not free."
    doubtful = free[::-1] & np.isclose(picture.grey, USUALLY_UNKNOWN)
    if ros.mode != "raw" and doubtful.any():
        yield (
            f"{_percent(doubtful.mean())} of the cells are 205, which often means unknown: here free, by "
            f"free_thresh {ros.free_thresh:g}; 0.196 would keep them out."
        )
    if round(100 * (1 - floor.share)) > 0:
        yield f"{_percent(1 - floor.share)} of the free cells are left out: apart, or too narrow."


def _percent(share: float) -> str:
    return f"{100 * share:.0f} %" if share >= 0.005 else "less than 1 %"


def _noisy(limit: str, count: int) -> InputError:
    return InputError(
        expected=f"a picture whose {limit}",
        got=f"{count:,}, as in noise",
        remedy="Filter it, for example by a median of 3 x 3 cells.",
    )


def _too_far(farthest_m: float, ros: RosMapFile) -> InputError:
    x, y, _ = ros.origin
    return InputError(
        expected=f"a map whose x and y are at most {FARTHEST_M:g} m",
        got=f"{farthest_m:g} m, with cells of {ros.resolution:g} m and the origin ({x:g}, {y:g}) m",
        remedy="Check resolution, which is metres a cell, and origin.",
    )


def _is_too_small(floor: FloorOutline, ros: RosMapFile) -> bool:
    """Whether a small floor has no room for a robot."""
    from shapely import Polygon

    shape = Polygon(floor.outline, floor.holes)
    is_small = shape.area * ros.resolution**2 < SMALL_M2
    return is_small and shape.buffer(-WAY_M / 2 / ros.resolution).is_empty


def _too_small(floor: FloorOutline, ros: RosMapFile) -> InputError:
    xs, ys = zip(*floor.outline, strict=True)
    wide_m, high_m = ((max(each) - min(each)) * ros.resolution for each in (xs, ys))
    return InputError(
        expected=f"a floor with room for a robot {2 * ROBOT_RADIUS_M:g} m across",
        got=f"one of {wide_m:.3g} x {high_m:.3g} m, with cells of {ros.resolution:g} m",
        remedy="Check resolution, which is metres a cell.",
    )


def _no_floor(ros: RosMapFile) -> InputError:
    return InputError(
        expected=f"a picture with free cells: {'darker' if ros.negate else 'lighter'} than "
        f"free_thresh {ros.free_thresh:g}",
        got="none, or none that hang together",
        remedy="Check negate, free_thresh and mode.",
    )
