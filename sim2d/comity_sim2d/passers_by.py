"""People whom nobody planned for: they come and go, anonymous, where chance puts them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from comity_sim2d.obstacles import floor_plan
from comity_sim2d.pose import XY
from comity_sim2d.robot_reaction import RobotReaction, require_reaction
from comity_sim2d.scene_error import SceneError, require_between, require_points, require_whole
from comity_sim2d.social_force import SPEED_M_S, SPEED_SPREAD_M_S, Vectors

if TYPE_CHECKING:
    from comity_sim2d.scene import Scene

SLOWEST_M_S, FASTEST_M_S = 0.6, 2.0
"""Nobody strolls slower or hurries more, however the speeds are spread (our choice)."""
APART_M = 0.10
"""Between the bodies of people at the start, at least; three times as much to the robot."""
DESTINATIONS = 4
"""Through so many places a passer-by walks before coming back to the first, where nothing else is said."""
SPREAD_M = 1.0
"""So far from a given point do passers-by go, so that not all want to stand on it."""
TRIES = 400


@dataclass(frozen=True, slots=True)
class PassersBy:
    """So many people who walk about as long as the world runs; in frames and metrics, in nobody's plan."""

    count: int
    between: tuple[XY, ...] = ()
    """The points that they walk between, to within `SPREAD_M`; anywhere where this is empty."""
    speed_m_s: float = SPEED_M_S
    """The mean; it differs from one to the next by `SPEED_SPREAD_M_S`."""
    reacts: RobotReaction = "regular"
    radius_m: float = 0.20

    def __post_init__(self) -> None:
        require_whole("passers_by", "count", self.count, 0, 1000)
        require_between("passers_by", "speed_m_s", self.speed_m_s, SLOWEST_M_S, FASTEST_M_S)
        require_between("passers_by", "radius_m", self.radius_m, 0.05, 2.0)
        require_reaction("passers_by", self.reacts)
        require_points("passers_by", "between", self.between)
        if len(set(self.between)) == 1:
            raise SceneError(
                entity="passers_by",
                field="between",
                expected="at least two different points, or none",
                got="one",
                remedy="Add where they go to.",
            )

    @property
    def names(self) -> tuple[str, ...]:
        """What they are called in frames."""
        return tuple(f"passer-by {number}" for number in range(1, self.count + 1))


@dataclass(frozen=True, slots=True)
class Placed:
    """Where one passer-by starts and goes."""

    at: complex
    speed_m_s: float
    stops: tuple[complex, ...]


def place(scene: Scene, seed: int) -> tuple[Placed, ...]:
    """Put the passers-by of a scene into it, clear of everything and everybody.

    Raises:
        SceneError: Where there is no room for them.
    """
    who, rng = scene.passers_by, np.random.Generator(np.random.PCG64([seed, 2]))
    if who is None:
        return ()
    floor = _Floor(scene, who.radius_m, rng)
    starts = [floor.free_place() for _ in range(who.count)]
    speeds = rng.normal(who.speed_m_s, SPEED_SPREAD_M_S, who.count).clip(SLOWEST_M_S, FASTEST_M_S)
    return tuple(
        Placed(start, float(speed), floor.destinations(who.between))
        for start, speed in zip(starts, speeds, strict=True)
    )


class _Floor:
    """Where people of one size can be."""

    def __init__(self, scene: Scene, radius_m: float, rng: np.random.Generator) -> None:
        from shapely import prepare

        self._free = floor_plan(scene).clear_space(round(radius_m + APART_M, 6))
        prepare(self._free)
        self._radius_m, self._rng = radius_m, rng
        people, robot = scene.people, scene.robot
        self._taken = [complex(*person.xy) for person in people] + [complex(*robot.pose.xy)]
        self._reach = [person.radius_m + radius_m + APART_M for person in people]
        self._reach.append(robot.radius_m + radius_m + 3 * APART_M)

    def free_place(self) -> complex:
        """A place clear of all people so far, which is taken from then on."""
        taken, reach = np.array(self._taken), np.array(self._reach)
        for place in self._anywhere(TRIES):
            if np.all(np.abs(taken - place) >= reach):
                self._taken.append(complex(place))
                self._reach.append(2 * self._radius_m + APART_M)
                return complex(place)
        raise SceneError(
            entity="passers_by",
            field="count",
            expected="passers-by for whom there is room",
            got=f"no room for number {len(self._taken)} of people and robots",
            remedy="Take fewer, or a larger place.",
        )

    def destinations(self, between: tuple[XY, ...]) -> tuple[complex, ...]:
        """Where one passer-by goes to, one after the other."""
        if not between:
            return tuple(complex(place) for place in self._anywhere(DESTINATIONS))
        return tuple(self._near(complex(*between[i])) for i in self._rng.permutation(len(between)))

    def _near(self, point: complex) -> complex:
        reach = SPREAD_M * np.sqrt(self._rng.random(TRIES))
        places = point + reach * np.exp(2j * np.pi * self._rng.random(TRIES))
        return complex(self._inside(places.astype(np.complex128), 1)[0])

    def _anywhere(self, count: int) -> Vectors:
        left, low, right, high = self._free.bounds
        draws = self._rng.random((2, count * 8))
        places = left + draws[0] * (right - left) + 1j * (low + draws[1] * (high - low))
        return self._inside(places.astype(np.complex128), count)

    def _inside(self, places: Vectors, count: int) -> Vectors:
        from shapely import contains_xy

        inside = places[contains_xy(self._free, places.real, places.imag)][:count]
        if len(inside) == 0:
            raise SceneError(
                entity="passers_by",
                expected="free floor for passers-by",
                got="none there",
                remedy="Choose other points, or a larger place.",
            )
        return np.asarray(inside)
