"""People who approach the robot, or stand in front of it after approaching: one of the two has to back up.

Bystanders are another case: the robot may ask them to make way. An approaching person would have to walk all
the way back.
"""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import dataclass
from typing import NamedTuple

from comity_sim2d.base.base import Base
from comity_sim2d.pose import XY
from comity_sim2d.scene.person import Person
from comity_sim2d.senses.sensing import SensedPeople

HELD_UP_M = 0.95
"""Gap between the bodies at which an approaching person is blocked by the robot and goes no farther [m] (our
choice). In a passage, people who take the robot for another person stop 0.8 m before it; people who only look
at it stop at 1.05 m."""
COMES_COS = 0.5
"""A person whose course is within 60 degrees of the robot approaches it. Close to it any course counts: they
try to get by (our choice)."""
COMES_S = 0.35
"""A person who has walked for a shorter time may only lean in or step up [s] (our choice)."""
MAKES_WAY_S = 5.0
"""Time after being asked for which a person makes way, and does not count as approaching [s] (our choice)."""
LATELY_S = 30.0
"""A standing person who arrived within this time may have stopped because of the robot [s] (our choice)."""


class OncomingPerson(NamedTuple):
    """A person who approaches, or has arrived."""

    name: str
    xy: XY
    radius_m: float
    gap_m: float
    """Gap between the bodies [m]."""
    is_close: bool = True
    """Whether they came as near as `HELD_UP_M` themselves; else they wait, or the robot came to them."""


@dataclass(slots=True)
class _Way:
    """The approach of a person."""

    since_s: float
    """When they set out [s]."""
    came_s: float = -math.inf
    """When they last arrived [s]; -inf if never."""
    is_close: bool = False


class Oncoming:
    """The people who have approached one robot.

    Args:
        radius_m: Radius of the robot [m].
        senses: Believed positions and velocities of people.
    """

    def __init__(self, radius_m: float, senses: SensedPeople) -> None:
        self._radius_m = radius_m
        self._senses = senses
        self._now_s = 0.0
        self._ways: dict[str, _Way] = {}
        """Approaches by name, of people who walk or have arrived."""
        self._asked_s: dict[str, float] = {}
        """When each person was last asked to let the robot pass [s]."""

    def note_asked(self, names: Collection[str]) -> None:
        """Note that the robot has asked these people to let it pass."""
        self._asked_s.update(dict.fromkeys(names, self._now_s))

    def look(self, base: Base) -> None:
        """Update who walks towards the robot; call it in every tick."""
        self._now_s += base.step_s
        walkers = self._senses.walkers
        if not walkers and not self._ways:
            return
        moving = {walker.person.name: walker for walker in walkers if not self._makes_way(walker.person.name)}
        for name, walker in moving.items():
            way = self._ways.setdefault(name, _Way(self._now_s))
            near = walker.person.gap_m(base.xy, self._radius_m) <= HELD_UP_M
            comes = near or _comes(walker.person, walker.velocity, base)
            if comes and self._now_s - way.since_s >= COMES_S:
                way.came_s, way.is_close = self._now_s, near
        for name, way in list(self._ways.items()):
            if name in moving:
                continue
            way.since_s = self._now_s
            way.is_close &= self._senses.person(name).gap_m(base.xy, self._radius_m) <= HELD_UP_M
            if not way.is_close and self._now_s - way.came_s > LATELY_S:
                del self._ways[name]

    def comers(self, xy: XY, *, within_s: float = LATELY_S) -> list[OncomingPerson]:
        """People who stand close in front of a robot at `xy`, or arrived within a given time.

        Args:
            xy: Position of the robot [m].
            within_s: The time [s].
        """
        found = []
        for name, way in self._ways.items():
            if way.is_close or self._now_s - way.came_s <= within_s:
                person = self._senses.person(name)
                gap_m = person.gap_m(xy, self._radius_m)
                found.append(OncomingPerson(name, person.xy, person.radius_m, gap_m, way.is_close))
        return found

    def knows(self, name: str) -> bool:
        """Whether a person is known by name and is not a passer-by."""
        return any(person.name == name for person in self._senses.people)

    def forget(self, name: str) -> None:
        """Treat a person as a bystander until they approach again."""
        self._ways.pop(name, None)

    def _makes_way(self, name: str) -> bool:
        return self._now_s - self._asked_s.get(name, -math.inf) <= MAKES_WAY_S


def _comes(person: Person, velocity: XY, base: Base) -> bool:
    """Whether a person's course leads to the robot."""
    x, y = base.xy[0] - person.x_m, base.xy[1] - person.y_m
    return velocity[0] * x + velocity[1] * y > COMES_COS * math.hypot(*velocity) * math.hypot(x, y)
