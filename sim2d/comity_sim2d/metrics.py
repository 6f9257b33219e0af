"""Figures of an episode, from its frames alone."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from comity_sim2d.frames import Frames


@dataclass(frozen=True, slots=True)
class Metrics:
    """What a robot's way amounts to (names after Francis et al. 2023, arXiv 2306.16740)."""

    duration_s: float
    path_length_m: float
    max_speed_m_s: float
    min_clearance_m: float
    """The smallest gap to any person, between the nearest points of the bodies; infinite without people."""
    touches: int
    """Contacts with people, walls and furniture that began."""


def measure(frames: Frames, touches: int = 0) -> Metrics:
    """The metrics of an episode; contacts come from the world, which knows its walls."""
    speed = speeds_m_s(frames)
    return Metrics(
        duration_s=float(frames.time_s[-1] - frames.time_s[0]),
        path_length_m=path_length_m(frames),
        max_speed_m_s=float(speed.max(initial=0.0)),
        min_clearance_m=float(min((gap.min() for gap in clearances_m(frames).T), default=math.inf)),
        touches=touches,
    )


def path_length_m(frames: Frames) -> float:
    """The way of the robot's centre."""
    return float(np.hypot(*np.diff(frames.poses[:, 0, :2], axis=0).T).sum())


def speeds_m_s(frames: Frames) -> NDArray[np.float64]:
    """The robot's mean speed between frames, shape (n - 1,)."""
    moved = np.hypot(*np.diff(frames.poses[:, 0, :2], axis=0).T)
    return np.asarray(moved / np.diff(frames.time_s))


def clearances_m(frames: Frames) -> NDArray[np.float64]:
    """The gaps between the robot and every person, shape (n, people)."""
    apart = frames.poses[:, 1:, :2] - frames.poses[:, :1, :2]
    radii = np.array(frames.radius_m)
    return np.asarray(np.hypot(apart[..., 0], apart[..., 1]) - radii[0] - radii[1:])
