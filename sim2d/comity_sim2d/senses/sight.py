"""Which people the robot can see: within range and field of view, and not hidden by walls."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from comity_sim2d.pose import Pose, direction_to, wrap_angle
from comity_sim2d.scene.obstacles import FloorPlan
from comity_sim2d.scene.person import Person
from comity_sim2d.scene.robot_body import Sensor

PLAIN_M = 0.1
"""Margin by which a place must be inside the view to be in plain view [m], in addition to noise: people shift
their feet (our choice)."""
PLAIN_SIGMAS = 3.0
PLAIN_SHARE = 0.5
"""Central share of the field of view that is plain view however near a person is (our choice)."""

SPARE_M = 0.05
"""Reserve on plain view [m]: the robot stops slightly off its target (our choice)."""


def too_short_for(sensor: Sensor, apart_m: float) -> str | None:
    """Why a sensor might not show a person at a distance, in words; None if it would.

    Args:
        sensor: Its range and noise.
        apart_m: Distance from the robot's centre to the surface of the person's body [m].
    """
    needed_m = apart_m + SPARE_M + PLAIN_M + PLAIN_SIGMAS * sensor.sigma_m
    if needed_m <= sensor.range_m:
        return None
    return (
        f"not verified: the sensor sees {sensor.range_m:.2f} m far, and {needed_m:.2f} m are needed "
        "to be sure that the person is there"
    )


class Sight:
    """The sensor's view of a floor plan.

    Args:
        sensor: Its range and field of view.
        plan: The floor plan; its walls may hide people, furniture does not.
    """

    def __init__(self, sensor: Sensor, plan: FloorPlan) -> None:
        self._range_m = sensor.range_m
        self._half_rad = math.radians(sensor.field_of_view_deg) / 2
        self._hidden_by_walls = sensor.hidden_by_walls
        self.use_plan(plan)

    def use_plan(self, plan: FloorPlan) -> None:
        """Replace the floor plan."""
        self._walls = plan.view_blockers()

    def sees(self, robot: Pose, people: Sequence[Person]) -> list[bool]:
        """Whether each person is seen from a pose."""
        if not (self._hidden_by_walls and len(self._walls)):
            return [self._is_in_view(robot, person) for person in people]
        hidden = self._are_hidden(robot, people)
        return [
            self._is_in_view(robot, person) and not behind
            for person, behind in zip(people, hidden, strict=True)
        ]

    def is_plain(self, robot: Pose, person: Person, noise_m: float) -> bool:
        """Whether a person would certainly be seen from a pose, if at or next to their believed place.

        Args:
            robot: The pose.
            person: The person at their believed pose.
            noise_m: Standard deviation of that position per axis [m].
        """
        spare_m = PLAIN_M + PLAIN_SIGMAS * noise_m
        (x, y), apart = person.xy, math.dist(robot.xy, person.xy)
        if apart - person.radius_m > self._range_m - spare_m:
            return False
        way = direction_to(robot.xy, (x, y))
        if self._half_rad < math.pi:
            beside_rad = math.atan2(person.radius_m + spare_m, apart)
            spare_rad = min(beside_rad, (1.0 - PLAIN_SHARE) * self._half_rad)
            if abs(wrap_angle(way - robot.heading_rad)) > self._half_rad - spare_rad:
                return False
        if not (self._hidden_by_walls and len(self._walls)):
            return True
        half_m = person.radius_m / 2  # no more: a person beside a wall is not behind it
        dx, dy = -half_m * math.sin(way), half_m * math.cos(way)
        sides = [replace(person, x_m=x + share * dx, y_m=y + share * dy) for share in (-1.0, 0.0, 1.0)]
        return not any(self._are_hidden(robot, sides))

    def _is_in_view(self, robot: Pose, person: Person) -> bool:
        if math.dist(robot.xy, person.xy) - person.radius_m > self._range_m:
            return False
        if self._half_rad >= math.pi:
            return True
        return abs(wrap_angle(direction_to(robot.xy, person.xy) - robot.heading_rad)) <= self._half_rad

    def _are_hidden(self, robot: Pose, people: Sequence[Person]) -> list[bool]:
        """Whether the line to each person crosses a wall: its ends on two sides, and the other way round."""
        eye = np.array(robot.xy)
        one, other = self._walls[:, 0], self._walls[:, 1]
        at = np.array([person.xy for person in people]).reshape(-1, 1, 2)
        sides = _cross(at - eye, one - eye) * _cross(at - eye, other - eye) < 0.0
        across = _cross(other - one, eye - one) * _cross(other - one, at - one) < 0.0
        hidden: list[bool] = np.any(sides & across, axis=1).tolist()
        return hidden


def _cross(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    return np.asarray(one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0])
