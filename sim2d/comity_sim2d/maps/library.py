"""Maps by name: the shipped ones, and those in files."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from comity_fis.errors import InputError, closest
from comity_fis.validation.name_or_path import looks_like_a_file
from comity_sim2d.scene_error import shown

if TYPE_CHECKING:
    from comity_fis.validation.yaml_file import YamlFile
    from comity_sim2d.maps.place_map import PlaceMap

SUFFIX = ".map.yaml"
_SHIPPED = Path(__file__).parent


def shipped_maps() -> Mapping[str, Path]:
    """The files of the shipped maps, by name, in alphabetical order."""
    return {path.name.removesuffix(SUFFIX): path for path in sorted(_SHIPPED.glob(f"*{SUFFIX}"))}


def load_map(name: str | Path) -> PlaceMap:
    """A shipped map by name, or one from a file.

    Raises:
        InputError: If there is none, or the file holds no valid map.
    """
    from comity_sim2d.maps.building import build_map
    from comity_sim2d.maps.file import MapFile

    file = read_map(name)
    return build_map(file.check(MapFile), lambda *location: file.where(location))


def read_map(name: str | Path, *, beside: Path | None = None) -> YamlFile:
    """The YAML of a map, not yet checked; a ROS map is converted to our format.

    Args:
        name: A shipped name, or a path.
        beside: Folder that relative paths start from; None: the current one.

    Raises:
        InputError: If there is none, the file holds no YAML, or a ROS map cannot be used.
    """
    from comity_fis.validation.yaml_file import read_yaml

    if not isinstance(name, str | Path):
        raise InputError(
            expected="a map's name or a path",
            got=shown(name),
            remedy="Name a shipped map, such as 'apartment', or a file.",
        )
    known = shipped_maps()
    if name in known:
        return read_yaml(known[str(name)], str(name))
    path = Path(name) if beside is None else beside / name
    if looks_like_a_file(str(name), path):
        from comity_sim2d.maps.ros_import import converted
        from comity_sim2d.maps.ros_map import is_ros_map, refuse_picture

        refuse_picture(path)
        file = read_yaml(path)
        return converted(file) if is_ros_map(file.data) else file
    raise InputError(
        expected="a shipped map or a file",
        got=repr(str(name)),
        remedy=f"{closest(str(name), known)} `comity maps` lists them.",
    )
