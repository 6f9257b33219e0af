"""How the robot moved near people: mean distance, shares of Hall's zones, speed, and who came at whom.

All distances are between the nearest points of two bodies (`surface`).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from comity_sim2d.frames import Frames
from comity_sim2d.metrics.motion import Numbers, speeds_m_s, velocities_m_s
from comity_sim2d.metrics.proximity import seconds_to_collision, weights_s, zones

NEAR_M = 1.5
"""Nearer than this the robot keeps to the speed that people near it are to meet [m]."""
FAST_SHARE = 0.95
"""The percentile of the speed: the largest one of an episode is that of a single frame."""


def mean_nearest_m(frames: Frames, gaps: Numbers) -> float | None:
    """Mean gap to the nearest person over time [m]; None without people or time.

    Args:
        frames: Of the episode.
        gaps: Of `clearances_m`.
    """
    steps = weights_s(frames)
    if gaps.shape[1] == 0 or steps.sum() == 0.0:
        return None
    return float(np.average(gaps.min(axis=1), weights=steps))


def zone_shares(frames: Frames, gaps: Numbers) -> tuple[float, float, float, float] | None:
    """Shares of time with the nearest person in intimate, personal, social and public distance; sum 1."""
    steps = weights_s(frames)
    if gaps.shape[1] == 0 or steps.sum() == 0.0:
        return None
    seconds = np.bincount(zones(gaps), weights=steps, minlength=4)
    intimate, personal, social, public = (seconds / seconds.sum()).tolist()
    return (intimate, personal, social, public)


def fast_near_m_s(frames: Frames, gaps: Numbers) -> float | None:
    """95th percentile of the robot's speed within `NEAR_M` of the people in the columns [m/s]; None: never.

    A step between two frames is within it where the mean of the gaps at its ends is.
    """
    near = ((gaps[:-1] + gaps[1:]) / 2 < NEAR_M).any(axis=1)
    return float(np.quantile(speeds_m_s(frames)[near], FAST_SHARE)) if near.any() else None


def contacts_by(frames: Frames) -> tuple[int, int]:
    """Contacts that began with the robot coming at the person faster than the person at it; all others.

    Between two frames both are taken to move straight, so a touch between frames counts.
    """
    touching = seconds_to_collision(frames) <= np.diff(frames.time_s)[:, None]
    began = touching & ~np.vstack([np.zeros((1, touching.shape[1]), dtype=np.bool_), touching])[:-1]
    by_robot = _comes_faster(frames)
    return int((began & by_robot).sum()), int((began & ~by_robot).sum())


def _comes_faster(frames: Frames) -> NDArray[np.bool_]:
    """Whether the robot closes the distance faster than the person does, shape (n - 1, people)."""
    apart = frames.poses[:-1, 1:, :2] - frames.poses[:-1, :1, :2]
    moved = velocities_m_s(frames)
    robot = (moved[:, :1] * apart).sum(axis=-1)
    person = -(moved[:, 1:] * apart).sum(axis=-1)
    return np.asarray(robot > person)
