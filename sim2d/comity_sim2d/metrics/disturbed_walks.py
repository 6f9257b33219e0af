"""Delay and deviation that the robot causes in people's walks, compared with the same walks without it.

Both walks have the same seed, so every difference began with the robot. It need not have met each person
itself: a person who gave way to it may have blocked another.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from comity_sim2d.metrics.metric import defined

Numbers = NDArray[np.float64]

NEAR_M = 0.1
"""Places on a path nearer to each other than this count as the same [m]: standing people sway."""
AHEAD_M = 0.5
"""Path length ahead, beyond the distance walked since, in which the next place is searched [m]."""
EVERY_S = 0.1
"""Period of people's decisions [s]: between two of them nothing new happens."""


@dataclass(frozen=True, slots=True)
class DisturbedWalk:
    """The effect of the robot's presence on one person's walk."""

    walk_delay_s: float = field(
        metadata=defined(
            "s",
            "Largest delay of a person who walks: how much later they came to a place of the path taken "
            "without the robot, with the same seed.",
            per="person",
        )
    )
    walk_deviation_m: float = field(
        metadata=defined(
            "m",
            "Largest distance of a person who walks from the path taken without the robot, with the same "
            "seed.",
            per="person",
        )
    )


def disturbed_walk(time_s: Numbers, walked: Numbers, undisturbed: Numbers) -> DisturbedWalk:
    """Compare a walk with the same walk without the robot.

    The person's progress along the undisturbed path is its nearest place that is neither behind the progress
    so far nor farther ahead than the person can have come since. So a path that crosses itself, or is walked
    to and fro, is followed in its order. The delay is the time since the person would have been there without
    the robot; at a place where the person would have rested, the moment nearest to now counts.

    Args:
        time_s: Ascending times of the walk [s], shape (n,).
        walked: Positions with the robot [m], shape (n, 2).
        undisturbed: Ascending times [s] and positions [m] without it, shape (m, 3); somewhat longer than the
            walk, in case the robot made the person arrive sooner.
    """
    here, path = _thinned(np.column_stack([time_s, walked])), _thinned(undisturbed)
    along_m, gone_m = _lengths_m(path[:, 1:]), _lengths_m(here[:, 1:])
    at, since_m, delay_s, deviation_m = 0, 0.0, 0.0, 0.0
    for (now_s, *place), gone in zip(here.tolist(), gone_m.tolist(), strict=True):
        end = int(along_m.searchsorted(along_m[at] + gone - since_m + AHEAD_M, side="right"))
        away_m = np.hypot(*(path[at:end, 1:] - place).T)
        nearest = at + int(away_m.argmin())
        if along_m[nearest] > along_m[at]:
            at, since_m = nearest, gone
        deviation_m = max(deviation_m, float(away_m.min()))
        there_s = path[np.abs(along_m - along_m[at]) <= NEAR_M, 0]
        delay_s = max(delay_s, now_s - float(there_s[np.abs(there_s - now_s).argmin()]))
    return DisturbedWalk(delay_s, deviation_m)


def _thinned(track: Numbers) -> Numbers:
    """Rows of times and positions about `EVERY_S` apart."""
    return track[:: max(1, round(EVERY_S / float(track[1, 0] - track[0, 0])))] if len(track) > 1 else track


def _lengths_m(places: Numbers) -> Numbers:
    """Length of the path up to each place [m]."""
    return np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(places, axis=0).T))])
