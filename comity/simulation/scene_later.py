"""The scene at a given time of an episode."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from comity_sim2d.pictures.drawing import pose_at
from comity_sim2d.pictures.turning_doors import doors_at

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from comity_sim2d import DoorTurn, Frames, Scene


def scene_at(
    scene: Scene,
    frames: Frames,
    t: float,
    *,
    turns: Sequence[DoorTurn] = (),
    own_m: Mapping[str, float | None] | None = None,
) -> Scene:
    """The scene at a time, with robot and people standing at their positions, and doors in their states.

    Args:
        scene: The initial scene.
        frames: The recorded poses.
        t: The time [s].
        turns: Door movements.
        own_m: Preferred distance of each person at that time [m], by name; None: as at the start.
    """
    robot = pose_at(frames, scene.robot.name, t)
    poses = {person.name: pose_at(frames, person.name, t) for person in scene.people}
    likes = {person.name: person.personal_distance_m for person in scene.people} | dict(own_m or {})
    return replace(
        scene,
        robot=replace(scene.robot, x_m=robot.x_m, y_m=robot.y_m, heading_rad=robot.heading_rad),
        people=tuple(
            replace(
                person,
                x_m=poses[person.name].x_m,
                y_m=poses[person.name].y_m,
                heading_rad=poses[person.name].heading_rad,
                walk=None,
                personal_distance_m=likes[person.name],
            )
            for person in scene.people
        ),
        doors=doors_at(scene.doors, turns, t),
    )
