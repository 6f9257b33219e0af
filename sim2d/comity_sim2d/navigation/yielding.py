"""Giving way: how far the robot may go on before somebody who walks comes across or towards it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from comity_sim2d.navigation.route import Route
from comity_sim2d.paths.personal_space import Points
from comity_sim2d.pose import XY
from comity_sim2d.scene.obstacles import PERSON_MARGIN_M
from comity_sim2d.scene.person import Person

WALKS_M_S = 0.15
"""Slower is standing, and a noisy sensor."""
HORIZON_S = 4.0
MOMENTS = np.linspace(0.0, HORIZON_S, 17)
"""People are taken to walk on straight for so long."""
SLOWEST_M_S = 0.3
"""A robot that waits is taken to set out again at this speed."""
MARGIN_M = PERSON_MARGIN_M + 0.05
STEP_M = 0.10


@dataclass(frozen=True, slots=True)
class Walker:
    """Somebody on the way somewhere."""

    person: Person
    velocity: XY

    @property
    def walks(self) -> bool:
        """Or stands."""
        return is_walking(self.velocity)


def is_walking(velocity: XY) -> bool:
    """Whether somebody with this velocity is on the way somewhere."""
    return math.hypot(*velocity) > WALKS_M_S


@dataclass(frozen=True, slots=True)
class GivingWay:
    """Whom the robot lets pass, and how far it may go until then."""

    person: str
    free_m: float


def giving_way(
    route: Route, way_m: float, speed_m_s: float, walkers: Sequence[Walker], robot_radius_m: float
) -> GivingWay | None:
    """The nearest conflict ahead; None where nobody comes in the way.

    Args:
        route: The robot's.
        way_m: How far along it the robot is.
        speed_m_s: Its speed.
        walkers: Who may come in its way; whom it visits is not among them.
        robot_radius_m: Its radius.
    """
    marks = way_m + max(speed_m_s, SLOWEST_M_S) * MOMENTS
    robot = _points(route, marks)
    found = []
    for walker in walkers:
        if walker.walks and (conflict := _first_conflict(robot, walker, robot_radius_m)) is not None:
            ahead = marks[conflict] - way_m
            found.append(GivingWay(walker.person.name, _free_m(route, way_m, ahead, walker, robot_radius_m)))
    return min(found, key=lambda each: each.free_m, default=None)


def _first_conflict(robot: Points, walker: Walker, robot_radius_m: float) -> int | None:
    gaps = np.hypot(*(robot - _path(walker)).T) - walker.person.radius_m - robot_radius_m
    close = np.flatnonzero(gaps < MARGIN_M)
    if not len(close) or gaps[0] <= gaps.min() + 1e-9:  # nobody is given way to who only goes away
        return None
    return int(close[0])


def _free_m(route: Route, way_m: float, ahead_m: float, walker: Walker, robot_radius_m: float) -> float:
    """How far the robot can go and still be beside the walker's way."""
    steps = np.arange(0.0, ahead_m + STEP_M, STEP_M)
    apart = _points(route, way_m + steps)[:, None] - _path(walker)[None]
    gaps = np.hypot(apart[..., 0], apart[..., 1]).min(axis=1) - walker.person.radius_m - robot_radius_m
    blocked = np.flatnonzero(gaps < MARGIN_M)
    return float(steps[max(int(blocked[0]) - 1, 0)]) if len(blocked) else float(ahead_m)


def _path(walker: Walker) -> Points:
    return np.asarray(np.array(walker.person.xy) + MOMENTS[:, None] * np.array(walker.velocity))


def _points(route: Route, marks: np.ndarray) -> Points:
    return np.array([route.at(float(mark)) for mark in marks])
