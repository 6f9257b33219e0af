"""The choice of a pose next to a person: the target pose if it is free, else the most desirable free one."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

from comity_fis.defuzzification.curve import Curve
from comity_fis.defuzzification.moved_curve import upper_limit
from comity_fis.errors import WrongValueError
from comity_fis.proxemics import FRONT_DEG, PERSON_MARGIN_M, WIDEST_DEG
from comity_sim2d.kinds import require_kinds, wrong
from comity_sim2d.navigation.docking import (
    BEARING_STEP_DEG,
    DockingPose,
    pose_blocker,
    spot_pose,
    spots_beside,
)
from comity_sim2d.navigation.route_map import RouteMap
from comity_sim2d.pose import XY
from comity_sim2d.scene_error import is_near, require_finite, require_points, require_text, shown

DISTANCE_STEP_M = 0.05
WISHES_KEPT = 64
"""Number of wishes whose candidates are cached: they recur in every search for a pose."""


@dataclass(frozen=True, slots=True)
class Wish:
    """The target pose, and the desirability of others."""

    person: str
    distance_m: float
    bearing_deg: float
    distance_desirability: Curve
    direction_desirability: Curve
    """Curve over the unsigned bearing [deg]; a `MovedCurve` carries the limits of the pose."""

    def __post_init__(self) -> None:
        require_text("wish", "person", self.person)
        for field in ("distance_desirability", "direction_desirability"):
            curve = getattr(self, field)
            if isinstance(curve, type) or not (callable(curve) and hasattr(curve, "domain")):
                raise wrong(
                    "wish", field, f"{field} as a Curve", curve, "Take the desirability of a placement."
                )
        if not (is_near(self.bearing_deg) and abs(self.bearing_deg) <= WIDEST_DEG):
            got, remedy = shown(self.bearing_deg), "Choose a bearing before the person's shoulders."
            raise WrongValueError(expected="bearing_deg in [-90, 90]", got=got, remedy=remedy)
        if not (is_near(self.distance_m) and self.distance_m >= PERSON_MARGIN_M - 1e-9):
            got, remedy = shown(self.distance_m), "Choose a distance in metres, so far or farther."
            raise WrongValueError(expected=f"distance_m of {PERSON_MARGIN_M} or more", got=got, remedy=remedy)

    def score(self, distance_m: float, bearing_deg: float) -> float:
        """The desirability of a pose: the minimum of those of its distance and its direction, in [0, 1]."""
        return min(self._towards(bearing_deg), self._apart(distance_m))

    def _towards(self, bearing_deg: float) -> float:
        return self.direction_desirability(abs(bearing_deg))

    def _apart(self, distance_m: float) -> float:
        return 1.0 if self.keeps_distance else self.distance_desirability(distance_m)

    @property
    def widest_deg(self) -> float:
        """Maximum unsigned bearing of alternative poses [deg]."""
        return upper_limit(self.direction_desirability, WIDEST_DEG)

    @property
    def keeps_distance(self) -> bool:
        """Whether the person asked for this distance: the curve does not know it, so it is not traded off."""
        return self.distance_desirability(self.distance_m) <= 0.0

    @lru_cache(maxsize=WISHES_KEPT)  # noqa: B019 - it keeps so many small values
    def candidates(self) -> tuple[tuple[float, float], ...]:
        """Candidate distances and bearings: most desirable first, among equals nearest to the target.

        Unsuitable distances come last, nearest to the target first.

        The smaller desirability decides, and among equals the larger one. So no pose is chosen if a free one
        is better in one respect and no worse in the other (leximin: Dubois, Fargier, Prade, "Refinements of
        the maximin approach to decision-making in a fuzzy environment", Fuzzy Sets and Systems 81, 1996).
        """
        steps = int(self.widest_deg / BEARING_STEP_DEG)
        bearings = {self.bearing_deg, *(k * BEARING_STEP_DEG for k in range(-steps, steps + 1))}
        # Each curve is evaluated once per value, not once per pair.
        towards = {b: self._towards(b) for b in bearings}
        apart = {d: self._apart(d) for d in self._distances()}
        pairs = [(d, b) for d in apart for b in bearings if (d, b) != (self.distance_m, self.bearing_deg)]
        # Rounded, so that values that differ only by rounding errors count as equal; left before right.
        aside = {b: round(abs(b - self.bearing_deg), 9) for b in bearings}
        away = {d: round(abs(d - self.distance_m), 9) for d in apart}
        unsuited = {d: d != self.distance_m and round(apart[d], 9) <= 0.0 for d in apart}

        def rank(pair: tuple[float, float]) -> tuple[float, ...]:
            d, b = pair
            less, more = sorted((round(towards[b], 9), round(apart[d], 9)))
            nearest = away[d] if unsuited[d] else 0.0
            return (-less, unsuited[d], nearest, -more, aside[b], away[d], -b, d)

        return tuple(sorted(pairs, key=rank))

    def _distances(self) -> list[float]:
        if self.keeps_distance:
            return [self.distance_m]
        low, high = self.distance_desirability.domain
        low = max(low, PERSON_MARGIN_M)
        first = math.ceil(low / DISTANCE_STEP_M - 1e-9)
        last = math.floor(high / DISTANCE_STEP_M + 1e-9)
        steps = [round(k * DISTANCE_STEP_M, 9) for k in range(first, last + 1)]
        # An unsuitable distance is kept as the last resort: whom the robot can serve must not depend on
        # taste.
        return [self.distance_m, low, *steps]


def choose_pose(route_map: RouteMap, start: XY, wish: Wish) -> DockingPose | None:
    """The target pose if it is free and reachable, else the most desirable pose that is.

    Returns:
        None if no pose within 90 degrees of the person's front, or within the limits of the wish, is free and
        reachable.
    """
    require_kinds("choice of a pose", route_map=(route_map, RouteMap), wish=(wish, Wish))
    require_points("choice of a pose", "start", (start,))
    place = route_map.surroundings
    obstacle = _obstacle(route_map, start, wish)
    if obstacle is None:
        return DockingPose(wish.distance_m, wish.bearing_deg)
    candidates = wish.candidates()
    goals = spots_beside(place.person(wish.person), place.robot_radius_m, candidates)
    may_do = route_map.may_reach(start, goals)
    if may_do.any():
        may_do &= place.are_free(goals, visited=wish.person)
    for (distance, bearing), goal, may in zip(candidates, goals, may_do.tolist(), strict=True):
        if may and route_map.reaches(start, goal):
            reason = _deviation(wish, obstacle, distance, bearing)
            return DockingPose(distance, bearing, pose_free=False, deviation_reason=reason)
    return None


def side_name(bearing_deg: float) -> str:
    """`front`, `left` or `right`, as the person sees it."""
    require_finite("side", bearing_deg=bearing_deg)
    if abs(bearing_deg) <= FRONT_DEG:
        return "front"
    return "left" if bearing_deg > 0.0 else "right"


def _obstacle(route_map: RouteMap, start: XY, wish: Wish) -> str | None:
    """Why the target pose is not available, as the end of a sentence."""
    place = route_map.surroundings
    blocker = pose_blocker(place, wish.person, wish.distance_m, wish.bearing_deg)
    if blocker is not None:
        return f"is blocked by {blocker}"
    goal = spot_pose(place, wish.person, wish.distance_m, wish.bearing_deg).xy
    return None if route_map.reaches(start, goal) else "cannot be reached"


def _deviation(wish: Wish, obstacle: str, distance_m: float, bearing_deg: float) -> str:
    """What blocked the target pose, and how the chosen one differs from it, in words."""
    wanted = f"{side_name(wish.bearing_deg)} ({_angle(wish.bearing_deg)}) at {wish.distance_m:.3f} m"
    turned = round(bearing_deg - wish.bearing_deg, 6)
    side = "left" if turned > 0.0 else "right"
    where = f"{_angle(turned)} farther to the person's {side}" if turned else "on the same side"
    at = "at the same distance" if distance_m == wish.distance_m else f"at {distance_m:.3f} m"
    return f"{wanted} {obstacle}; the best free pose is {where}, {at}"


def _angle(angle_deg: float) -> str:
    """The unsigned angle in words, in whole degrees unless it is smaller."""
    size = abs(angle_deg)
    return f"{size:.0f} deg" if size >= 1.0 or not size else f"{size:.1f} deg"
