"""The place from above: rooms, walls, furniture, and every door in its open and closed state."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from comity_sim2d.pictures.door_drawing import leaf, swing

if TYPE_CHECKING:
    from comity_sim2d import Door, Scene


def place_data(scene: Scene) -> dict[str, object]:
    """Corners and lines [m]; areas only if there are several."""
    return {
        "room": scene.room.corners,
        "holes": scene.room.holes,
        "doors": [_door(door) for door in scene.doors],
        "areas": [[area.name, area.corners] for area in scene.areas] if len(scene.areas) > 1 else [],
        "walls": [[*wall.start, *wall.end, wall.thickness_m] for wall in scene.walls],
        "furniture": [[piece.name, piece.corners] for piece in scene.furniture],
    }


def _door(door: Door) -> dict[str, object]:
    if door.kind == "opening":
        return {"name": door.name, "kind": door.kind, "open": True, "line": [door.start, door.end]}
    shut, opened = replace(door, is_open=False), replace(door, is_open=True)
    return {
        "name": door.name,
        "kind": door.kind,
        "open": door.is_open,
        "shut_leaf": leaf(shut),
        "open_leaf": leaf(opened),
        "swing": swing(opened),
    }
