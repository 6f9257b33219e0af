"""The robot at its start: its body, the limits of its motion, and its sensor."""

from __future__ import annotations

from dataclasses import dataclass, field

from comity_fis.proxemics import PERSON_MARGIN_M
from comity_sim2d.kinds import TRUTH, require_kinds
from comity_sim2d.pose import Pose
from comity_sim2d.scene_error import (
    FARTHEST_M,
    SceneError,
    require_between,
    require_finite,
    require_one_of,
    require_text,
)

DRIVES = ("omnidirectional", "differential")
ROBOT_RADIUS_M = 0.25
"""Default radius of the disc [m]: a robot like Pepper, 0.48 m across."""
SIGHT_M = 0.50
"""Minimum range of sight from its body [m]: conversational distance (our choice)."""


@dataclass(frozen=True, slots=True)
class Sensor:
    """Errors of the robot's measurement of people's positions; by default there are none."""

    sigma_m: float = 0.0
    """Standard deviation of Gaussian noise on each coordinate of a person's position [m]."""
    delay_s: float = 0.0
    """Delay of measurements [s]."""
    range_m: float = FARTHEST_M
    """Maximum distance from the robot's centre to the body of a person it sees [m]."""
    field_of_view_deg: float = 360.0
    """Field of view, centred on the robot's heading [deg]."""
    hidden_by_walls: bool = False
    """Whether walls hide people."""

    def __post_init__(self) -> None:
        require_between("sensor", "sigma_m", self.sigma_m, 0.0, 1.0)
        require_between("sensor", "delay_s", self.delay_s, 0.0, 2.0)
        require_between("sensor", "range_m", self.range_m, 0.1, FARTHEST_M)
        require_between("sensor", "field_of_view_deg", self.field_of_view_deg, 5.0, 360.0)
        require_kinds("sensor", hidden_by_walls=(self.hidden_by_walls, TRUTH))


@dataclass(frozen=True, slots=True)
class RobotBody:
    """The robot at its start: a disc with one kind of drive and its limits."""

    x_m: float
    y_m: float
    heading_rad: float = 0.0
    name: str = "robot"
    radius_m: float = ROBOT_RADIUS_M
    max_speed_m_s: float = 0.7
    max_acceleration_m_s2: float = 0.5
    """Limit of the acceleration in every direction, braking and turning included [m/s^2]."""
    max_jerk_m_s3: float = 20.0
    """Limit of the jerk [m/s^3]; at 20 Hz and 0.5 m/s^2 the commands alone keep the default.

    If it is below `max_acceleration_m_s2` per second, the robot accelerates less than its limit: by this jerk
    times 1 s.
    """
    emergency_deceleration_m_s2: float = 2.0
    """Deceleration while its emergency stop is pressed, whatever the jerk [m/s^2].

    Our choice, below the value at which a body tips whose centre of mass is 0.6 m above wheels that reach
    0.15 m out (9.81 * 0.15 / 0.6 = 2.5). It never brakes more softly than `max_acceleration_m_s2`.
    """
    drive: str = "omnidirectional"
    """One of `DRIVES`."""
    sensor: Sensor = field(default_factory=Sensor)
    margin_m: float = PERSON_MARGIN_M
    """Clearance only from people who stepped aside or agreed, between surfaces [m]."""

    def __post_init__(self) -> None:
        require_text("robot", "name", self.name)
        require_finite(self.name, x_m=self.x_m, y_m=self.y_m, heading_rad=self.heading_rad)
        require_between(self.name, "radius_m", self.radius_m, 0.05, 2.0)
        require_between(self.name, "max_speed_m_s", self.max_speed_m_s, 0.01, 3.0)
        require_between(self.name, "max_acceleration_m_s2", self.max_acceleration_m_s2, 0.05, 10.0)
        require_between(self.name, "max_jerk_m_s3", self.max_jerk_m_s3, 0.1, 1000.0)
        hardest = ("emergency_deceleration_m_s2", self.emergency_deceleration_m_s2)
        require_between(self.name, *hardest, 0.05, 100.0)
        require_one_of(self.name, "drive", self.drive, DRIVES)
        require_kinds(self.name, sensor=(self.sensor, Sensor))
        require_between(self.name, "margin_m", self.margin_m, 0.0, PERSON_MARGIN_M)
        if self.sensor.range_m < self.radius_m + SIGHT_M:
            raise SceneError(
                entity="sensor",
                field="range_m",
                expected=f"at least {self.radius_m + SIGHT_M:g} m, which is {SIGHT_M:g} m more than the "
                "robot's radius: it counts from the robot's centre",
                got=f"{self.sensor.range_m:g}",
                remedy="Let it see farther.",
            )

    @property
    def pose(self) -> Pose:
        """Initial pose of the robot."""
        return Pose(self.x_m, self.y_m, self.heading_rad)
