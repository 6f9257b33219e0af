"""Bands around a docking pose: tight to enter, loose to leave (hysteresis).

The robot's stated tolerance widens them only outwards: too near is worse than too far. Due to the hysteresis
a docked robot stays docked while the person shuffles or the sensor is noisy.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import inf

from comity_executor.nodes.cause import Account
from comity_executor.nodes.limits import Limits
from comity_executor.robots.bearing import bearing_error_deg
from comity_executor.robots.goals import RelativePose
from comity_executor.robots.robot import Reading, is_seen

MOST_DIGITS = 9
"""What differs by less reads as equal."""
TINY = 1e-9
"""Floating-point error of a difference of rounded angles [deg]."""


@dataclass(frozen=True, slots=True)
class DockingBand:
    """Limits within which a reading counts as standing at a pose."""

    pose: RelativePose
    verb: str
    """How a reading outside the band is described: it `left` it, or `is not in` it."""
    nearest_m: float
    farthest_m: float
    bearing_deg: float
    """Allowed deviation from the pose's bearing to either side [deg]."""
    facing_deg: float
    speed_m_s: float

    def contains_place(self, reading: Reading) -> bool:
        """Whether the robot stands there, whatever its heading."""
        return (
            self.nearest_m <= reading.distance_m <= self.farthest_m
            and bearing_error_deg(reading.bearing_deg, self.pose.bearing_deg) <= self.bearing_deg
            and reading.speed_m_s < self.speed_m_s
        )

    def contains(self, reading: Reading) -> bool:
        """Whether the robot stands there and faces the person."""
        return self.contains_place(reading) and reading.facing_error_deg <= self.facing_deg

    def account(self, reading: Reading) -> Account:
        """The first quantity outside the band; the distance and the angles if all are inside."""
        return self._outside(reading) or _inside(reading)

    def _outside(self, reading: Reading) -> Account | None:
        """The first quantity outside the band, with the digits that it takes to read so; None if none is."""
        distance, bearing, wanted = reading.distance_m, reading.bearing_deg, self.pose
        near, far = self.nearest_m, self.farthest_m
        if not near <= distance <= far:
            n = _digits(2, lambda n: not round(near, n) <= round(distance, n) <= round(far, n))
            band = f"{near:.{n}f}..{far:.{n}f} around {wanted.distance_m:.{n}f}"
            text = f"distance {distance:.{n}f} m {self.verb} {band}"
            return Account(text, distance, "conversational_distance")
        if bearing_error_deg(bearing, at := wanted.bearing_deg) > self.bearing_deg:
            least = self.bearing_deg + TINY
            n = _digits(1, lambda n: bearing_error_deg(round(bearing, n), round(at, n)) > least)
            text = f"bearing {bearing:z.{n}f} deg {self.verb} ±{self.bearing_deg:g} around {at:z.{n}f}"
            return Account(text, bearing, "approach_direction")
        if (error := reading.facing_error_deg) > self.facing_deg:
            n = _digits(1, lambda n: round(error, n) > self.facing_deg)
            return Account(f"facing error {error:.{n}f} deg is above {self.facing_deg:g}", error)
        if not (speed := reading.speed_m_s) < self.speed_m_s:
            n = _digits(2, lambda n: round(speed, n) >= self.speed_m_s)
            return Account(f"speed {speed:.{n}f} m/s is not below {self.speed_m_s:g}", speed)
        return None


def _inside(reading: Reading) -> Account:
    presumed = "" if is_seen(reading) else ", not verified: from where they were last seen"
    angles = f"bearing {reading.bearing_deg:z.1f} deg, facing error {reading.facing_error_deg:.1f} deg"
    text = f"distance {reading.distance_m:.2f} m, {angles}{presumed}"
    return Account(text, reading.distance_m, "conversational_distance")


def _digits(least: int, is_outside: Callable[[int], bool]) -> int:
    """The fewest digits with which a quantity that is outside reads so.

    Args:
        least: Digits where that suffices.
        is_outside: Whether it is, with everything rounded to so many.
    """
    return next(filter(is_outside, range(least, MOST_DIGITS)), MOST_DIGITS)


def enter_band(pose: RelativePose, limits: Limits) -> DockingBand:
    """The band for having come to rest at the pose."""
    return DockingBand(
        pose=pose,
        verb="is not in",
        nearest_m=max(limits.safety_floor_m, pose.distance_m - limits.enter_distance_m),
        farthest_m=pose.distance_m + limits.enter_distance_m + limits.tolerance_m,
        bearing_deg=limits.enter_bearing_deg,
        facing_deg=limits.enter_facing_deg,
        speed_m_s=limits.rest_speed_m_s,
    )


def lost_band(pose: RelativePose, limits: Limits) -> DockingBand:
    """The band for turning at the pose, whatever the speed and heading."""
    return DockingBand(
        pose=pose,
        verb="left",
        nearest_m=max(limits.safety_floor_m, pose.distance_m - limits.lost_distance_m),
        farthest_m=pose.distance_m + limits.lost_distance_m + limits.tolerance_m,
        bearing_deg=limits.lost_bearing_deg,
        facing_deg=180.0,
        speed_m_s=inf,
    )


def leave_band(pose: RelativePose, limits: Limits) -> DockingBand:
    """The band for holding the pose during the greeting."""
    return DockingBand(
        pose=pose,
        verb="left",
        nearest_m=max(limits.safety_floor_m, pose.distance_m - limits.leave_closer_m),
        farthest_m=pose.distance_m + limits.leave_farther_m + limits.tolerance_m,
        bearing_deg=limits.leave_bearing_deg,
        facing_deg=limits.leave_facing_deg,
        speed_m_s=inf,
    )
