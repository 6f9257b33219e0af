"""Itinerary of a person: the points of a walk, the bends between them, and the pauses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

from comity_sim2d.pose import XY
from comity_sim2d.scene.footpath import Disc, Footpaths


@dataclass(frozen=True, slots=True)
class Leg:
    """A straight piece of a walk, given by its end."""

    goal: complex
    pause_s: float = 0.0
    """Time to stand there [s]."""
    is_stop: bool = True
    """Whether it is a point of the walk and not only a bend on the way."""


class Itinerary:
    """One person's walk under way.

    Args:
        stops: The points to go to, with the pause at each.
        loop: Whether the walk repeats.
        paths: Finds the path from one point to the next.
    """

    def __init__(self, stops: Sequence[tuple[XY, float]], *, loop: bool, paths: Footpaths) -> None:
        self._stops, self._loop, self._paths = stops, loop, paths
        self._next = 0
        self._legs: list[Leg] = []
        self._from_stop = lru_cache(maxsize=None)(self._way)

    def set_out(self, at: XY, past: Disc | None = None) -> Leg:
        """The first leg from `at` to the next point, around a blocking object if given."""
        around = None if past is None else self._paths.past(past, at, self._stops[self._next][0])
        self._legs = list(self._way(at, self._next) if around is None else self._over(around, self._next))
        return self._legs[0]

    def forget(self) -> None:
        """Drop the known paths: the place has changed."""
        self._from_stop.cache_clear()

    def stay(self, at: XY) -> None:
        """End the walk here: a person who leaves returns to this place."""
        self._stops, self._loop, self._next = [(at, 0.0)], False, 0
        self.forget()

    def arrive(self) -> Leg | None:
        """The leg after the current one; None at the end of the walk."""
        done = self._legs.pop(0)
        if not done.is_stop:
            return self._legs[0]
        here, last = self._stops[self._next][0], self._next == len(self._stops) - 1
        if last and not self._loop:
            return None
        self._next = 0 if last else self._next + 1
        self._legs = list(self._from_stop(here, self._next))
        return self._legs[0]

    def _way(self, start: XY, stop: int) -> tuple[Leg, ...]:
        goal = self._stops[stop][0]
        return self._over(self._paths.between(start, goal) or [goal], stop)

    def _over(self, bends: Sequence[XY], stop: int) -> tuple[Leg, ...]:
        goal, pause_s = self._stops[stop]
        return (*(Leg(complex(*bend), is_stop=False) for bend in bends[:-1]), Leg(complex(*goal), pause_s))
