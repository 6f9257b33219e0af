"""How the robot moved: path, speed, acceleration, jerk, turning, standing still."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from comity_sim2d.frames import Frames
from comity_sim2d.kinds import require_kinds, require_numbers

Numbers = NDArray[np.float64]

STANDING_M_S = 0.02
"""Below this speed the robot stands [m/s]."""
STANDING_RAD_S = 0.08
"""Below this turning rate the robot stands [rad/s]: a rim of 0.25 m then moves at `STANDING_M_S` (our
choice)."""
STRETCH_M = 0.1
"""Path length over which the direction of travel is measured [m] (our choice: well above the noise of a
frame)."""
STUCK_M, STUCK_S = 0.1, 3.0
"""Under way and no farther than `STUCK_M` in `STUCK_S`: the robot failed to make progress (our choice of
both)."""


@dataclass(frozen=True, slots=True)
class Span:
    """A stretch of time, both ends included [s]."""

    start_s: float
    end_s: float

    def __post_init__(self) -> None:
        require_numbers("span", start_s=self.start_s, end_s=self.end_s)


def path_length_m(frames: Frames) -> float:
    """Path length of the robot's centre [m]."""
    require_kinds("figures", frames=(frames, Frames))
    return float(path_lengths_m(frames)[0])


def path_lengths_m(frames: Frames) -> Numbers:
    """Path length of every entity's centre [m], shape (entities,)."""
    steps = np.diff(frames.poses[:, :, :2], axis=0)
    return np.asarray(np.hypot(steps[..., 0], steps[..., 1]).sum(axis=0))


def speeds_m_s(frames: Frames) -> Numbers:
    """The robot's mean speed between frames [m/s], shape (n - 1,)."""
    require_kinds("figures", frames=(frames, Frames))
    return _size(_velocities(frames, 0))


def walks_m_s(frames: Frames, entity: int) -> Numbers:
    """A person's mean speed between frames [m/s], shape (n - 1,)."""
    return _size(_velocities(frames, entity))


def accelerations_m_s2(frames: Frames) -> Numbers:
    """Magnitude of the robot's acceleration [m/s^2], shape (n - 2,); turning counts as well."""
    return _size(_rate(_velocities(frames, 0), _middles(frames.time_s)))


def jerks_m_s3(frames: Frames) -> Numbers:
    """Magnitude of the robot's jerk [m/s^3], shape (n - 3,) (Francis et al. 2023)."""
    times = _middles(frames.time_s)
    return _size(_rate(_rate(_velocities(frames, 0), times), _middles(times)))


def mean(values: Numbers) -> float:
    """Mean over the steps between frames; 0 if there are none."""
    return float(values.mean()) if values.size else 0.0


def heading_change_rad(frames: Frames) -> float:
    """Total absolute turning of the robot [rad] (HuNavSim's cumulative heading changes)."""
    return float(turns_rad(frames).sum())


def turns_rad(frames: Frames) -> Numbers:
    """Absolute turning of the robot between frames [rad], shape (n - 1,)."""
    return _turns(frames.poses[:, 0, 2])


def path_irregularity_rad_m(frames: Frames) -> float:
    """Turning of the direction of travel per metre of path [rad/m]; 0 for a straight path or none.

    The direction is taken between places at least `STRETCH_M` apart; between single frames of a slow robot it
    would be noise. Turns forced by walls and people are included.
    """
    places = [frames.poses[0, 0, :2].tolist()]
    for place in frames.poses[:, 0, :2].tolist():
        if math.dist(place, places[-1]) >= STRETCH_M:
            places.append(place)
    steps: Numbers = np.diff(np.array(places, dtype=np.float64), axis=0)
    turned, length = _turns(np.arctan2(steps[:, 1], steps[:, 0])).sum(), _size(steps).sum()
    return float(turned / length) if length > 0.0 else 0.0


def _turns(angles: Numbers) -> Numbers:
    """Absolute difference between consecutive angles, the short way [rad]."""
    return np.asarray(np.abs(np.remainder(np.diff(angles) + np.pi, 2 * np.pi) - np.pi))


def stalled_s(frames: Frames, under_way: Sequence[Span]) -> float:
    """Time for which the robot stood although it was under way [s]."""
    standing = speeds_m_s(frames) < STANDING_M_S
    return float(np.diff(frames.time_s)[standing & within(_middles(frames.time_s), under_way)].sum())


def failures_to_progress(frames: Frames, under_way: Sequence[Span]) -> int:
    """Number of times the robot, under way, moved no farther than `STUCK_M` in `STUCK_S`."""
    return sum(_times_stuck(frames, span) for span in under_way)


def _times_stuck(frames: Frames, span: Span) -> int:
    inside = within(frames.time_s, (span,))
    times, places = frames.time_s[inside].tolist(), frames.poses[inside, 0, :2].tolist()
    count, anchor, counted = 0, 0, False
    for k, place in enumerate(places):
        if math.dist(place, places[anchor]) > STUCK_M:
            anchor, counted = k, False
        elif times[k] - times[anchor] >= STUCK_S and not counted:
            count, counted = count + 1, True
    return count


def velocities_m_s(frames: Frames) -> Numbers:
    """Mean velocity of every entity between frames [m/s], shape (n - 1, entities, 2)."""
    return _rate(frames.poses[..., :2], frames.time_s)


def _velocities(frames: Frames, entity: int) -> Numbers:
    """Mean velocity of one entity between frames [m/s], shape (n - 1, 2)."""
    return _rate(frames.poses[:, entity, :2], frames.time_s)


def _rate(values: Numbers, times: Numbers) -> Numbers:
    """Rate of change along the first axis."""
    steps = np.diff(times).reshape(-1, *[1] * (values.ndim - 1))
    return np.asarray(np.diff(values, axis=0) / steps)


def _middles(times: Numbers) -> Numbers:
    return np.asarray((times[1:] + times[:-1]) / 2)


def _size(vectors: Numbers) -> Numbers:
    return np.asarray(np.hypot(vectors[:, 0], vectors[:, 1]))


def within(times: Numbers, spans: Sequence[Span]) -> NDArray[np.bool_]:
    """Whether each time lies in one of the spans."""
    inside = np.zeros(len(times), dtype=np.bool_)
    for span in spans:
        inside |= (times >= span.start_s) & (times <= span.end_s)
    return inside


def without(span: Span, breaks: Sequence[Span]) -> tuple[Span, ...]:
    """The parts of a time span outside some breaks.

    Args:
        span: The time span.
        breaks: Breaks in order of time. A span that begins with a break starts at the break's end.
    """
    left, start_s = [], span.start_s
    for each in breaks:
        end_s = min(math.nextafter(each.start_s, -math.inf), span.end_s)
        if start_s <= end_s:
            left.append(Span(start_s, end_s))
        start_s = max(start_s, each.end_s)
    return (*left, Span(start_s, span.end_s)) if start_s <= span.end_s else tuple(left)
