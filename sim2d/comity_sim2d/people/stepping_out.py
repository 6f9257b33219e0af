"""Stepping out of the way: a person who is asked moves to let the robot pass, and goes on afterwards."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from comity_fis.proxemics import PERSON_MARGIN_M
from comity_sim2d.people.social_force import Numbers
from comity_sim2d.pose import XY
from comity_sim2d.scene.footpath import Disc, Footpaths
from comity_sim2d.scene.obstacles import FloorPlan
from comity_sim2d.scene.robot_reaction import RobotReaction, RobotSeen

STAYS: frozenset[RobotReaction] = frozenset({"impassive", "threatening"})
"""Reactions of people who do not make way: they take the robot for an object, or mean to block it (our
choice)."""
HEARD_M = 3.0
"""Distance between centres within which they hear the robot [m] (our choice: across a room, over other
noise)."""
SPARE_M = 0.1
"""Distance from the robot's path in addition to its margin from people [m] (our choice)."""
THINGS_M, PAST_M = 0.05, 0.08
"""Gaps kept from obstacles, and from the robot when walking past it [m]."""
FARTHEST_M, STEP_M, AROUND = 4.0, 0.2, 32
"""Candidate places: maximum distance [m], spacing of the rings [m], and number of directions."""
MOST_WAYS = 8
"""Number of nearest places for which a path on foot is searched; the shortest is taken."""
WAITS_S = 20.0
"""Maximum time that they wait for the robot [s] (our choice)."""
ASIDE_M, FINE_M = 1.0, 0.02
"""Maximum length of a step against the wall, and its resolution [m] (our choice)."""
ALONG_M = 0.1
"""Distance to either side over which the direction of the robot's path is measured [m]."""
LEAST_ASIDE_M = 0.1
"""Minimum gain in distance from the robot's path that counts as a step aside [m] (our choice)."""
BEND_M = 0.3
"""Distance from a bend at which the next leg begins [m]."""
REACHES_M, GONE_M = 0.9, 1.5
"""The robot has passed their place when it was nearer than `REACHES_M` and is now beyond `GONE_M` [m]."""


@dataclass(slots=True)
class SteppingOut:
    """A person on the way to a place off the robot's path, or already there."""

    stood: complex
    """Their position when asked [m]."""
    bends: list[complex]
    """Remaining points of the path, including its end."""
    left_s: float = WAITS_S
    came: bool = False
    """Whether the robot has reached the place where they stood."""

    def goal(self, at: complex) -> complex:
        """Next point of the path from `at`."""
        while len(self.bends) > 1 and abs(self.bends[0] - at) < BEND_M:
            self.bends.pop(0)
        return self.bends[0]

    def is_over(self, robot: RobotSeen, step_s: float) -> bool:
        """Whether the robot has passed, or took too long; call it once per step."""
        self.left_s -= step_s
        apart_m = abs(robot.at - self.stood)
        self.came = self.came or apart_m < REACHES_M
        return self.left_s <= 0.0 or (self.came and apart_m > GONE_M)


def way_out(
    at: XY,
    way: Sequence[XY],
    robot: Disc,
    *,
    radius_m: float,
    others: Iterable[Disc],
    plan: FloorPlan,
    paths: Footpaths,
    farthest_m: float = FARTHEST_M,
) -> list[XY] | None:
    """The shortest walk to a place where the robot can pass, or None nearby.

    Args:
        at: Position of the person [m].
        way: The robot's intended path.
        robot: The robot's body.
        radius_m: Radius of the person [m].
        others: All other people.
        plan: The static obstacles.
        paths: Footpaths for people of that radius.
        farthest_m: Maximum distance of the place from `at` [m].
    """
    free = _free_places(at, radius_m, others, plan, farthest_m)
    places = _beside(free, way, robot[2] + radius_m + PERSON_MARGIN_M + SPARE_M)
    behind = [xy for xy in places if _is_farther(at, xy, robot)]
    thing = (robot[0], robot[1], robot[2] + PAST_M)
    for some in (behind, places):
        ways = (paths.past(thing, at, xy) for xy in some[:MOST_WAYS])
        best = min((found for found in ways if found), key=lambda found: _length(at, found), default=None)
        if best is not None:
            return best
    return None


def against_the_wall(
    at: XY, way: Sequence[XY], *, radius_m: float, others: Iterable[Disc], plan: FloorPlan
) -> list[XY] | None:
    """A step straight away from the robot's path, as far as there is room, or None.

    Args:
        at: Position of the person [m].
        way: The robot's intended path.
        radius_m: Radius of the person [m].
        others: All other bodies, the robot's included.
        plan: The static obstacles.
    """
    from shapely import LineString, Point

    line = LineString(way if len(way) > 1 else [*way, *way])
    mark_m = line.project(Point(at))
    before = line.interpolate(max(mark_m - ALONG_M, 0.0))
    after = line.interpolate(min(mark_m + ALONG_M, line.length))
    along = math.atan2(after.y - before.y, after.x - before.x)
    away_m, bodies = np.arange(FINE_M, ASIDE_M + FINE_M / 2, FINE_M), list(others)
    found: list[tuple[float, XY]] = []
    for turn in (math.pi / 2.0, -math.pi / 2.0):
        places = np.array(at) + away_m[:, None] * (math.cos(along + turn), math.sin(along + turn))
        reached = int(np.logical_and.accumulate(_are_free(places, radius_m, bodies, plan)).sum())
        if reached:
            x, y = places[reached - 1].tolist()
            found.append((float(line.distance(Point(x, y))), (x, y)))
    farthest_m, place = max(found, default=(0.0, at))
    return [place] if farthest_m - float(line.distance(Point(at))) >= LEAST_ASIDE_M else None


def _free_places(
    at: XY, radius_m: float, others: Iterable[Disc], plan: FloorPlan, farthest_m: float
) -> Numbers:
    """Places with room for a person around them, nearest first [m]; shape (n, 2)."""
    away_m = np.repeat(np.arange(STEP_M, farthest_m + STEP_M / 2, STEP_M), AROUND)
    angles = np.tile(np.arange(AROUND) * (math.tau / AROUND), len(away_m) // AROUND)
    places = np.array(at) + away_m[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])
    return np.asarray(places[_are_free(places, radius_m, others, plan)])


def _are_free(places: Numbers, radius_m: float, others: Iterable[Disc], plan: FloorPlan) -> NDArray[np.bool_]:
    """Whether there is room for a person at each place of shape (n, 2); shape (n,)."""
    free = plan.are_free(places, radius_m + THINGS_M)
    for x, y, other_m in others:
        free &= np.hypot(*(places - (x, y)).T) >= other_m + radius_m + SPARE_M
    return np.asarray(free)


def _beside(places: Numbers, way: Sequence[XY], least_m: float) -> list[XY]:
    """The places at least a given distance from a path."""
    from shapely import LineString, distance, points

    line = LineString(way if len(way) > 1 else [*way, *way])
    off = distance(line, points(places)) >= least_m
    return [(float(x), float(y)) for x, y in places[off]]


def _is_farther(at: XY, xy: XY, robot: Disc) -> bool:
    """Whether a place is not on the robot's side of the person."""
    return (xy[0] - at[0]) * (robot[0] - at[0]) + (xy[1] - at[1]) * (robot[1] - at[1]) <= 0.0


def _length(at: XY, way: Sequence[XY]) -> float:
    return sum(math.dist(one, other) for one, other in zip((at, *way), way, strict=False))
