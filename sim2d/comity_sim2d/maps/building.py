"""Builds a map from its file, and reports the file's line in every error."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache
from typing import TYPE_CHECKING, Protocol

from comity_sim2d.maps.check import check_map, check_parts
from comity_sim2d.maps.door_gaps import WantedDoor, cut_doors, swinging_inwards
from comity_sim2d.maps.place_map import PlaceMap
from comity_sim2d.maps.rooms import floor_of, walls_between
from comity_sim2d.scene.area import Area, Location
from comity_sim2d.scene.room import Furniture, Wall
from comity_sim2d.scene.scene_check import check_count
from comity_sim2d.scene_error import SceneError

if TYPE_CHECKING:
    from comity_fis.errors import Where
    from comity_sim2d.maps.file import FurniturePiece, MapFile, Outline
    from comity_sim2d.pose import XY

KEPT = 16
"""Number of maps cached: many scenarios share one place, and each requests its map more than once."""


class FileLines(Protocol):
    """Finds the file position of a value."""

    def __call__(self, *location: str | int) -> Where:
        """Position of a value."""
        ...


def build_map(written: MapFile, where: FileLines) -> PlaceMap:
    """The map that a file describes.

    Args:
        written: The file's content.
        where: Finds the position of a value in it.

    Raises:
        SceneError: For the first invalid value, naming its line.
    """
    try:
        return _map_of(written.model_dump_json(exclude_none=True))
    except SceneError as error:
        raise error.at(where(*_location(error.entity, written))) from None


@lru_cache(maxsize=KEPT)
def _map_of(content: str) -> PlaceMap:
    """The map for a map's JSON; maps are immutable, so the same text gives the same object."""
    from comity_sim2d.maps.file import MapFile

    return _built(MapFile.model_validate_json(content))


def _built(written: MapFile) -> PlaceMap:
    areas = tuple(Area(name, corners_of(outline)) for name, outline in written.rooms.items())
    furniture = tuple(furniture_of(piece) for piece in written.furniture)
    inner = tuple(
        Wall(*wall.line_m, wall.thickness_m, wall.name or f"wall {i}")
        for i, wall in enumerate(written.walls, 1)
    )
    check_parts(areas, furniture, written.holes_m, len(inner) + len(written.doors))
    room = floor_of(areas, written.holes_m)
    wanted = [
        WantedDoor(name, door.at_m, door.width_m, door.open, door.kind)
        for name, door in written.doors.items()
    ]
    walls, doors = cut_doors((*inner, *walls_between(areas, room)), wanted, room)
    check_count(len(walls) + len(doors) + len(furniture))  # including the pieces of walls between rooms
    place = PlaceMap(
        name=written.name,
        room=room,
        areas=areas,
        walls=walls,
        doors=swinging_inwards(doors, areas),
        furniture=furniture,
        locations=tuple(
            Location(name, *point.at_m, None if point.facing_deg is None else math.radians(point.facing_deg))
            for name, point in written.locations.items()
        ),
        about=written.about,
    )
    check_map(place)
    return place


def corners_of(outline: Outline) -> tuple[XY, ...]:
    """The corners of a box or a polygon, in order."""
    if outline.polygon_m is not None:
        return outline.polygon_m
    assert outline.box_m is not None  # the model accepts exactly one shape
    x, y, width, height = outline.box_m
    return ((x, y), (x + width, y), (x + width, y + height), (x, y + height))


def furniture_of(piece: FurniturePiece) -> Furniture:
    """A piece of furniture in the shape given in the file.

    Raises:
        SceneError: If it reaches too far out.
    """
    if piece.circle_m is not None:
        x, y, radius = piece.circle_m
        return Furniture.circle(piece.name, x, y, radius_m=radius)
    if not piece.angle_deg:
        return Furniture(piece.name, corners_of(piece))
    assert piece.box_m is not None  # the model allows only boxes to be rotated
    x, y, width, height = piece.box_m
    return Furniture.box(
        piece.name,
        x + width / 2,
        y + height / 2,
        width_m=width,
        depth_m=height,
        angle_rad=math.radians(piece.angle_deg),
    )


def _location(entity: str, written: MapFile) -> Sequence[str | int]:
    """File location of the entity that an error is about."""
    known: dict[str, tuple[str | int, ...]] = {"scene": ("furniture",) if written.furniture else ("rooms",)}
    known |= {f"room {name}": ("rooms", name) for name in written.rooms}
    known |= {f"door {name}": ("doors", name) for name in written.doors}
    known |= {f"location {name}": ("locations", name) for name in written.locations}
    known |= {f"hole {i + 1}": ("holes_m", i) for i in range(len(written.holes_m))}
    known |= {wall.name or f"wall {i}": ("walls", i - 1) for i, wall in enumerate(written.walls, 1)}
    known |= {piece.name: ("furniture", i) for i, piece in enumerate(written.furniture)}
    return known.get(entity, ("rooms",))
