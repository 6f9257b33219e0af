"""The robot's pose after docking, computed from the frames, not from the robot's beliefs."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from comity.testing.trials.visits import visit_of
from comity_fis.proxemics import FRONT_DEG

if TYPE_CHECKING:
    from collections.abc import Iterable

    from comity_executor import Visit
    from comity_sim2d import Frames

BESIDE_DEG = 112.5
"""Angle from the person's facing direction [deg] that separates the sides from the back."""


@dataclass(frozen=True, slots=True)
class DockedPose:
    """The robot's docking pose relative to a person."""

    t: float
    distance_m: float
    """Distance between the nearest points of the two bodies [m]."""
    bearing_deg: float
    """Angle from the person's facing direction [deg], positive to their left."""

    @property
    def side(self) -> str:
        """front, left, right or back, from the person's point of view."""
        if abs(self.bearing_deg) <= FRONT_DEG:
            return "front"
        if abs(self.bearing_deg) > BESIDE_DEG:
            return "back"
        return "left" if self.bearing_deg > 0 else "right"


def standing(frames: Frames, visits: Iterable[Visit], person: str) -> DockedPose | None:
    """The robot's pose at its last docking at a person; None if it never docked."""
    visit = visit_of(visits, person)
    if visit is None or visit.docked_s is None:
        return None
    now = int(np.argmin(np.abs(frames.time_s - visit.docked_s)))
    other = frames.entities.index(person)
    (x, y, _), (px, py, facing) = frames.poses[now, 0], frames.poses[now, other]
    bearing = math.degrees(math.remainder(math.atan2(y - py, x - px) - facing, math.tau))
    gap = math.hypot(x - px, y - py) - frames.radius_m[0] - frames.radius_m[other]
    return DockedPose(float(frames.time_s[now]), float(gap), float(bearing))
