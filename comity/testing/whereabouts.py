"""Where people went, when the robot stood before them, and which place it chose: figures of a test alone."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from comity.testing.trial import Trial

WALKED = "walked"
"""The way of somebody's centre [m], by the frames; without a name of all people together, passers-by too."""
REACHED = "reached"
OF_VISIT: Mapping[str, str] = {REACHED: "s", "chosen_distance": "m", "chosen_bearing": "deg"}
"""Of a visit, with their units: when the robot docked last, and the place that it chose last."""


def walked_m(trial: Trial, person: str | None) -> float:
    """How far somebody, or everybody together, went in the episode [m]."""
    frames = trial.episode.frames
    steps = np.diff(frames.poses[:, :, :2], axis=0)
    ways = dict(zip(frames.entities, np.hypot(steps[..., 0], steps[..., 1]).sum(axis=0), strict=True))
    return float(ways[person] if person else sum(ways[name] for name in frames.entities[1:]))


def of_visit(trial: Trial, name: str, person: str) -> float | None:
    """One of `OF_VISIT`; None where the robot never came to it."""
    visit = trial.visit(person)
    if visit is None:
        return None
    if name == REACHED:
        return visit.docked_s
    if visit.pose is None:
        return None
    return visit.pose.distance_m if name == "chosen_distance" else visit.pose.bearing_deg
