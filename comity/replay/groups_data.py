"""O-spaces of groups over time, as in pictures and animations."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from comity_sim2d.pictures.drawing import o_spaces_at

if TYPE_CHECKING:
    from comity_sim2d import Frames, OSpace, Scene


def groups_data(scene: Scene, frames: Frames) -> list[dict[str, object]]:
    """O-spaces by start time [s]: centre [m], radius [m] and members of each.

    A space keeps its group's position until a person leaves the group, or comes back.
    """
    return [{"t": t, "spaces": [_space(space) for space in spaces]} for t, spaces in _turns(scene, frames)]


def _turns(scene: Scene, frames: Frames) -> Iterator[tuple[float, tuple[OSpace, ...]]]:
    members = sorted({name for group in scene.groups for name in group.members} & set(frames.entities))
    if not members or not len(frames):
        return
    at = np.stack([frames.of(name)[:, :2] for name in members], axis=1)
    moved = np.append(True, (np.diff(at, axis=0) != 0.0).any(axis=(1, 2)))
    before: tuple[OSpace, ...] = ()
    for t in frames.time_s[moved].tolist():
        spaces = o_spaces_at(scene, frames, t)
        if spaces != before:
            yield t, spaces
            before = spaces


def _space(space: OSpace) -> dict[str, object]:
    return {
        "x": round(space.x_m, 3),
        "y": round(space.y_m, 3),
        "radius": round(space.radius_m, 3),
        "members": space.members,
    }
