"""Approach to one person: stopping pose against its target, speed, and legibility.

The definitions are this project's own; distances are between the nearest points of the two bodies.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from comity_fis.proxemics import FACES_DEG, SOCIAL_M
from comity_sim2d.base.drive import NEAR_PEOPLE_M
from comity_sim2d.frames import Frames
from comity_sim2d.kinds import TRUTH, require_kinds, require_numbers, require_pairs
from comity_sim2d.metrics.metric import defined
from comity_sim2d.metrics.motion import (
    STANDING_M_S,
    STANDING_RAD_S,
    Numbers,
    Span,
    speeds_m_s,
    turns_rad,
    walks_m_s,
    within,
    without,
)
from comity_sim2d.metrics.proximity import clearances_m
from comity_sim2d.pose import wrap_angle
from comity_sim2d.scene_error import require_finite, require_text, require_tuple, unknown

REST_S = 0.3
"""Time of standing without turning that counts as rest [s]."""
HOLD_S = 5.0
HALF_TURN_DEG = 180.0


@dataclass(frozen=True, slots=True)
class TargetStop:
    """One visit: the person, the time, and the target stopping pose."""

    person: str
    span: Span
    """From departure to the end of the visit."""
    way: Span
    """From departure until the robot first docked, or gave up."""
    distance_m: float
    """Target distance at the stop [m]."""
    bearing_deg: float
    """Target bearing, positive to the person's left [deg]."""
    distances_m: tuple[tuple[float, float], ...] = ()
    """Times [s] and the target distance [m] from then on, in order; empty if it never changed."""
    arrives: bool = True
    """Whether the robot reached its target; if not, it stopped nowhere, wherever it rested on its way."""
    breaks: tuple[Span, ...] = ()
    """Times at which it dealt with another person, in order; they are no part of the visit."""
    docked_s: float | None = None
    """Time of the last docking [s]; None if it never docked."""
    own_m: float | None = None
    """The person's own distance at that time [m]."""
    chosen_distance_m: float | None = None
    """Distance of the last chosen docking pose, or of the pose left after the person moved [m]."""
    chosen_bearing_deg: float | None = None
    """Bearing of the same pose, positive to the person's left [deg]."""

    def __post_init__(self) -> None:
        require_text("visit", "person", self.person)
        require_kinds(self.person, span=(self.span, Span), way=(self.way, Span))
        require_finite(self.person, distance_m=self.distance_m, bearing_deg=self.bearing_deg)
        require_kinds(self.person, arrives=(self.arrives, TRUTH))
        require_pairs(self.person, "distances_m", self.distances_m, "(since_s, distance_m)")
        require_numbers(self.person, docked_s=self.docked_s, own_m=self.own_m)
        chosen = {
            "chosen_distance_m": self.chosen_distance_m,
            "chosen_bearing_deg": self.chosen_bearing_deg,
        }
        require_numbers(self.person, **chosen)
        require_tuple(self.person, "breaks", self.breaks, Span, "stretches of time, each a Span")

    @property
    def spans(self) -> tuple[Span, ...]:
        """The visit without its breaks."""
        return without(self.span, self.breaks)

    @property
    def ways(self) -> tuple[Span, ...]:
        """The way to the person without its breaks."""
        return without(self.way, self.breaks)


@dataclass(frozen=True, slots=True)
class Stopping:
    """Metrics of one approach; None if the robot never docked."""

    docking_error_m: float | None = field(
        metadata=defined(
            "m",
            "Between actual distance and the person's own as the robot docked last, between surfaces.",
            per="visit",
        )
    )
    docking_time_s: float | None = field(
        metadata=defined("s", "When the robot docked last, from the start.", per="visit")
    )
    chosen_distance_m: float | None = field(
        metadata=defined(
            "m",
            "Distance of the docking pose chosen last, between surfaces; of a person who moved, as they "
            "left it.",
            per="visit",
            least=None,
        )
    )
    chosen_bearing_deg: float | None = field(
        metadata=defined(
            "deg",
            "Bearing of the docking pose chosen last, positive to the person's left; of one who turned, as "
            "they left it.",
            per="visit",
            least=-HALF_TURN_DEG,
            most=HALF_TURN_DEG,
        )
    )
    stop_distance_error_m: float | None = field(
        metadata=defined(
            "m",
            "Distance at the stop minus target, between surfaces, where it docked.",
            per="visit",
            least=None,
        )
    )
    """Taken at docking if the robot never rested."""
    overshoot_m: float = field(
        metadata=defined(
            "m",
            "How much nearer it came during the visit than the target of that moment, at least 0.",
            per="visit",
        )
    )
    bearing_error_deg: float | None = field(
        metadata=defined(
            "deg", "Between target and actual bearing, at that rest.", per="visit", most=HALF_TURN_DEG
        )
    )
    robot_facing_error_deg: float | None = field(
        metadata=defined(
            "deg", "How far the robot looked past the person, at that rest.", per="visit", most=HALF_TURN_DEG
        )
    )
    person_facing_error_deg: float | None = field(
        metadata=defined(
            "deg",
            "How far the person looked past the robot, less the target bearing, at that rest.",
            per="visit",
            most=HALF_TURN_DEG,
        )
    )
    """A robot on any accepted side has no error."""
    speed_within_1_5_m_m_s: float | None = field(
        metadata=defined(
            "m/s",
            "Fastest within 1.5 m of the body on the way in, from any side, less the person's own speed.",
            per="visit",
        )
    )
    speed_at_3_6_m_m_s: float | None = field(
        metadata=defined("m/s", "Speed when it came within 3.6 m, between surfaces.", per="visit")
    )
    speed_at_1_2_m_m_s: float | None = field(
        metadata=defined("m/s", "Speed when it came within 1.2 m, between surfaces.", per="visit")
    )
    speed_at_target_plus_0_3_m_m_s: float | None = field(
        metadata=defined("m/s", "Speed 0.3 m before the target distance.", per="visit")
    )
    peak_closing_speed_m_s: float = field(
        metadata=defined("m/s", "Fastest shrinking of the gap on the way in.", per="visit")
    )
    peak_deceleration_m_s2: float = field(
        metadata=defined("m/s^2", "Hardest braking on the way in.", per="visit")
    )
    visible_approach_share: float | None = field(
        metadata=defined(
            "1",
            "Within 3.6 m: share of time within 60 degrees of where the person looks.",
            per="visit",
            most=1.0,
        )
    )
    hold_error_rms_m: float | None = field(
        metadata=defined(
            "m",
            "Root mean square of distance minus target, 5 s from that rest on, or to its end or a new wish.",
            per="visit",
        )
    )


def stopping(frames: Frames, wanted: TargetStop) -> Stopping:
    """Measure one approach.

    Args:
        frames: The episode.
        wanted: The visit; its person must be an entity of the frames.

    Raises:
        ValueError: If there is no such person.
    """
    require_kinds("figures", frames=(frames, Frames), wanted=(wanted, TargetStop))
    approach = _Approach.of(frames, wanted)
    rest = approach.rest(wanted.way.end_s) if wanted.arrives else None
    coming = slice(0, len(approach.times) if rest is None else rest + 1)
    gaps, speeds = approach.gaps[coming], approach.speeds[coming]
    steps = np.diff(approach.times[coming])
    return Stopping(
        docking_error_m=_docking_error_m(frames, wanted),
        docking_time_s=wanted.docked_s,
        chosen_distance_m=wanted.chosen_distance_m,
        chosen_bearing_deg=wanted.chosen_bearing_deg,
        stop_distance_error_m=None if rest is None else float(approach.gaps[rest]) - wanted.distance_m,
        overshoot_m=approach.overshoot_m(wanted.distances_m or ((-math.inf, wanted.distance_m),)),
        bearing_error_deg=None
        if rest is None
        else abs(math.degrees(wrap_angle(float(approach.bearings[rest]) - math.radians(wanted.bearing_deg)))),
        robot_facing_error_deg=None if rest is None else math.degrees(abs(float(approach.facings[rest]))),
        person_facing_error_deg=None
        if rest is None
        else max(0.0, math.degrees(abs(float(approach.bearings[rest]))) - abs(wanted.bearing_deg)),
        speed_within_1_5_m_m_s=_fastest_near(gaps, speeds - approach.walks[coming]),
        speed_at_3_6_m_m_s=_speed_at(SOCIAL_M, gaps, speeds),
        speed_at_1_2_m_m_s=_speed_at(1.2, gaps, speeds),
        speed_at_target_plus_0_3_m_m_s=_speed_at(wanted.distance_m + 0.3, gaps, speeds),
        peak_closing_speed_m_s=float((-np.diff(gaps) / steps).max(initial=0.0)),
        peak_deceleration_m_s2=float((-np.diff(speeds) / steps).max(initial=0.0)),
        visible_approach_share=_visible(gaps, approach.bearings[coming]),
        hold_error_rms_m=approach.hold_error(rest, wanted),
    )


def _docking_error_m(frames: Frames, wanted: TargetStop) -> float | None:
    """Difference of the gap at the last docking and the person's own distance at that time [m]."""
    if wanted.docked_s is None or wanted.own_m is None:
        return None
    frame = int(np.argmin(np.abs(frames.time_s - wanted.docked_s)))
    return abs(float(clearances_m(frames)[frame, frames.entities.index(wanted.person) - 1]) - wanted.own_m)


@dataclass(frozen=True, slots=True)
class _Approach:
    """One visit's frames, from the points of view of the person and the robot."""

    times: Numbers
    gaps: Numbers
    speeds: Numbers
    """Speed of the robot since the previous frame [m/s]."""
    walks: Numbers
    """Speed of the person since the previous frame [m/s]."""
    stands: NDArray[np.bool_]
    """Whether the robot neither moved nor turned since the previous frame."""
    bearings: Numbers
    """Bearing of the robot as seen by the person [rad]."""
    facings: Numbers
    """Bearing of the person as seen by the robot [rad]."""

    @classmethod
    def of(cls, frames: Frames, wanted: TargetStop) -> _Approach:
        if wanted.person not in frames.entities:
            raise unknown("a person of the frames", wanted.person, frames.entities)
        i = frames.entities.index(wanted.person)
        inside = within(frames.time_s, wanted.spans)
        robot, person = frames.poses[:, 0], frames.poses[:, i]
        speeds = np.concatenate(([0.0], speeds_m_s(frames)))
        walks = np.concatenate(([0.0], walks_m_s(frames, i)))
        turning = np.concatenate(([0.0], turns_rad(frames) / np.diff(frames.time_s)))
        stands = (speeds < STANDING_M_S) & (turning < STANDING_RAD_S)
        robot, person = robot[inside], person[inside]
        apart = robot[:, :2] - person[:, :2]
        towards = np.arctan2(apart[:, 1], apart[:, 0])
        return cls(
            times=frames.time_s[inside],
            gaps=np.asarray(np.hypot(*apart.T) - frames.radius_m[0] - frames.radius_m[i]),
            speeds=speeds[inside],
            walks=walks[inside],
            stands=stands[inside],
            bearings=_wrapped(towards - person[:, 2]),
            facings=_wrapped(towards + np.pi - robot[:, 2]),
        )

    def rest(self, docked_s: float) -> int | None:
        """Index of the stop: the start of the rest in which the robot docked, or of the next rest.

        A pause on the way is no stop, however near: a person may have blocked the path. A robot that never
        rests, because it follows a noisy reading, stopped where it docked. None: the visit ended before.
        """
        docked = int(np.searchsorted(self.times, docked_s - 1e-9))
        moved = np.flatnonzero(~self.stands[: docked + 1])
        begins = int(moved[-1]) + 1 if moved.size else 0
        at_docking = docked if docked < len(self.times) else None
        return next((k for k in range(begins, len(self.times)) if self._rests_at(k)), at_docking)

    def _rests_at(self, k: int) -> bool:
        """Whether the robot stands without turning for `REST_S` of the visit from a frame on."""
        if not self.stands[k]:
            return False
        until = np.searchsorted(self.times, self.times[k] + REST_S - 1e-9)
        return bool(self.stands[k : until + 1].all()) and until < len(self.times)

    def overshoot_m(self, wanted: Sequence[tuple[float, float]]) -> float:
        """Largest distance by which the robot came nearer than the target at that time [m]."""
        worst, allowed_m = 0.0, math.inf
        begins = np.searchsorted(self.times, [since_s for since_s, _ in wanted])
        for (first, end), (_, wanted_m) in zip(pairwise((*begins, len(self.times))), wanted, strict=True):
            gaps = self.gaps[first:end]
            if gaps.size:
                # Closer than allowed before, and than where it has retreated to since.
                allowed = np.minimum(wanted_m, np.maximum(allowed_m, np.maximum.accumulate(gaps)))
                worst, allowed_m = max(worst, float((allowed - gaps).max())), float(allowed[-1])
        return worst

    def hold_error(self, rest: int | None, wanted: TargetStop) -> float | None:
        """Error while holding the pose, until the target distance changes and the robot has to move."""
        if rest is None:
            return None
        since_s = self.times[rest]
        later = (s for s, distance_m in wanted.distances_m if s > since_s and distance_m != wanted.distance_m)
        held = (
            (self.times >= since_s) & (self.times <= since_s + HOLD_S) & (self.times < next(later, math.inf))
        )
        return float(np.sqrt(np.mean((self.gaps[held] - wanted.distance_m) ** 2)))


def _wrapped(angles: Numbers) -> Numbers:
    return np.asarray(np.pi - np.remainder(np.pi - angles, 2 * np.pi))


def _fastest_near(gaps: Numbers, speeds: Numbers) -> float | None:
    """Maximum speed between frames that are both within `NEAR_PEOPLE_M` [m/s]; None if none are."""
    near = np.maximum(gaps[:-1], gaps[1:]) <= NEAR_PEOPLE_M
    return float(speeds[1:][near].max(initial=0.0)) if near.any() else None


def _speed_at(distance_m: float, gaps: Numbers, speeds: Numbers) -> float | None:
    """Speed when the distance was first crossed inwards [m/s]; None if it never was."""
    crossed = np.flatnonzero((gaps[:-1] > distance_m) & (gaps[1:] <= distance_m))
    return float(speeds[crossed[0] + 1]) if crossed.size else None


def _visible(gaps: Numbers, bearings: Numbers) -> float | None:
    near = gaps <= SOCIAL_M
    seen = np.abs(np.degrees(bearings[near])) <= FACES_DEG
    return float(seen.mean()) if seen.size else None
