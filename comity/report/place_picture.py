"""The picture of a map, or of a scenario before execution."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from comity_fis import InputError, closest
from comity_fis.validation.complaint import counted
from comity_fis.validation.yaml_file import read_yaml
from comity_sim2d import load_map, shipped_maps
from comity_sim2d.maps.library import SUFFIX
from comity_sim2d.maps.ros_export import PGM_MARK, YAML_MARK, ros_map_files
from comity_sim2d.maps.ros_map import PICTURE_SUFFIXES, is_ros_map
from comity_sim2d.pictures.map_picture import draw_map
from comity_sim2d.pictures.topology_picture import draw_topology

if TYPE_CHECKING:
    from comity.scenario import ScenarioFile
    from comity_sim2d import PlaceMap, Scene

ROS_MARKS = {".yaml": YAML_MARK, ".pgm": PGM_MARK}
"""Marker near the start of our ROS map files, by suffix."""


@dataclass(frozen=True, slots=True)
class Drawing:
    """Something that can be drawn."""

    name: str
    kind: Literal["map", "scenario"]
    about: str
    place: PlaceMap | Scene
    rings_m: Mapping[str, float]
    """Preferred distance of each person [m], by name."""
    seed: int = 0
    """Seed of the passers-by."""

    @property
    def slug(self) -> str:
        """File name without suffix."""
        return re.sub(r"[^\w.-]+", "-", self.name).strip("-.") or self.kind

    def picture(self, form: str) -> bytes:
        """The picture as PNG, SVG or PDF bytes."""
        return draw_map(
            self.place,
            title=self.name,
            subtitle=" ".join((self.about.strip(), self._counts())),
            rings=self.rings_m,
            seed=self.seed,
            format=form,
        )

    def _counts(self) -> str:
        """Number of rooms, doors and so on of a map; empty for a scenario, which shows people."""
        if self.kind == "scenario":
            return ""
        place = self.place
        parts = [
            (len(place.areas), "room", None),
            (len(place.room.holes), "hole", None),
            (len(place.doors), "door", None),
            (len(place.furniture), "piece of furniture", "pieces of furniture"),
            (len(place.locations), "named place", None),
        ]
        return f"{', '.join(counted(*part) for part in parts if part[0])}."

    def ros_map(self) -> dict[str, bytes]:
        """Files of a ROS map, by name."""
        return ros_map_files(self.place, self.slug)

    def graph(self, form: str) -> bytes:
        """Picture of its topology (rooms, named places and doors) as a graph."""
        return draw_topology(self.place, title=self.name, form=form)


def drawing_of(name: str, seed: int) -> Drawing:
    """A map or a scenario, shipped or from a file.

    Args:
        name: Path of a map (`.map.yaml`, or a ROS map), else a scenario.
        seed: Seed of random places.

    Raises:
        InputError: if it is neither, or invalid.
    """
    is_picture = Path(name).suffix.lower() in PICTURE_SUFFIXES
    if name in shipped_maps() or name.endswith(SUFFIX) or is_picture or _is_ros_map(Path(name)):
        drawn = load_map(name)
        return Drawing(drawn.name, "map", drawn.about, drawn, {})
    return _scenario(name, seed)


def _is_ros_map(path: Path) -> bool:
    return path.suffix in {".yaml", ".yml"} and path.exists() and is_ros_map(read_yaml(path).data)


def _scenario(name: str, seed: int) -> Drawing:
    from comity.preparation import resolved
    from comity.scenario import load_scenario
    from comity.system.library import shipped
    from comity.system.scenario_sets import instead
    from comity_fis.validation.name_or_path import looks_like_a_file

    known = name in shipped("scenario") or instead(name)
    if not known and not looks_like_a_file(name, Path(name)):
        raise InputError(
            expected="a shipped map or scenario, or a file",
            got=repr(name),
            remedy=f"{closest(name, [*shipped_maps(), *shipped('scenario')])} "
            "`comity maps` and `comity scenarios` list them.",
        )
    stage = resolved(load_scenario(name), seed=seed)
    scenario = stage.file.scenario
    rings = {person: value["conversational_distance"].number for person, value in stage.values.items()}
    about = " ".join(f"{scenario.about} {_about_its_map(stage.file)}".split())
    return Drawing(scenario.name, "scenario", about, stage.scene, rings, seed)


def _about_its_map(file: ScenarioFile) -> str:
    """What the map of a scenario says of itself, a ROS map how it was understood; empty without a map."""
    from comity.scenario import MapPlace
    from comity.simulation.place import map_of

    if not isinstance(file.scenario.place, MapPlace):
        return ""
    place = map_of(file)
    return f"Map {place.name}: {place.about}"
