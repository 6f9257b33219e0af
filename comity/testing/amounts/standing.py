"""Where the robot stood when it had docked, computed from the frames and from nothing that it believed."""

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
"""Off the direction in which a person faces: beyond the front and up to this it is a side, then the back."""


@dataclass(frozen=True, slots=True)
class DockedPose:
    """The robot beside a person."""

    t: float
    distance_m: float
    """Between the nearest points of the two bodies."""
    bearing_deg: float
    """From where the person faces, positive to their left."""

    @property
    def side(self) -> str:
        """front, left, right or back, as the person sees it."""
        if abs(self.bearing_deg) <= FRONT_DEG:
            return "front"
        if abs(self.bearing_deg) > BESIDE_DEG:
            return "back"
        return "left" if self.bearing_deg > 0 else "right"


def standing(frames: Frames, visits: Iterable[Visit], person: str) -> DockedPose | None:
    """Where the robot stood at its last docking before a person; None where it never docked."""
    visit = visit_of(visits, person)
    if visit is None or visit.docked_s is None:
        return None
    now = int(np.argmin(np.abs(frames.time_s - visit.docked_s)))
    other = frames.entities.index(person)
    (x, y, _), (px, py, facing) = frames.poses[now, 0], frames.poses[now, other]
    bearing = math.degrees(math.remainder(math.atan2(y - py, x - px) - facing, math.tau))
    gap = math.hypot(x - px, y - py) - frames.radius_m[0] - frames.radius_m[other]
    return DockedPose(float(frames.time_s[now]), float(gap), float(bearing))
