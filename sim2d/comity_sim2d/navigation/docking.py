"""Docking poses: the place that a distance and a bearing define, and what obstructs the robot there."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple, Protocol, runtime_checkable

from comity_sim2d.kinds import TRUTH, require_kinds
from comity_sim2d.pose import XY, Pose, direction_to, wrap_angle
from comity_sim2d.scene.person import Person
from comity_sim2d.scene.scene import Scene
from comity_sim2d.scene.surroundings import Surroundings
from comity_sim2d.scene_error import FARTHEST_M, require_between, require_finite

BEARING_STEP_DEG = 5.0


@runtime_checkable
class PoseBeside(Protocol):
    """A pose relative to a person: all that a robot needs to go there."""

    @property
    def distance_m(self) -> float:
        """Gap between the nearest points of the two bodies [m]."""
        ...

    @property
    def bearing_deg(self) -> float:
        """Angle from the person's facing to the robot, positive to the left, in (-180, 180] [deg]."""
        ...


@dataclass(frozen=True, slots=True)
class DockingPose:
    """A pose chosen next to a person, relative to the person."""

    distance_m: float
    """Gap between the nearest points of the two bodies [m]."""
    bearing_deg: float
    """Angle from the person's facing to the robot, positive to the left, in (-180, 180] [deg]."""
    pose_free: bool = True
    """Whether it is the target pose."""
    deviation_reason: str | None = None
    """Why it is not the target pose; None if it is."""
    unverified: str | None = None
    """Why the robot might not see the person from there; None if it would."""

    def __post_init__(self) -> None:
        _require_beside(self.distance_m, self.bearing_deg)
        reason = (self.deviation_reason, str | None)
        unverified = (self.unverified, str | None)
        require_kinds(
            "docking pose",
            pose_free=(self.pose_free, TRUTH),
            deviation_reason=reason,
            unverified=unverified,
        )


def _require_beside(distance_m: float, bearing_deg: float) -> None:
    require_between("docking pose", "distance_m", distance_m, 0.0, FARTHEST_M)
    require_between("docking pose", "bearing_deg", bearing_deg, -360.0, 360.0)


class Docked(NamedTuple):
    """Pose of a robot relative to a person."""

    distance_m: float
    """Gap between the nearest points of the two bodies [m]; negative if they overlap."""
    centre_distance_m: float
    bearing_deg: float
    facing_error_deg: float
    """Angle between the robot's heading and the direction to the person, in [0, 180] [deg]."""


def pose_beside(person: Pose, reach_m: float, bearing_deg: float) -> Pose:
    """The pose at a centre distance and a bearing from a person, facing the person."""
    x, y = person.ahead(reach_m, math.radians(bearing_deg))
    return Pose(x, y, direction_to((x, y), person.xy))


def spot_beside(person: Person, robot_radius_m: float, pose: PoseBeside) -> XY:
    """Position of the robot's centre at a pose next to a person [m]."""
    reach_m = person.radius_m + pose.distance_m + robot_radius_m
    return person.pose.ahead(reach_m, math.radians(pose.bearing_deg))


def spots_beside(person: Person, robot_radius_m: float, beside: Iterable[tuple[float, float]]) -> list[XY]:
    """Positions of the robot's centre at given surface distances [m] and bearings [deg] from a person."""
    pose = person.pose
    return [
        pose.ahead(person.radius_m + distance_m + robot_radius_m, math.radians(bearing_deg))
        for distance_m, bearing_deg in beside
    ]


def spot_pose(scene: Scene | Surroundings, person: str, distance_m: float, bearing_deg: float) -> Pose:
    """The robot's pose for a surface distance and a bearing, facing the person; free or not.

    Raises:
        SceneError: For a distance or bearing that is invalid for a `DockingPose`.
        ValueError: If there is no such person.
    """
    _require_beside(distance_m, bearing_deg)
    place = _surroundings(scene)
    someone = place.person(person)
    return pose_beside(someone.pose, someone.radius_m + distance_m + place.robot_radius_m, bearing_deg)


def docked(robot: Pose, robot_radius_m: float, person: Person) -> Docked:
    """The distances and angles between a robot and a person."""
    try:
        here, there = robot.xy, person.xy
        centre = math.dist(here, there)
        return Docked(
            distance_m=centre - robot_radius_m - person.radius_m,
            centre_distance_m=centre,
            bearing_deg=math.degrees(wrap_angle(direction_to(there, here) - person.heading_rad)),
            facing_error_deg=abs(math.degrees(wrap_angle(direction_to(here, there) - robot.heading_rad))),
        )
    except (AttributeError, TypeError, ArithmeticError):  # called at every tick, so checked only on failure
        require_kinds("docked", robot=(robot, Pose), person=(person, Person))
        require_finite("docked", robot_radius_m=robot_radius_m)
        raise


def pose_blocker(
    scene: Scene | Surroundings, person: str, distance_m: float, bearing_deg: float
) -> str | None:
    """What blocks a docking pose, in words; None if it is free.

    A pose is free if the robot's disc is inside the room, clear of walls, furniture and other people by their
    margins, and no wall is between it and the person.
    """
    place = _surroundings(scene)
    xy = spot_pose(place, person, distance_m, bearing_deg).xy
    return place.blocker(xy, visited=person) or place.plan.wall_between(place.person(person).pose.xy, xy)


def free_bearing(
    scene: Scene | Surroundings,
    person: str,
    distance_m: float,
    nominal_deg: float,
    *,
    low_deg: float,
    high_deg: float,
) -> float | None:
    """The free bearing nearest to the nominal one in [low, high], in steps of 5 deg; None: all are blocked.

    It equals `nominal_deg` exactly where that pose is free itself.
    """
    bearings = {"nominal_deg": nominal_deg, "low_deg": low_deg, "high_deg": high_deg}
    for field, value in bearings.items():
        require_between("free bearing", field, value, -360.0, 360.0)
    place = _surroundings(scene)
    place.person(person)
    _require_beside(distance_m, nominal_deg)
    steps = math.ceil((high_deg - low_deg) / BEARING_STEP_DEG)
    offsets = [sign * k * BEARING_STEP_DEG for k in range(steps + 1) for sign in (1, -1)]
    for bearing in (nominal_deg + offset for offset in offsets):
        if low_deg <= bearing <= high_deg and pose_blocker(place, person, distance_m, bearing) is None:
            return bearing
    return None


def _surroundings(scene: Scene | Surroundings) -> Surroundings:
    require_kinds("place", scene=(scene, Scene | Surroundings))
    return Surroundings.of(scene) if isinstance(scene, Scene) else scene
