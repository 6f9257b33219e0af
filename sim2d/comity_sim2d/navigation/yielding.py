"""Giving way: how far the robot may go before a walking person crosses its path or comes towards it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from comity_fis.proxemics import PERSON_MARGIN_M
from comity_sim2d.navigation.route import Route
from comity_sim2d.paths.personal_space import Points
from comity_sim2d.pose import XY
from comity_sim2d.scene.person import Person

WALKS_M_S = 0.15
"""Below this speed a person stands, and the rest is sensor noise [m/s]."""
HORIZON_S = 4.0
MOMENTS = np.linspace(0.0, HORIZON_S, 17)
"""Prediction times [s], over which people are assumed to walk straight on."""
SLOWEST_M_S = 0.3
"""Speed at which a waiting robot is assumed to set out again [m/s]."""
MARGIN_M = PERSON_MARGIN_M + 0.05
STEP_M = 0.10


@dataclass(frozen=True, slots=True)
class Walker:
    """A walking person."""

    person: Person
    velocity: XY


def is_walking(velocity: XY) -> bool:
    """Whether a person with this velocity walks."""
    return math.hypot(*velocity) > WALKS_M_S


@dataclass(frozen=True, slots=True)
class GivingWay:
    """The person who goes first, and how far the robot may go until then."""

    person: str
    free_m: float


def giving_way(
    route: Route, way_m: float, speed_m_s: float, walkers: Sequence[Walker], robot_radius_m: float
) -> GivingWay | None:
    """The nearest conflict ahead; None if no person crosses the path.

    Args:
        route: The robot's route.
        way_m: Path length of the robot along it [m].
        speed_m_s: Its speed.
        walkers: People who move, or stand where the route does not expect them; not the visited person.
        robot_radius_m: Its radius.
    """
    speed_m_s = max(speed_m_s, SLOWEST_M_S)
    near = [walker for walker in walkers if _may_meet(route.at(way_m), speed_m_s, walker)]
    if not near:
        return None
    marks = way_m + speed_m_s * MOMENTS
    robot, paths = _points(route, marks), _paths(near)
    reach_m = np.array([walker.person.radius_m for walker in near]) + robot_radius_m + MARGIN_M
    apart_m = np.hypot(*np.moveaxis(robot - paths, 2, 0))
    close = apart_m < reach_m[:, None]
    # The robot does not give way to people who only move away.
    comes = close.any(axis=1) & (apart_m[:, 0] > apart_m.min(axis=1) + 1e-9)
    found = []
    for i in np.flatnonzero(comes).tolist():
        ahead_m = float(marks[close[i].argmax()]) - way_m
        found.append(GivingWay(near[i].person.name, _free_m(route, way_m, ahead_m, paths[i], reach_m[i])))
    return min(found, key=lambda each: each.free_m, default=None)


def _may_meet(robot: XY, speed_m_s: float, walker: Walker) -> bool:
    """Whether the two can come near each other within the horizon: most people of a crowd cannot."""
    reach_m = 1.0 + (speed_m_s + math.hypot(*walker.velocity)) * HORIZON_S
    return math.dist(robot, walker.person.xy) < reach_m + walker.person.radius_m


def _free_m(route: Route, way_m: float, ahead_m: float, path: Points, reach_m: float) -> float:
    """Distance that the robot can go and still keep off the walker's path [m]."""
    steps = np.arange(0.0, ahead_m + STEP_M, STEP_M)
    apart = _points(route, way_m + steps)[:, None] - path[None]
    blocked = np.flatnonzero(np.hypot(apart[..., 0], apart[..., 1]).min(axis=1) < reach_m)
    return float(steps[max(int(blocked[0]) - 1, 0)]) if len(blocked) else float(ahead_m)


def _paths(walkers: Sequence[Walker]) -> NDArray[np.float64]:
    """Predicted positions of the walkers [m]; shape (walkers, moments, 2)."""
    at = np.array([walker.person.xy for walker in walkers])
    velocity = np.array([walker.velocity for walker in walkers])
    return np.asarray(at[:, None] + MOMENTS[:, None] * velocity[:, None])


def _points(route: Route, marks: NDArray[np.float64]) -> Points:
    return np.array([route.at(mark) for mark in marks.tolist()])
