"""Motion near people: mean distance, shares of Hall's zones, speed, and who caused contacts.

All distances are between the nearest points of two bodies (`surface`).
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from comity_sim2d.base.drive import NEAR_PEOPLE_M
from comity_sim2d.frames import Frames
from comity_sim2d.metrics.metric import HALL, HUNAVSIM, defined
from comity_sim2d.metrics.motion import Numbers, speeds_m_s, velocities_m_s
from comity_sim2d.metrics.proximity import seconds_in_zones, weights_s

ROUNDING_M_S = 1e-9
"""Speeds that differ by less than this are equal [m/s]."""
FAST_SHARE = 0.95
"""Percentile of the speed that counts: the maximum of an episode is that of a single frame."""


@dataclass(frozen=True, slots=True)
class NearPeople:
    """Metrics of one episode; None if there are no people, or the robot was never so near."""

    contacts_by_robot: int = field(
        metadata=defined(
            "1",
            "Contacts with people that began, in the frames, with the robot coming at the person at least "
            "as fast as the person came at it.",
        )
    )
    contacts_by_people: int = field(
        metadata=defined("1", "The other contacts with people that began in the frames.")
    )
    mean_nearest_distance_m: float | None = field(
        metadata=defined(
            "m", "Mean gap to the nearest person over time, between surfaces.", HUNAVSIM, least=None
        )
    )
    intimate_space_share: float | None = field(
        metadata=defined(
            "1", "Share of time with the nearest person closer than 0.45 m, between surfaces.", HALL, most=1.0
        )
    )
    personal_space_share: float | None = field(
        metadata=defined(
            "1", "Share of time with the nearest person at 0.45 to 1.2 m, between surfaces.", HALL, most=1.0
        )
    )
    social_space_share: float | None = field(
        metadata=defined(
            "1", "Share of time with the nearest person at 1.2 to 3.6 m, between surfaces.", HALL, most=1.0
        )
    )
    public_space_share: float | None = field(
        metadata=defined(
            "1", "Share of time with the nearest person at 3.6 m or more, between surfaces.", HALL, most=1.0
        )
    )
    p95_speed_within_1_5_m_m_s: float | None = field(
        metadata=defined(
            "m/s", "95th percentile of the robot's speed within 1.5 m of any person, between surfaces."
        )
    )


def near_people(frames: Frames, gaps: Numbers, collision_s: Numbers) -> NearPeople:
    """Measure one episode.

    Args:
        frames: Frames of the episode.
        gaps: Result of `clearances_m` [m], shape (n, people).
        collision_s: Result of `seconds_to_collision` [s], shape (n - 1, people).
    """
    began = _contacts_begun(frames, collision_s)
    by_robot = int((began & _robot_closes_faster(frames)).sum())
    seconds = np.array(seconds_in_zones(frames, gaps))
    has_zones = seconds.sum() > 0.0
    shares: list[float | None] = (seconds / seconds.sum()).tolist() if has_zones else [None] * len(seconds)
    return NearPeople(
        contacts_by_robot=by_robot,
        contacts_by_people=int(began.sum()) - by_robot,
        mean_nearest_distance_m=_mean_nearest_m(frames, gaps) if has_zones else None,
        intimate_space_share=shares[0],
        personal_space_share=shares[1],
        social_space_share=shares[2],
        public_space_share=shares[3],
        p95_speed_within_1_5_m_m_s=speed_near_m_s(frames, gaps),
    )


def _mean_nearest_m(frames: Frames, gaps: Numbers) -> float:
    return float(np.average(gaps.min(axis=1), weights=weights_s(frames)))


def speed_near_m_s(frames: Frames, gaps: Numbers) -> float | None:
    """95th percentile of the speed within `NEAR_PEOPLE_M` of the given people [m/s]; None if never there.

    A step between two frames counts if the mean of the gaps at its ends is within that distance.
    """
    near = ((gaps[:-1] + gaps[1:]) / 2 < NEAR_PEOPLE_M).any(axis=1)
    return float(np.quantile(speeds_m_s(frames)[near], FAST_SHARE)) if near.any() else None


def _contacts_begun(frames: Frames, collision_s: Numbers) -> NDArray[np.bool_]:
    """Steps in which bodies begin to touch, moving straight between frames, shape (n - 1, people)."""
    touching = collision_s <= np.diff(frames.time_s)[:, None]
    began = touching.copy()
    began[1:] &= ~touching[:-1]
    return np.asarray(began)


def _robot_closes_faster(frames: Frames) -> NDArray[np.bool_]:
    """Steps in which the robot closes the distance at least as fast as the person, shape (n - 1, people)."""
    apart = frames.poses[:-1, 1:, :2] - frames.poses[:-1, :1, :2]
    moved = velocities_m_s(frames)
    robot = (moved[:, :1] * apart).sum(axis=-1)
    person = -(moved[:, 1:] * apart).sum(axis=-1)
    return np.asarray((robot > 0.0) & (robot >= person - ROUNDING_M_S))
