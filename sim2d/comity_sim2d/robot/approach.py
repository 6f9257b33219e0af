"""One approach: along a route to a docking pose next to a person, onto it, and with it as it moves."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from comity_sim2d.base.base import Base
from comity_sim2d.base.drive import BEND_SHARE, SPEED_SHARE, limit_speed, stopping_speed
from comity_sim2d.navigation.docking import DockingPose
from comity_sim2d.navigation.route import Route
from comity_sim2d.navigation.route_map import WORTH_M, RouteMap
from comity_sim2d.navigation.yielding import Walker, giving_way
from comity_sim2d.pose import XY

REPLAN_M, REPLAN_SHARE = 0.05, 0.05
"""A goal needs a new route when it is farther from the route's end than `REPLAN_M` [m] and than
`REPLAN_SHARE` of the remaining path: the direction then changes by at most 3 degrees (our choice)."""
JOLT_M_S = 0.1
"""A new route that would change the velocity by more than this [m/s] is taken only after slowing down."""
LOOKAHEAD_M = 0.3
"""Length of the route ahead that is searched for the robot's position [m]: a tick moves it 4 cm."""
OFF_M = 0.1
"""Distance from its route at which the robot replans [m] (our choice): in shipped episodes it stayed within
half of that in 99.6 % of the ticks."""
FOLLOWS_S = 0.5
"""Minimum time between new routes to a moving goal [s]."""
SLOWING_S = 0.25
"""Maximum time between searches for the best route while the robot slows down for another one [s]."""
WAVERS_S, MAY_WAVER, MOST_WAVERS = 10.0, 2.0, 7.0
"""A reversal is forgotten after `WAVERS_S` [s]. Each one beyond `MAY_WAVER` doubles the advantage that
another route needs, up to `MOST_WAVERS` reversals or 16 m. Otherwise the robot would turn to and fro with
people who walk to and fro (our choice)."""
BACK_COS = 0.5
"""A new route whose direction differs by more than this (60 deg) is a reversal."""
AIM_M = 0.02
"""Minimum look-ahead on the route [m]: a slow robot next to a body moves along its route, not towards it."""
BESIDE, MOST_AIM_M = 3.0, 0.2
"""Off its route the look-ahead is multiplied by `BESIDE`, up to `MOST_AIM_M` [m]: a robot kept off its route
by a body moves along it, and does not push towards it (our choice)."""
CUT_M = 0.02
"""Maximum distance by which a base with slow dynamics cuts a bend [m]: less than half of the route's
clearance from walls (our choice)."""
REVERSE_M = 0.5
STAYS_M, SIDEWAYS_COS = 0.1, 0.8
"""Accepted lateral error to a standing goal [m], unless the robot is also too near or too far and not docked.
To correct it, the robot would turn away from the person, again and again (our choice)."""
NO_PROGRESS_S = 3.0
PROGRESS_M = 0.01
AT_PLACE = DockingPose(0.0, 0.0)
"""Stands for the pose next to a person when the robot goes to a place."""


class MovingTarget(NamedTuple):
    """Target position of the robot's centre, and its velocity."""

    xy: XY
    velocity: XY


class Approach:
    """The state of one approach: its route and progress."""

    def __init__(
        self, person: str, pose: DockingPose, speed_m_s: float, *, since_s: float = 0.0, settled: bool = False
    ) -> None:
        self.person = person
        self.pose = pose
        self.speed_m_s = speed_m_s
        self.remaining_m = math.inf
        """Length of the remaining path [m]; infinite if there is no route."""
        self.gives_way_to: str | None = None
        """The person it lets pass now."""
        self._route: Route | None = None
        self._way_m = 0.0
        self._map: RouteMap | None = None
        """The map with which the route was planned."""
        self._goal: XY | None = None
        self._slowing = False
        self.settled = settled
        """Whether a base that cannot move sideways accepts its position."""
        self._holds = settled
        """Whether its goal is to hold the docking pose, and it has accepted its position since."""
        self._ticks_old, self._cost = 0, 0.0
        self._wavers = 0.0
        """Number of recent reversals."""
        self._best_m, self._best_s = math.inf, since_s
        """Shortest remaining path so far [m], infinite if unknown, and its time [s]."""

    def told(self, pose: DockingPose, speed_m_s: float, *, since_s: float | None) -> Approach:
        """The approach with updated parameters.

        Args:
            pose: The new docking pose.
            speed_m_s: The new speed [m/s].
            since_s: Start of the progress watch [s]; None: unchanged, as new parameters free no blocked
                robot.
        """
        if pose == self.pose:
            self.speed_m_s = speed_m_s
            return self
        return Approach(self.person, pose, speed_m_s, since_s=self._best_s if since_s is None else since_s)

    @property
    def has_route(self) -> bool:
        """Whether there is a route to the pose."""
        return self._route is not None

    def steer(
        self, base: Base, goal: MovingTarget, route_map: RouteMap, walkers: Sequence[Walker] = ()
    ) -> XY:
        """The velocity command for the next tick, before the general limits [m/s]."""
        self._wavers = max(0.0, self._wavers - base.step_s / WAVERS_S)
        nearest_m = self._nearest_m(base)
        if self._is_stale(base, goal, route_map, nearest_m):
            self._replan(base, goal, route_map)
            nearest_m = self._nearest_m(base)
        self.gives_way_to = None
        if self._route is None:
            self.remaining_m = math.inf
            return (0.0, 0.0)
        if self._way_m < self._route.last_leg_m:
            self._way_m = nearest_m
        on_last_leg = self._is_on_last_leg
        self.settled = self.settled and on_last_leg and not self._slowing
        self.remaining_m = math.dist(base.xy, goal.xy) if on_last_leg else self._route.length_m - self._way_m
        if self._slowing:
            return _slower(base) if on_last_leg else self._follow(base, self._route, 0.0)
        most = self._speed_past(base, self._route, walkers, route_map.surroundings.robot_radius_m)
        return self._home_in(base, goal, most) if on_last_leg else self._follow(base, self._route, most)

    @property
    def may_reverse(self) -> bool:
        """Whether the goal is so near that driving backwards beats turning round."""
        return self.remaining_m < REVERSE_M

    def leads_to(self, goal: XY, route_map: RouteMap) -> bool:
        """Whether the current route leads to a goal, and is as good as when it was planned."""
        route = self._route
        if route is None or self._slowing or math.dist(route.goal, goal) > self._astray_m:
            return False
        return not route_map.is_worse(route, self._gone_m, self._cost, keep=self.keep, by_m=self._by_m)

    def _speed_past(self, base: Base, route: Route, walkers: Sequence[Walker], radius_m: float) -> float:
        """The speed at which the robot can still brake for people who cross its path."""
        if not walkers:
            return self.speed_m_s
        way_m = min(self._way_m, max(0.0, route.length_m - self.remaining_m))
        giving = giving_way(route, way_m, base.speed_m_s, walkers, radius_m)
        if giving is None:
            return self.speed_m_s
        self.gives_way_to = giving.person
        return min(
            self.speed_m_s, stopping_speed(giving.free_m, SPEED_SHARE * base.acceleration_m_s2, base.step_s)
        )

    def stalled(self, now_s: float, left: float) -> bool:
        """Whether the remaining path has not become shorter for `NO_PROGRESS_S`."""
        if math.isinf(self._best_m):
            self._best_m = left
        elif left < self._best_m - PROGRESS_M:
            self._best_m, self._best_s = left, now_s
        return now_s - self._best_s > NO_PROGRESS_S

    def restart_watch(self, now_s: float) -> None:
        """Count progress from here."""
        self._best_m, self._best_s = math.inf, now_s

    def forget_route(self) -> None:
        """Replan at the next tick: the robot has left its route, or the constraints have changed."""
        self._goal = None

    def _nearest_m(self, base: Base) -> float:
        """Path length at the nearest point of the route ahead [m]; 0 without a route."""
        if self._route is None:
            return 0.0
        ahead_m = self._route.length_m if self._is_on_last_leg else self._way_m + LOOKAHEAD_M
        return self._route.nearest(base.xy, self._way_m, ahead_m)

    def _is_stale(self, base: Base, goal: MovingTarget, route_map: RouteMap, nearest_m: float) -> bool:
        """Whether a new route is needed, for reasons other than the person's own movement."""
        self._ticks_old += 1
        age_s = self._ticks_old * base.step_s
        if self._slowing:
            return base.speed_m_s <= JOLT_M_S or age_s >= SLOWING_S
        if self._goal is None or self._is_off(base, nearest_m):
            return True
        if math.dist(self._goal, goal.xy) > self._astray_m and age_s >= FOLLOWS_S:
            return True
        if route_map is self._map:
            return False
        before, self._map = self._map, route_map
        if before is None or route_map.surroundings.plan is not before.surroundings.plan:
            return True
        return self._route is None or self._should_leave(self._route, route_map)

    def _is_off(self, base: Base, nearest_m: float) -> bool:
        """Whether the robot left its route, for example to step aside: a wall may be in between."""
        return self._route is not None and math.dist(base.xy, self._route.at(nearest_m)) > OFF_M

    def _should_leave(self, route: Route, route_map: RouteMap) -> bool:
        """Whether people moved so that the route is blocked or much worse now, or another one much better."""
        if route_map.is_worse(route, self._gone_m, self._cost, keep=self.keep, by_m=self._by_m):
            return True
        return route_map.has_better(route, self._gone_m, keep=self.keep, by_m=self._by_m)

    @property
    def _astray_m(self) -> float:
        """Maximum distance of a route's end from its goal [m]."""
        return REPLAN_M if self._route is None else max(REPLAN_M, REPLAN_SHARE * self.remaining_m)

    @property
    def _by_m(self) -> float:
        """Cost difference at which the route is given up [m]."""
        return WORTH_M * math.pow(2.0, max(0.0, self._wavers - MAY_WAVER))

    @property
    def keep(self) -> dict[str, float]:
        """Distances that its routes keep from the visited person, by name [m]."""
        return {self.person: self.pose.distance_m}

    def _replan(self, base: Base, goal: MovingTarget, route_map: RouteMap) -> None:
        """Take a new route; if it leaves in another direction, first slow down on the old one."""
        route = route_map.route(base.xy, goal.xy, keep=self.keep)
        self._goal, self._map, self._ticks_old = goal.xy, route_map, 0
        self._cost = 0.0 if route is None else route_map.discomfort_ahead(route, 0.0, keep=self.keep)
        if route is not None and not self._goes_on_to(route) and _jolt(base, route, goal) > JOLT_M_S:
            self._slowing = True
            self._route = self._route or route
            return
        if route is not None and self._route is not None:
            self._best_m += self._longer_m(self._route, route, base.xy)
            if _cos(self._route.direction(self._way_m), route.direction(0.0)) < BACK_COS:
                self._wavers = min(self._wavers + 1.0, MOST_WAVERS)
        self._route, self._way_m, self._slowing = route, 0.0, False

    @property
    def _is_on_last_leg(self) -> bool:
        return self._route is not None and self._way_m >= self._route.last_leg_m - 1e-9

    @property
    def _gone_m(self) -> float:
        """Path length behind the robot [m]; on the last leg it heads straight for the goal."""
        if self._route is None or not self._is_on_last_leg:
            return self._way_m
        return max(self._way_m, self._route.length_m - self.remaining_m)

    def _goes_on_to(self, route: Route) -> bool:
        """Whether it heads straight for its goal anyway, so that a new route does not turn it."""
        return self._is_on_last_leg and len(route.points) == 2

    def _longer_m(self, old: Route, new: Route, xy: XY) -> float:
        """How much longer a new path is because of obstacles, not because the goal moved away [m]."""
        ahead_m = old.length_m if self._is_on_last_leg else self._way_m + LOOKAHEAD_M
        left_m = old.length_m - old.nearest(xy, self._way_m, ahead_m)
        return new.length_m - left_m - (math.dist(xy, new.goal) - math.dist(xy, old.goal))

    def _follow(self, base: Base, route: Route, most: float) -> XY:
        """The velocity towards the point of the route one tick ahead, or a little farther [m/s]."""
        a, dt, (x, y) = base.acceleration_m_s2, base.step_s, base.xy
        speed = base.speed_m_s
        turning = min(BEND_SHARE * a, base.cutting_m_s2(CUT_M))
        bend = route.bend_limit(self._way_m + speed * dt, turning, SPEED_SHARE * a)
        end = stopping_speed(self.remaining_m, SPEED_SHARE * a, dt)
        wanted = min(most, bend, end)
        speed = min(max(wanted, speed - SPEED_SHARE * a * dt), speed + SPEED_SHARE * a * dt)
        beside_m = math.dist((x, y), route.at(self._way_m))
        aim_m = max(AIM_M, min(BESIDE * beside_m, MOST_AIM_M))
        target = route.at(self._way_m + max(speed * dt, aim_m, base.lookahead_m))
        gap = math.dist((x, y), target)
        share = speed / gap if gap > 0.0 else 0.0
        return ((target[0] - x) * share, (target[1] - y) * share)

    def _home_in(self, base: Base, goal: MovingTarget, most: float) -> XY:
        """The velocity straight to the goal, at rest relative to it on arrival [m/s].

        If it is too fast, it slows down along its path. As long as the robot moves, the command has a
        direction: a base that cannot move sideways would otherwise drift while it brakes.
        """
        a, dt, (x, y) = base.acceleration_m_s2, base.step_s, base.xy
        ex, ey = goal.xy[0] - x, goal.xy[1] - y
        gap = math.hypot(ex, ey)
        self.settled = gap <= (self._leaves_at_m(base, goal) if self.settled else base.settle_m)
        self._holds = self._holds and self.settled
        now, faster = math.dist(base.velocity, goal.velocity), SPEED_SHARE * a * dt
        slower = faster if base.turns_to_go else a * dt
        stopping = stopping_speed(gap, SPEED_SHARE * a, dt)
        if self.settled and math.hypot(*goal.velocity) >= base.follows_m_s:
            return goal.velocity
        if self.settled:
            return limit_speed(base.velocity, max(0.0, min(base.speed_m_s - faster, stopping)))
        speed = min(max(most, now - slower), stopping, now + faster)
        share = speed / gap if gap > 0.0 else 0.0
        velocity = (ex * share + goal.velocity[0], ey * share + goal.velocity[1])
        if most < self.speed_m_s:  # a robot that lets others pass follows neither the goal nor its noise
            return limit_speed(velocity, max(most, base.speed_m_s - slower))
        return velocity

    def _leaves_at_m(self, base: Base, goal: MovingTarget) -> float:
        """Distance to its goal at which a settled base moves again [m]."""
        least_m, heading = base.leaves_m, base.pose.heading_rad
        if not base.turns_to_go or math.hypot(*goal.velocity) >= base.follows_m_s:
            return least_m
        ex, ey = goal.xy[0] - base.xy[0], goal.xy[1] - base.xy[1]
        along = abs(ex * math.cos(heading) + ey * math.sin(heading))
        goes = along > (SIDEWAYS_COS * math.hypot(ex, ey) if self._holds else least_m)
        return least_m if goes else max(least_m, STAYS_M)


def _slower(base: Base) -> XY:
    """The velocity after one tick of braking, which keeps its direction [m/s]."""
    return limit_speed(base.velocity, max(0.0, base.speed_m_s - base.acceleration_m_s2 * base.step_s))


def _jolt(base: Base, route: Route, goal: MovingTarget) -> float:
    """The part of the velocity off a new route [m/s], over the ground or relative to the visited person."""
    (vx, vy), (gx, gy) = base.velocity, goal.velocity
    direction = route.direction(0.0)
    return min(_across((vx, vy), direction), _across((vx - gx, vy - gy), direction))


def _cos(one: XY, other: XY) -> float:
    """Cosine of the angle between two unit vectors."""
    return one[0] * other[0] + one[1] * other[1]


def _across(velocity: XY, direction: XY) -> float:
    along = max(0.0, velocity[0] * direction[0] + velocity[1] * direction[1])
    return math.dist(velocity, (along * direction[0], along * direction[1]))
