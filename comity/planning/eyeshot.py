"""Whether the robot surely sees somebody from where they want it: whom it does not see it cannot greet."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from comity_sim2d.senses.sight import PLAIN_M, PLAIN_SIGMAS

if TYPE_CHECKING:
    from comity_sim2d import Scene

SPARE_M = 0.05
"""So much more than plain view takes: it stops a little beside its mark (our choice)."""


def beyond_sight(scene: Scene, person: str, distance_m: float) -> str | None:
    """Why the robot would not see somebody from there; None where it would.

    Args:
        scene: With the robot and its sensor.
        person: Whom it visits.
        distance_m: How far from them it is to stand; between the surfaces [m].
    """
    sensor = scene.robot.sensor
    if needed_range_m(scene, distance_m) <= sensor.range_m:
        return None
    return (
        f"the robot would not surely see {person} from where they want it, {distance_m:.2f} m away: "
        f"its sensor sees {sensor.range_m:.2f} m far from its middle"
    )


def needed_range_m(scene: Scene, distance_m: float) -> float:
    """How far its sensor has to see, from the robot's centre: it is to notice also that somebody has gone."""
    robot = scene.robot
    return robot.radius_m + distance_m + SPARE_M + PLAIN_M + PLAIN_SIGMAS * robot.sensor.sigma_m


def seeing_far_enough(scene: Scene, distance_m: float) -> Scene:
    """The same with a sensor that sees as far as that takes."""
    farther = replace(scene.robot.sensor, range_m=needed_range_m(scene, distance_m))
    return replace(scene, robot=replace(scene.robot, sensor=farther))
