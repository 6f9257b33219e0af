"""Where people went, when the robot stood before them, and which place it chose: figures of a test alone."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

import numpy as np

from comity.testing.metrics.course import of_course
from comity.testing.metrics.happened import walking
from comity.testing.metrics.standing import standing

if TYPE_CHECKING:
    from comity.testing.trials.trial import Trial

WALKED = "walked"
"""The way of somebody's centre [m], by the frames; without a name of all people together, passers-by too."""
REACHED, DOCKING_ERROR = "docking_time", "docking_error"
OF_VISIT: Mapping[str, str] = {
    REACHED: "s",
    DOCKING_ERROR: "m",
    "chosen_distance": "m",
    "chosen_bearing": "deg",
}
"""Of a visit, with their units: when the robot docked last, and the place that it chose last."""

_NOTHING = "no `walks`, no `reacts`, no `comfort`, no fault, and no change with `moves_to_m`"
_STAYS = f"stays: the scenario has {_NOTHING} for them"
_STAY = f"walks: the scenario has {_NOTHING} for anybody"


def walked_m(trial: Trial, person: str | None) -> float:
    """How far somebody, or everybody together, went in the episode [m]."""
    frames = trial.episode.frames
    steps = np.diff(frames.poses[:, :, :2], axis=0)
    ways = dict(zip(frames.entities, np.hypot(steps[..., 0], steps[..., 1]).sum(axis=0), strict=True))
    return float(ways[person] if person else sum(ways[name] for name in frames.entities[1:]))


def of_walk(trial: Trial, person: str | None) -> Iterator[str]:
    """What has somebody walk, or anybody, and then the course; who stays takes no part in that."""
    keys = walking(trial, person)
    moved = walked_m(trial, person) > 0
    if keys:
        yield f"walks     {', '.join(keys)}"
    elif not moved:
        yield f"walks     {person or 'nobody'} {_STAYS if person else _STAY}"
    if keys or moved:
        yield from of_course(trial)


def of_visit(trial: Trial, name: str, person: str) -> float | None:
    """One of `OF_VISIT`; None where the robot never came to it."""
    visit = trial.visit(person)
    if visit is None:
        return None
    if name == REACHED:
        return visit.docked_s
    if name == DOCKING_ERROR:
        stood = standing(trial, person)
        if stood is None or visit.docked_s is None:
            return None
        target_m = trial.episode.values_at(person, visit.docked_s)["conversational_distance"].number
        return abs(stood.distance_m - target_m)
    if visit.pose is None:
        return None
    return visit.pose.distance_m if name == "chosen_distance" else visit.pose.bearing_deg
