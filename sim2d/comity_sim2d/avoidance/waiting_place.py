"""Waiting place of a robot that backed out of a narrow place: off the line of the person who comes out."""

from __future__ import annotations

import math

import numpy as np

from comity_sim2d.pose import XY
from comity_sim2d.scene.obstacles import WALL_MARGIN_M, FloorPlan

ASIDE_M = 0.5
"""Gap left for them between the bodies [m]: people do not like to pass nearer (our choice)."""
AWAY_M, STEP_M = (0.3, 0.5, 0.7, 0.9, 1.1), 0.1
"""Distances of the candidate places [m], and the step along the paths to them [m]."""
AROUND = 32
"""Number of candidate directions."""
FARTHER = 0.2
"""Gain in distance from their line that each metre of path must bring (our choice)."""


def waiting_place(xy: XY, held_at: XY, radius_m: float, other_m: float, plan: FloorPlan) -> XY:
    """The best place on a straight path not leading back to `held_at`; `xy` if none is better.

    Args:
        xy: Position of the robot [m].
        held_at: Where it was blocked: the person comes from there [m].
        radius_m: Radius of the robot [m].
        other_m: Radius of the person [m].
        plan: The static obstacles.
    """
    angles = np.arange(AROUND) * (math.tau / AROUND)
    away_m = np.repeat(AWAY_M, AROUND)
    ways = np.tile(np.column_stack([np.cos(angles), np.sin(angles)]), (len(AWAY_M), 1))
    along = np.array(xy) - np.array(held_at)
    along /= max(math.hypot(*along), 1e-9)
    beside_m = np.abs(ways @ np.array((-along[1], along[0]))) * away_m
    enough_m = radius_m + other_m + ASIDE_M
    gain = np.minimum(beside_m, enough_m) - FARTHER * away_m
    gain[(ways @ along) < -1e-9] = -math.inf
    steps = np.arange(STEP_M, AWAY_M[-1] + STEP_M / 2, STEP_M)
    for best in np.argsort(-gain, kind="stable").tolist():
        if gain[best] <= 0.0:
            break
        way = np.array(xy) + ways[best] * np.minimum(steps, away_m[best])[:, None]
        if plan.are_free(way, radius_m + WALL_MARGIN_M).all():
            return (float(way[-1, 0]), float(way[-1, 1]))
    return xy
