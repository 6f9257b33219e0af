"""The place of a scenario, as a map; every error names its line."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.scenario import MapPlace
from comity.system.library import require_file
from comity_fis import InputError
from comity_fis.validation.name_or_path import looks_like_a_file
from comity_sim2d import Area, Furniture, PlaceMap, Room, SceneError, Wall
from comity_sim2d.maps.building import build_map, furniture_of
from comity_sim2d.maps.file import FurniturePiece, MapFile, WallLine
from comity_sim2d.maps.library import read_map, shipped_maps

if TYPE_CHECKING:
    from comity.scenario import Place, ScenarioFile
    from comity_fis.validation.yaml_file import YamlFile

ROOM = "room"
"""Name of the only room of a place without a map."""


def map_of(file: ScenarioFile) -> PlaceMap:
    """The map of a scenario, with doors in the scenario's states.

    Raises:
        InputError: if the map cannot be used; a place without a map is checked together with its people.
    """
    place = file.scenario.place
    if not isinstance(place, MapPlace):
        return _one_room(place, file)
    if isinstance(place.map, MapFile):
        drawn = build_map(place.map, lambda *location: file.where("place", "map", *location))
    else:
        found, model = written_map(file, place.map)
        drawn = build_map(model, lambda *location: found.where(location))
    for name, state in place.doors.items():
        try:
            drawn = drawn.with_doors({name: state == "open"})
        except SceneError as error:
            raise error.at(file.where("place", "doors", name)) from None
    return drawn


def written_map(file: ScenarioFile, name: str) -> tuple[YamlFile, MapFile]:
    """The map named by a scenario: a shipped one, or a file next to it.

    Raises:
        InputError: if it does not exist, or is no map.
    """
    where, path = file.where("place", "map"), file.folder / name
    if name not in shipped_maps() and looks_like_a_file(name, path):
        require_file("map", path, name, where)
    try:
        found = read_map(name, beside=file.folder)
    except InputError as error:
        raise error.at(where) from None
    return found, found.check(MapFile)


def _one_room(place: Place, file: ScenarioFile) -> PlaceMap:
    try:
        room = Room.rectangle(place.width_m, place.height_m)
    except SceneError as error:
        raise error.at(file.where("place", error.field or "width_m")) from None
    return PlaceMap(
        name=ROOM,
        room=room,
        areas=(Area(ROOM, room.corners),),
        walls=tuple(_wall(line, file, i) for i, line in enumerate(place.walls_m)),
        furniture=tuple(_furniture(item, file, i) for i, item in enumerate(place.furniture)),
    )


def _wall(line: WallLine, file: ScenarioFile, number: int) -> Wall:
    try:
        return Wall(*line)
    except SceneError as error:
        raise error.at(file.where("place", "walls_m", number)) from None


def _furniture(item: FurniturePiece, file: ScenarioFile, number: int) -> Furniture:
    try:
        return furniture_of(item)
    except SceneError as error:
        raise error.at(file.where("place", "furniture", number)) from None
