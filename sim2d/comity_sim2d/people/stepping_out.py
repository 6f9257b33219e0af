"""Stepping out of the way: who is asked to let the robot pass goes where it gets by, and on when it has."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from comity_sim2d.people.social_force import Numbers
from comity_sim2d.pose import XY
from comity_sim2d.scene.footpath import Disc, Footpaths
from comity_sim2d.scene.obstacles import PERSON_MARGIN_M, FloorPlan
from comity_sim2d.scene.robot_reaction import RobotReaction, RobotSeen

STAYS: frozenset[RobotReaction] = frozenset({"impassive", "threatening"})
"""Who does not: nobody makes way for a thing, nor whoever means to stand in its way (our choice)."""
HEARD_M = 3.0
"""So near the robot, between the centres, they hear it (our choice: across a room, over other noise)."""
SPARE_M = 0.1
"""So much farther beside its way than it keeps from people they go (our choice)."""
THINGS_M, PAST_M = 0.05, 0.08
"""So far they keep from things, and from the robot when they go past it."""
FARTHEST_M, STEP_M, AROUND = 4.0, 0.2, 32
"""Places up to so far away are looked at, in rings so far apart and in so many directions."""
MOST_WAYS = 8
"""To so many of the nearest a way on foot is looked for; the shortest is taken."""
WAITS_S = 20.0
"""They wait for the robot no longer (our choice)."""
BEND_M = 0.3
"""Who is so near a bend of the way takes the next."""
REACHES_M, GONE_M = 0.9, 1.5
"""The robot has gone past where they stood when it was nearer than the first and is beyond the second."""


@dataclass(slots=True)
class SteppingOut:
    """Somebody on the way to a place beside the robot's way, or there."""

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
    """
    free = _free_places(at, radius_m, others, plan)
    places = _beside(free, way, robot[2] + radius_m + PERSON_MARGIN_M + SPARE_M)
    behind = [xy for xy in places if _is_farther(at, xy, robot)]
    thing = (robot[0], robot[1], robot[2] + PAST_M)
    for some in (behind, places):
        ways = (paths.past(thing, at, xy) for xy in some[:MOST_WAYS])
        best = min((found for found in ways if found), key=lambda found: _length(at, found), default=None)
        if best is not None:
            return best
    return None


def _free_places(at: XY, radius_m: float, others: Iterable[Disc], plan: FloorPlan) -> Numbers:
    """Where there is room around somebody, the nearest first; shape (n, 2)."""
    away_m = np.repeat(np.arange(STEP_M, FARTHEST_M + STEP_M / 2, STEP_M), AROUND)
    angles = np.tile(np.arange(AROUND) * (math.tau / AROUND), len(away_m) // AROUND)
    places = np.array(at) + away_m[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])
    free = plan.are_free(places, radius_m + THINGS_M)
    for x, y, other_m in others:
        free &= np.hypot(*(places - (x, y)).T) >= other_m + radius_m + SPARE_M
    return np.asarray(places[free])


def _beside(places: Numbers, way: Sequence[XY], least_m: float) -> list[XY]:
    """Those of some places that are so far from a way."""
    from shapely import LineString, distance, points

    line = LineString(way if len(way) > 1 else [*way, *way])
    off = distance(line, points(places)) >= least_m
    return [(float(x), float(y)) for x, y in places[off]]


def _is_farther(at: XY, xy: XY, robot: Disc) -> bool:
    """Whether a place is not on the robot's side of where they stand."""
    return (xy[0] - at[0]) * (robot[0] - at[0]) + (xy[1] - at[1]) * (robot[1] - at[1]) <= 0.0


def _length(at: XY, way: Sequence[XY]) -> float:
    return sum(math.dist(one, other) for one, other in zip((at, *way), way, strict=False))
