"""Where the robot stands to pick something up: at a piece of furniture, or at a named location."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from comity_sim2d.kinds import require_kinds
from comity_sim2d.navigation.route_map import RouteMap
from comity_sim2d.pose import Pose, direction_to
from comity_sim2d.scene.obstacles import WALL_MARGIN_M
from comity_sim2d.scene_error import unknown

if TYPE_CHECKING:
    from collections.abc import Iterator

    from comity_sim2d.pose import XY
    from comity_sim2d.scene.room import Furniture
    from comity_sim2d.scene.scene import Scene

BESIDE_M = 0.05
"""Distance from a piece of furniture, in addition to the robot's margin [m] (our choice)."""
STEP_M = 0.25
"""Spacing of the candidate places around a piece of furniture [m]."""


def places(scene: Scene) -> tuple[str, ...]:
    """Where something can be picked up: names of the furniture and of the locations."""
    _require_scene(scene)
    furniture = (piece.name for piece in scene.furniture)
    return (*furniture, *(point.name for point in scene.locations))


def standing_place(scene: Scene, route_map: RouteMap, name: str) -> Pose | None:
    """The robot's pose at a place, facing it: the free one with the shortest path.

    Args:
        scene: The place, with the robot at its start.
        route_map: Its routes.
        name: One of `places`.

    Returns:
        None if no free pose is reachable.
    """
    _require_scene(scene)
    require_kinds("place", route_map=(route_map, RouteMap))
    if not isinstance(name, str) or name not in places(scene):
        raise unknown("name as one of the places of the scene", name, places(scene))
    start, poses = scene.robot.pose.xy, tuple(_poses(scene, name))
    free = [i for i, pose in enumerate(poses) if route_map.surroundings.blocker(pose.xy) is None]
    bounds = ((route_map.least_length(start, poses[i].xy), i) for i in free)
    nearest: tuple[float, int] | None = None
    for least_m, i in sorted((round(least_m, 6), i) for least_m, i in bounds if least_m is not None):
        if nearest is not None and least_m > nearest[0]:
            break  # no remaining pose has a shorter path
        if route_map.reaches(start, poses[i].xy):
            length_m = route_map.length(start, poses[i].xy)
            way = (math.inf if length_m is None else round(length_m, 6), i)
            nearest = way if nearest is None else min(nearest, way)
    return None if nearest is None else poses[nearest[1]]


def _require_scene(scene: Scene) -> None:
    from comity_sim2d.scene.scene import Scene

    require_kinds("place", scene=(scene, Scene))


def _poses(scene: Scene, name: str) -> Iterator[Pose]:
    for point in scene.locations:
        if point.name == name:
            heading_rad = point.heading_rad
            yield Pose(*point.xy, scene.robot.heading_rad if heading_rad is None else heading_rad)
    for piece in scene.furniture:
        if piece.name == name:
            yield from _around(piece, scene.robot.radius_m + WALL_MARGIN_M + BESIDE_M)


def _around(piece: Furniture, gap_m: float) -> Iterator[Pose]:
    """Poses around a piece of furniture, facing it."""
    from shapely import Point, Polygon
    from shapely.ops import nearest_points

    outline = Polygon(piece.corners)
    ring = outline.buffer(gap_m).exterior
    for k in range(math.ceil(ring.length / STEP_M)):
        at = ring.interpolate(k * STEP_M)
        near: Point = nearest_points(outline, at)[0]
        xy: XY = (at.x, at.y)
        yield Pose(*xy, direction_to(xy, (near.x, near.y)))
