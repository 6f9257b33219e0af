"""ROS maps as files: a `map.yaml` that names a picture, and the file of named places beside it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, model_validator

from comity_fis.errors import InputError, Location, Where, WrongValueError
from comity_fis.validation.yaml_file import YamlFile, read_yaml
from comity_sim2d.maps.file import MAX_LOCATIONS, FurniturePiece, Metres, Name, NamedPoint, Number
from comity_sim2d.scene.scene_check import MAX_OBSTACLES

PLACES_SUFFIX = ".places.yaml"
"""Suffix of the file of named places: `map.places.yaml` is next to `map.yaml`."""
PICTURE_SUFFIXES = {".pgm", ".png"}

Share = Annotated[Number, Field(ge=0, le=1)]


class RosMapFile(BaseModel):
    """The model of a ROS `map.yaml`."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, title="ROS map")

    image: str = Field(min_length=1, description="A PGM or PNG file, from the folder of this one.")
    resolution: Number = Field(gt=0, le=100, description="Of a cell [m].")
    origin: tuple[Metres, Metres, Number] = Field(
        description="x, y [m] and yaw [rad] of the lower left corner of the lower left cell."
    )
    negate: bool | Literal[0, 1] = Field(description="Whether black is free instead of white.")
    occupied_thresh: Share = Field(description="Darker than this is occupied.")
    free_thresh: Share = Field(description="Lighter than this is free.")
    mode: Literal["trinary", "scale", "raw"] = "trinary"

    @model_validator(mode="after")
    def _free_below_occupied(self) -> RosMapFile:
        if self.free_thresh > self.occupied_thresh:
            raise WrongValueError(
                expected="free_thresh at most occupied_thresh",
                got=f"{self.free_thresh:g} and {self.occupied_thresh:g}",
                remedy="Most maps have 0.25 and 0.65.",
            )
        return self


ROS_KEYS = RosMapFile.model_fields.keys()


class PlacesFile(BaseModel):
    """The model of the file that names the places and the furniture of a ROS map."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, title="Places of a ROS map")

    schema_version: Literal[1]
    about: str = ""
    tolerance_m: Annotated[Number, Field(gt=0, le=1)] | None = Field(
        default=None, description="By how much walls may be simplified; one cell without it."
    )
    locations: Mapping[Name, NamedPoint] = Field(default_factory=dict, max_length=MAX_LOCATIONS)
    furniture: tuple[FurniturePiece, ...] = Field(
        default=(),
        max_length=MAX_OBSTACLES,
        description="Its cells, whatever the picture says of them, are floor with this piece on it, which a "
        "seated person may be on.",
    )


@dataclass(frozen=True, slots=True, eq=False)
class RosMap(YamlFile):
    """A ROS map converted to our format; errors name the lines of its own two files."""

    places: YamlFile | None = None

    def where(self, location: Location) -> Where:
        """Position of a value, or of the nearest enclosing element that is in one of the files."""
        if location[:1] in (("locations",), ("furniture",)) and self.places is not None:
            return self.places.where(location)
        return YamlFile.where(self, location)


def is_ros_map(data: object) -> bool:
    """Whether YAML data are a ROS map, even an incomplete one, and not a map or scenario of ours."""
    return isinstance(data, Mapping) and "schema_version" not in data and bool(ROS_KEYS & data.keys())


def refuse_picture(path: Path) -> None:
    """Refuse the picture of a ROS map where the map is wanted, and name the map if it is beside the picture.

    Raises:
        InputError: If the path is a PGM or PNG file.
    """
    if path.suffix.lower() not in PICTURE_SUFFIXES or not path.is_file():
        return
    maps = (one for one in sorted(path.parent.iterdir()) if one.suffix in {".yaml", ".yml"})
    its_map = next((one for one in maps if _shows(one, path)), None)
    raise InputError(
        expected="the map.yaml of a ROS map",
        got=f"the picture {path.name}, which does not say how large a cell is",
        remedy=f"Name {its_map}, which has it as its image."
        if its_map
        else f"Name the map.yaml whose `image` is {path.name}; there is none beside it.",
        where=Where(str(path)),
    )


def _shows(path: Path, picture: Path) -> bool:
    """Whether a file is a ROS map with this picture."""
    try:
        data = read_yaml(path).data
    except InputError:
        return False
    return is_ros_map(data) and path.parent / str(data.get("image")) == picture


def places_beside(path: Path) -> Path:
    """The file that names the places of a ROS map."""
    return path.with_suffix(PLACES_SUFFIX)
