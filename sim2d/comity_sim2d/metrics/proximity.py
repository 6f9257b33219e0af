"""Proximity to people: gaps, Hall's zones, time to collision.

All distances are between the nearest points of two bodies (`surface`).
"""

from __future__ import annotations

import math

import numpy as np

from comity_fis.proxemics import SOCIAL_M
from comity_sim2d.frames import Frames
from comity_sim2d.kinds import require_kinds
from comity_sim2d.metrics.motion import Numbers, velocities_m_s

INTIMATE_M, PERSONAL_M = 0.45, 1.2
"""Outer limits of Hall's intimate and personal space [m], as in HuNavSim (Hall 1966 has 4 feet for the
latter: 1.22 m)."""


def clearances_m(frames: Frames) -> Numbers:
    """Gaps between the robot and every person [m], shape (n, people)."""
    require_kinds("figures", frames=(frames, Frames))
    apart = frames.poses[:, 1:, :2] - frames.poses[:, :1, :2]
    radii = np.array(frames.radius_m)
    return np.asarray(np.hypot(apart[..., 0], apart[..., 1]) - radii[0] - radii[1:])


def seconds_in_zones(frames: Frames, gaps: Numbers) -> tuple[float, float, float, float]:
    """Time with the nearest person in intimate, personal, social and public distance [s]; 0 if alone."""
    if gaps.shape[1] == 0:
        return (0.0, 0.0, 0.0, 0.0)
    zones = np.searchsorted((INTIMATE_M, PERSONAL_M, SOCIAL_M), gaps.min(axis=1), side="right")
    steps = weights_s(frames)
    return (
        float(steps[zones == 0].sum()),
        float(steps[zones == 1].sum()),
        float(steps[zones == 2].sum()),
        float(steps[zones == 3].sum()),
    )


def contacts(gaps: Numbers) -> int:
    """Number of contacts that began in the frames, including those in the first frame.

    Args:
        gaps: Result of `clearances_m`.
    """
    overlaps = gaps < 0.0
    return int(overlaps[0].sum() + (overlaps[1:] & ~overlaps[:-1]).sum())


def seconds_to_collision(frames: Frames) -> Numbers:
    """Time to collision of the robot and each person at constant velocities [s].

    Shape (n - 1, people), for each frame but the last; 0 if bodies overlap, infinite if they miss each other.
    """
    require_kinds("figures", frames=(frames, Frames))
    places = frames.poses[..., :2]
    velocities = velocities_m_s(frames)
    apart = places[:-1, 1:] - places[:-1, :1]
    closing = velocities[:, 1:] - velocities[:, :1]
    reach = np.array(frames.radius_m[1:]) + frames.radius_m[0]
    a = (closing**2).sum(axis=-1)
    b = (apart * closing).sum(axis=-1)
    c = (apart**2).sum(axis=-1) - reach**2
    root = b**2 - a * c
    meets = (a > 0) & (b < 0) & (root >= 0) & (c > 0)
    times = np.where(c <= 0, 0.0, math.inf)
    times[meets] = (-b[meets] - np.sqrt(root[meets])) / a[meets]
    return np.asarray(times)


def weights_s(frames: Frames) -> Numbers:
    """Duration that each frame represents, until the next one [s]."""
    return np.append(np.diff(frames.time_s), 0.0)
