"""Walks of people, detected from their positions, whatever caused them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from comity.answers.run import Disturbance
from comity_sim2d.robot.walkers_met import WALK_M

if TYPE_CHECKING:
    from comity_sim2d import Frames

MOVES_M_S = 0.05
"""Minimum speed of a walk [m/s]; slower people count as standing."""
PAUSE_S = 1.0
"""Two walks with a shorter pause between them [s] count as one: the person waited for another."""


def walks(frames: Frames, people: Iterable[str]) -> Iterator[Disturbance]:
    """Every walk of these people, with its start, destination and end.

    Args:
        frames: Poses of all people.
        people: Names of the scenario's people, without passers-by.
    """
    time_s = frames.time_s
    for name in people:
        xy = frames.of(name)[:, :2]
        step_m = np.hypot(*np.diff(xy, axis=0).T)
        moving = np.flatnonzero(step_m > MOVES_M_S * np.diff(time_s))
        if not moving.size:
            continue
        breaks = np.flatnonzero(time_s[moving[1:]] - time_s[moving[:-1] + 1] >= PAUSE_S) + 1
        for first, past in pairwise((0, *breaks.tolist(), len(moving))):
            start, end = moving[first], moving[past - 1] + 1
            length_m = step_m[start:end].sum()
            if length_m < WALK_M:
                continue
            x, y = xy[end]
            text = f"{name} walks {length_m:.1f} m to ({x:.1f}, {y:.1f})"
            end_s = float(time_s[end]) if end < len(xy) - 1 else None
            yield Disturbance(float(time_s[start]), end_s, "walk", name, text)
