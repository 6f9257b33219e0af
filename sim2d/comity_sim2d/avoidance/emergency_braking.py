"""Emergency braking before obstacles and passers-by, however the robot came so near.

Routes keep clear of walls and furniture, so a robot on its route never needs emergency braking. But a robot
leaves its route when a rule for people moves it sideways, or when it cannot move sideways and turns while
braking. And passers-by may stop or step in front of it.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from comity_sim2d.base.base import Base, VelocityCommand
from comity_sim2d.base.drive import hardest_braking
from comity_sim2d.pose import XY, direction_to, wrap_angle
from comity_sim2d.scene.obstacles import FloorPlan
from comity_sim2d.scene.robot_body import RobotBody

SPARE_M = 0.75
"""Radius within which obstacle lines are cached [m]; the cache is renewed after this path length."""
NEARLY_M = 0.01
"""Target gap to obstacles at rest [m]: smaller than the clearance of any path off the route (our choice)."""

TURNS_S = 0.5
"""Time for which a base then drives past the obstacle, and one that cannot move sideways only turns to its
goal [s] (our choice). Otherwise it would creep up to the same obstacle, a tick and a brake at a time."""
AWAY = 0.1
"""Share of its speed directed away from the obstacle while it passes (our choice)."""

Numbers = NDArray[np.float64]
Vectors = NDArray[np.complex128]
Line = tuple[float, float, float, float, float]
"""Start x and y, vector from there to the end, and half the thickness [m]."""


class EmergencyBraking:
    """Emergency braking of one robot before static obstacles and passers-by.

    Args:
        spec: The robot's body.
    """

    def __init__(self, spec: RobotBody) -> None:
        self._radius_m = spec.radius_m
        self._braking = hardest_braking(spec)
        self._plan: FloorPlan | None = None
        self._at: XY = (0.0, 0.0)
        self._within_m = 0.0
        self._lines: list[Line] = []
        """Lines of the floor plan within `SPARE_M` of the cached place."""
        self._clear_at: XY = (0.0, 0.0)
        self._clear_m = 0.0
        """Radius around the cached place that is free of lines [m]."""
        self._turns_s = 0.0
        self._towards: XY = (0.0, 0.0)
        """Unit vector from the obstacle that it last braked for."""

    def has_come(self, base: Base, plan: FloorPlan) -> bool:
        """Whether the robot must brake at full deceleration now to avoid a contact one tick later.

        It brakes on a straight line. Obstacles that it moves away from or along do not count, however near.
        """
        self._turns_s = max(0.0, self._turns_s - base.step_s)
        speed = base.speed_m_s
        if not speed:
            return False
        ahead_s = base.step_s + speed / (2.0 * self._braking)
        reach_m = self._radius_m + NEARLY_M
        xy, way = base.xy, (ahead_s * base.velocity[0], ahead_s * base.velocity[1])
        within_m = reach_m + ahead_s * speed
        if plan is self._plan and math.dist(xy, self._clear_at) + within_m <= self._clear_m:
            return False
        for here_m, line in self._near(xy, within_m, plan):
            if here_m < within_m and _from_way(xy, way, line, here_m) < min(reach_m, here_m):
                self._turns_s, self._towards = TURNS_S, _direction(xy, line)
                return True
        return False

    def has_come_before(self, base: Base, people: Vectors, reach_m: Numbers) -> bool:
        """The same for passers-by; one next to the path counts only if the path leads nearer to them.

        Args:
            base: Current pose and motion of the robot's base.
            people: Their centres [m], x + iy, shape (n,).
            reach_m: Sum of the robot's and each person's radius [m], shape (n,).
        """
        speed = base.speed_m_s
        if not speed:
            return False
        ahead_s = base.step_s + speed / (2.0 * self._braking)
        apart = people - complex(*base.xy)
        near = (np.abs(apart) - reach_m < NEARLY_M + ahead_s * speed).nonzero()[0]
        way = (ahead_s * base.velocity[0], ahead_s * base.velocity[1])
        for there, touching_m in zip(apart[near].tolist(), reach_m[near].tolist(), strict=True):
            xy = (there.real, there.imag)
            if _from_leg(xy, (0.0, 0.0), way) < min(touching_m + NEARLY_M, math.hypot(*xy)):
                return True
        return False

    def turned(self, base: Base, wanted: VelocityCommand, plan: FloorPlan) -> VelocityCommand:
        """The command for a base that has just braked for an obstacle, or would have to: drive past it.

        A base that cannot move sideways turns first, once at rest, if rolling would lead to the obstacle or
        it may not drive backwards.
        """
        if wanted.velocity == (0.0, 0.0):
            return wanted
        if not base.speed_m_s:
            self._look_ahead(base.xy, _roll(base, wanted), plan)
        if not self._turns_s:
            return wanted
        wanted = wanted._replace(velocity=self._past(wanted.velocity))
        if base.speed_m_s or not base.turns_to_go:
            return wanted
        roll, heading = _roll(base, wanted), direction_to((0.0, 0.0), wanted.velocity)
        if wanted.may_reverse:
            if roll[0] * self._towards[0] + roll[1] * self._towards[1] <= 0.0:
                return wanted
            if abs(wrap_angle(heading - base.pose.heading_rad)) > math.pi / 2.0:
                heading = wrap_angle(heading + math.pi)
        return wanted._replace(velocity=(0.0, 0.0), heading_rad=heading)

    def _look_ahead(self, xy: XY, roll: XY, plan: FloorPlan) -> None:
        """Note an obstacle for which a base at rest would have to brake once it had set out."""
        reach_m = self._radius_m + NEARLY_M
        if plan is self._plan and math.dist(xy, self._clear_at) + reach_m <= self._clear_m:
            return
        way = (NEARLY_M * roll[0], NEARLY_M * roll[1])
        for here_m, line in self._near(xy, reach_m, plan):
            if here_m < reach_m and _from_way(xy, way, line, here_m) < here_m:
                self._turns_s, self._towards = TURNS_S, _direction(xy, line)

    def _past(self, velocity: XY) -> XY:
        """The velocity without its component towards the obstacle, plus a little away from it."""
        ux, uy = self._towards
        closing = velocity[0] * ux + velocity[1] * uy + AWAY * math.hypot(*velocity)
        if closing <= 0.0:
            return velocity
        return velocity[0] - closing * ux, velocity[1] - closing * uy

    def _near(self, xy: XY, within_m: float, plan: FloorPlan) -> list[tuple[float, Line]]:
        """All lines within a distance of a point (possibly some more), with their distances [m]."""
        if plan is not self._plan or math.dist(xy, self._at) + within_m > self._within_m:
            self._plan, self._at, self._within_m = plan, xy, within_m + SPARE_M
            self._lines = _lines_near(plan, xy, self._within_m)
        near = [(_from_line(xy, line), line) for line in self._lines]
        others_m = self._within_m - math.dist(xy, self._at)
        self._clear_at, self._clear_m = xy, min((others_m, *(here_m for here_m, _ in near)))
        return near


def _roll(base: Base, wanted: VelocityCommand) -> XY:
    """The direction in which a base at rest sets out, of length 1 at most; (0, 0): it turns first."""
    course = direction_to((0.0, 0.0), wanted.velocity)
    if not base.turns_to_go:
        return math.cos(course), math.sin(course)
    heading = base.pose.heading_rad
    ahead = math.cos(course - heading)
    if not wanted.may_reverse:
        ahead = max(ahead, 0.0)
    return ahead * math.cos(heading), ahead * math.sin(heading)


def _lines_near(plan: FloorPlan, xy: XY, within_m: float) -> list[Line]:
    start, half_m = plan.segments.ends[:, 0], plan.segments.half_m
    along = plan.segments.ends[:, 1] - start
    square = np.maximum((along**2).sum(axis=1), 1e-12)
    apart = np.array(xy) - start
    share = np.clip((apart * along).sum(axis=1) / square, 0.0, 1.0)
    gap_m = np.hypot(*(apart - share[:, None] * along).T) - half_m
    lines = np.column_stack([start, along, half_m])[gap_m <= within_m]
    return [(x, y, dx, dy, half) for x, y, dx, dy, half in lines.tolist()]


def _from_line(xy: XY, line: Line) -> float:
    """Distance from a point to the surface of a line [m]."""
    x, y, dx, dy, half_m = line
    return _from_leg(xy, (x, y), (dx, dy)) - half_m


def _direction(xy: XY, line: Line) -> XY:
    """Unit vector from a point to the nearest point of a line."""
    x, y, dx, dy, _ = line
    square = dx * dx + dy * dy
    share = min(1.0, max(0.0, ((xy[0] - x) * dx + (xy[1] - y) * dy) / square)) if square else 0.0
    way_x, way_y = x + share * dx - xy[0], y + share * dy - xy[1]
    length = math.hypot(way_x, way_y)
    return (way_x / length, way_y / length) if length else (0.0, 0.0)


def _from_way(xy: XY, way: XY, line: Line, here_m: float) -> float:
    """Distance from a straight path, which begins `here_m` from the line, to the line's surface [m]."""
    x, y, dx, dy, half_m = line
    ahead = (xy[0] + way[0], xy[1] + way[1])
    if _crosses(xy, ahead, (x, y), (dx, dy)) and _crosses((x, y), (x + dx, y + dy), xy, way):
        return -half_m
    of_ends = min(_from_leg((x, y), xy, way), _from_leg((x + dx, y + dy), xy, way)) - half_m
    return min(here_m, _from_line(ahead, line), of_ends)


def _from_leg(xy: XY, start: XY, way: XY) -> float:
    """Distance from a point to a straight segment without thickness [m]."""
    px, py, (dx, dy) = xy[0] - start[0], xy[1] - start[1], way
    square = dx * dx + dy * dy
    share = min(1.0, max(0.0, (px * dx + py * dy) / square)) if square else 0.0
    return math.hypot(px - share * dx, py - share * dy)


def _crosses(one: XY, other: XY, start: XY, way: XY) -> bool:
    """Whether two points are on different sides of an infinite line."""
    sides = [way[0] * (y - start[1]) - way[1] * (x - start[0]) for x, y in (one, other)]
    return sides[0] * sides[1] < 0.0
