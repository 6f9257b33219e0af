"""Stepping out of the way: a person who is asked goes where the robot gets by, and on when it has."""

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
"""Reactions of people who do not make way: they take it for a thing, or mean to block it (our choice)."""
HEARD_M = 3.0
"""Distance within which they hear the robot, between the centres [m] (our choice: across a room, over other
noise)."""
SPARE_M = 0.1
"""Distance from its path in addition to its margin from people [m] (our choice)."""
THINGS_M, PAST_M = 0.05, 0.08
"""Gaps that they keep from things, and from the robot when they go past it [m]."""
FARTHEST_M, STEP_M, AROUND = 4.0, 0.2, 32
"""Candidate places: maximum distance [m], spacing of the rings [m], and number of directions."""
MOST_WAYS = 8
"""Number of nearest places for which a path on foot is searched; the shortest is taken."""
WAITS_S = 20.0
"""They wait for the robot no longer (our choice)."""
ASIDE_M, FINE_M = 1.0, 0.02
"""Distance of a step against the wall at most, and to which it is found [m] (our choice)."""
ALONG_M = 0.1
"""Distance to either side over which the direction of the robot's way is taken [m]."""
LEAST_ASIDE_M = 0.1
"""Farther from the robot's way by less is no step aside [m] (our choice)."""
BEND_M = 0.3
"""Distance from a bend at which the next leg begins [m]."""
REACHES_M, GONE_M = 0.9, 1.5
"""The robot has gone past their place when it was nearer than `REACHES_M` and is beyond `GONE_M`."""


@dataclass(slots=True)
class SteppingOut:
    """A person on the way to a place off the robot's path, or there."""

    stood: complex
    """Where they were asked."""
    bends: list[complex]
    """What is left of the way, with its end."""
    left_s: float = WAITS_S
    came: bool = False
    """Whether the robot has come to where they stood."""

    def goal(self, at: complex) -> complex:
        """Where to go from there."""
        while len(self.bends) > 1 and abs(self.bends[0] - at) < BEND_M:
            self.bends.pop(0)
        return self.bends[0]

    def is_over(self, robot: RobotSeen, step_s: float) -> bool:
        """Whether the robot is by, or took too long; to be asked once in every step."""
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
    """The shortest way on foot to a place where the robot gets by; None where there is none near.

    Args:
        at: Where they stand.
        way: Where the robot wants to go.
        robot: Where it stands.
        radius_m: Of theirs.
        others: All other people.
        plan: What stands still.
        paths: Ways of people of that size.
        farthest_m: Of the place, from where they stand.
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
    """A step straight away from the robot's way, as far as there is room; None where there is none.

    Args:
        at: Where the person stands.
        way: Where the robot wants to go.
        radius_m: Of the person.
        others: All other bodies, the robot's included.
        plan: What stands still.
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
    """Where there is room around a person, the nearest first; shape (n, 2)."""
    away_m = np.repeat(np.arange(STEP_M, farthest_m + STEP_M / 2, STEP_M), AROUND)
    angles = np.tile(np.arange(AROUND) * (math.tau / AROUND), len(away_m) // AROUND)
    places = np.array(at) + away_m[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])
    return np.asarray(places[_are_free(places, radius_m, others, plan)])


def _are_free(places: Numbers, radius_m: float, others: Iterable[Disc], plan: FloorPlan) -> NDArray[np.bool_]:
    """Whether there is room for a person at each of some places; shape (n, 2) to (n,)."""
    free = plan.are_free(places, radius_m + THINGS_M)
    for x, y, other_m in others:
        free &= np.hypot(*(places - (x, y)).T) >= other_m + radius_m + SPARE_M
    return np.asarray(free)


def _beside(places: Numbers, way: Sequence[XY], least_m: float) -> list[XY]:
    """The places at a minimum distance from a path."""
    from shapely import LineString, distance, points

    line = LineString(way if len(way) > 1 else [*way, *way])
    off = distance(line, points(places)) >= least_m
    return [(float(x), float(y)) for x, y in places[off]]


def _is_farther(at: XY, xy: XY, robot: Disc) -> bool:
    """Whether a place is not on the robot's side of where they stand."""
    return (xy[0] - at[0]) * (robot[0] - at[0]) + (xy[1] - at[1]) * (robot[1] - at[1]) <= 0.0


def _length(at: XY, way: Sequence[XY]) -> float:
    return sum(math.dist(one, other) for one, other in zip((at, *way), way, strict=False))
