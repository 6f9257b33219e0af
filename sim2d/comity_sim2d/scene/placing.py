"""Random starts and destinations of the passers-by of a scene."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from comity_sim2d.pose import XY
from comity_sim2d.scene.footpath import clear_pieces
from comity_sim2d.scene.obstacles import Blocker, floor_plan
from comity_sim2d.scene.passers_by import FASTEST_M_S, SLOWEST_M_S, PassersBy
from comity_sim2d.scene.scene import Scene
from comity_sim2d.scene.walk import SPEED_SPREAD_M_S
from comity_sim2d.scene_error import SceneError

if TYPE_CHECKING:
    from shapely import Polygon
    from shapely.geometry.base import BaseGeometry

APART_M = 0.10
"""Minimum gap between people's bodies at the start [m]; three times as much to the robot."""
DESTINATIONS = 4
"""Default number of places that a passer-by walks through before coming back to the start."""
SPREAD_M = 1.0
"""Maximum distance of passers-by's destinations from a given point [m], so that not all stand on it."""
TRIES = 400
ROUNDS = 100
"""Number of further batches of draws while no place was free: few points fall on a narrow lane in a large
place."""

Places = NDArray[np.complex128]
"""Positions in the plane, x + iy [m]."""


@dataclass(frozen=True, slots=True)
class Placed:
    """Start and destinations of one passer-by."""

    at: complex
    speed_m_s: float
    stops: tuple[complex, ...]


def place(scene: Scene, seed: int) -> tuple[Placed, ...]:
    """Place the passers-by of a scene, clear of all obstacles and people.

    Raises:
        SceneError: If there is no room for them, or a destination cannot be reached.
    """
    who, rng = scene.passers_by, np.random.Generator(np.random.PCG64([seed, 2]))
    if who is None:
        return ()
    floor = _Floor(scene, who, rng)
    starts = [floor.free_place() for _ in range(who.count)]
    speeds = rng.normal(who.speed_m_s, SPEED_SPREAD_M_S, who.count).clip(SLOWEST_M_S, FASTEST_M_S)
    return tuple(
        Placed(start, float(speed), floor.destinations(start))
        for start, speed in zip(starts, speeds, strict=True)
    )


class _Floor:
    """The free floor for the passers-by of a scene."""

    def __init__(self, scene: Scene, who: PassersBy, rng: np.random.Generator) -> None:
        plan, radius_m = floor_plan(scene), who.radius_m
        self._pieces = clear_pieces(plan, radius_m)
        self._between = who.between
        for point in who.between:
            self._check(point, plan.blocker(point, radius_m))
        free = _outside_groups(plan.clear_space(round(radius_m + APART_M, 6)), scene, radius_m + APART_M)
        # No one starts in a part of the floor without a path to the common destinations.
        self._free = self._joined(free, complex(*who.between[0])) if who.between else free
        self._radius_m, self._rng = radius_m, rng
        people, robot = scene.people, scene.robot
        self._taken = [complex(*person.xy) for person in people] + [complex(*robot.pose.xy)]
        self._reach = [person.radius_m + radius_m + APART_M for person in people]
        self._reach.append(robot.radius_m + radius_m + 3 * APART_M)
        self._others = len(self._taken)

    def free_place(self) -> complex:
        """A random place clear of all people placed so far; it is then taken."""
        taken, reach = np.array(self._taken), np.array(self._reach)
        for place in self._anywhere(TRIES, self._free):
            if np.all(np.abs(taken - place) >= reach):
                self._taken.append(complex(place))
                self._reach.append(2 * self._radius_m + APART_M)
                return complex(place)
        raise SceneError(
            entity="passers_by",
            field="count",
            expected="passers-by for whom there is room, drawn by the seed",
            got=f"no room after {len(self._taken) - self._others} of them",
            remedy="Take fewer, or a larger place.",
        )

    def destinations(self, start: complex) -> tuple[complex, ...]:
        """Destinations of a passer-by who starts there, in order."""
        between = self._between
        if not between:
            around = self._joined(self._free, start)
            return tuple(complex(place) for place in self._anywhere(DESTINATIONS, around))
        return tuple(self._near(complex(*between[i])) for i in self._rng.permutation(len(between)))

    def _check(self, point: XY, blocker: Blocker | None) -> None:
        """Reject a destination without room to stand, or without a path from the start."""
        first = self._between[0]
        if blocker is None and self._piece(complex(*point)) is self._piece(complex(*first)):
            return
        raise SceneError(
            entity="passers_by",
            field="between",
            expected="points that can be walked to",
            got=f"{point}, which {blocker.relation if blocker else f'has no way from {first}'}",
            remedy="Move the point.",
        )

    def _piece(self, place: complex) -> Polygon | None:
        from shapely import Point

        here = Point(place.real, place.imag)
        return min(self._pieces, key=here.distance, default=None)

    def _joined(self, free: BaseGeometry, place: complex) -> BaseGeometry:
        """The part of the free floor that can be reached from a place."""
        piece = self._piece(place)
        return free if piece is None or len(self._pieces) == 1 else free.intersection(piece)

    def _near(self, point: complex) -> complex:
        """A free place near a point; if a group keeps the point open, near the nearest free one."""
        from shapely import Point, shortest_line

        foot = shortest_line(Point(point.real, point.imag), self._free).coords[-1]
        point = complex(foot[0], foot[1])
        reach = SPREAD_M * np.sqrt(self._rng.random(TRIES))
        places = point + reach * np.exp(2j * np.pi * self._rng.random(TRIES))
        inside = _inside(places.astype(np.complex128), self._free)
        if not len(inside):
            raise _nowhere()
        return complex(inside[0])

    def _anywhere(self, count: int, free: BaseGeometry) -> Places:
        left, low, right, high = free.bounds
        for _ in range(ROUNDS):
            draws = self._rng.random((2, count * 8))
            places = left + draws[0] * (right - left) + 1j * (low + draws[1] * (high - low))
            inside = _inside(places.astype(np.complex128), free)
            if len(inside):
                return inside[:count]
        raise _nowhere()


def _outside_groups(free: BaseGeometry, scene: Scene, clear_m: float) -> BaseGeometry:
    """The free floor that keeps a clearance from the o-spaces of groups."""
    from shapely import Polygon, difference, union_all

    spaces = [Polygon(space.grown(clear_m).outline()) for space in scene.o_spaces]
    return difference(free, union_all(spaces)) if spaces else free


def _inside(places: Places, free: BaseGeometry) -> Places:
    from shapely import contains_xy, prepare

    prepare(free)
    return np.asarray(places[contains_xy(free, places.real, places.imag)])


def _nowhere() -> SceneError:
    return SceneError(
        entity="passers_by",
        expected="free floor for passers-by",
        got="none there",
        remedy="Choose other points, or a larger place.",
    )
