"""Who comes at the robot, or has come and stands before it: neither gets on until one of them goes back.

Who only stands there is somebody else: they may be asked to make way, and whoever comes would have to go back
all of their way.
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
"""Who has come so near, between the bodies, and goes no farther is held up by the robot (our choice): people
to whom it is another person stop 0.8 m before it in a passage, and those who only look at it 1.05 m."""
COMES_COS = 0.5
"""Whoever goes straight for the robot, to within 60 degrees, comes at it; close to it whoever goes anywhere:
they try to get by (our choice)."""
COMES_S = 0.35
"""Who has walked for less may only lean in, or step up (our choice)."""
MAKES_WAY_S = 5.0
"""A person whom the robot asked to let it pass makes way for so long [s], and does not come (our choice)."""
LATELY_S = 30.0
"""Who came so lately and stands still may have stopped because of the robot (our choice)."""


class OncomingPerson(NamedTuple):
    """Somebody who comes, or has come."""

    name: str
    xy: XY
    radius_m: float
    gap_m: float
    """Between the bodies."""
    is_close: bool = True
    """Whether they went on until they were so near the robot; else they wait, or it came up to them."""


@dataclass(slots=True)
class _Way:
    """How somebody has come."""

    since_s: float
    """When they set out."""
    came_s: float = -math.inf
    """When they came last."""
    is_close: bool = False


class Oncoming:
    """Keeps in mind who came at one robot.

    Args:
        radius_m: Of the robot.
        senses: Where it believes people to be, and how they go.
    """

    def __init__(self, radius_m: float, senses: SensedPeople) -> None:
        self._radius_m = radius_m
        self._senses = senses
        self._now_s = 0.0
        self._ways: dict[str, _Way] = {}
        """Of whoever walks or has come."""
        self._asked_s: dict[str, float] = {}
        """When each person was asked last to let the robot pass."""

    def note_asked(self, names: Collection[str]) -> None:
        """The robot has asked some people to let it pass."""
        self._asked_s.update(dict.fromkeys(names, self._now_s))

    def look(self, base: Base) -> None:
        """See who walks now, and whether at the robot; to be called in every tick."""
        self._now_s += base.step_s
        walkers = self._senses.walkers
        if not walkers and not self._ways:
            return
        moving = {walker.person.name: walker for walker in walkers if not self._makes_way(walker.person.name)}
        for name, walker in moving.items():
            way = self._ways.setdefault(name, _Way(self._now_s))
            near = self._gap_m(base.xy, walker.person) <= HELD_UP_M
            comes = near or _comes(walker.person, walker.velocity, base)
            if comes and self._now_s - way.since_s >= COMES_S:
                way.came_s, way.is_close = self._now_s, near
        for name, way in list(self._ways.items()):
            if name in moving:
                continue
            way.since_s = self._now_s
            way.is_close &= self._gap_m(base.xy, self._senses.person(name)) <= HELD_UP_M
            if not way.is_close and self._now_s - way.came_s > LATELY_S:
                del self._ways[name]

    def comers(self, xy: XY, *, within_s: float = LATELY_S) -> list[OncomingPerson]:
        """Those who stand close before a robot there, or came so lately.

        Args:
            xy: Where the robot is.
            within_s: What counts as lately.
        """
        found = []
        for name, way in self._ways.items():
            if way.is_close or self._now_s - way.came_s <= within_s:
                person = self._senses.person(name)
                gap_m = self._gap_m(xy, person)
                found.append(OncomingPerson(name, person.xy, person.radius_m, gap_m, way.is_close))
        return found

    def knows(self, name: str) -> bool:
        """Whether somebody is one of those it knows, and not any passer-by."""
        return any(person.name == name for person in self._senses.people)

    def forget(self, name: str) -> None:
        """Somebody only stands there, until they come anew."""
        self._ways.pop(name, None)

    def _makes_way(self, name: str) -> bool:
        return self._now_s - self._asked_s.get(name, -math.inf) <= MAKES_WAY_S

    def _gap_m(self, xy: XY, person: Person) -> float:
        return math.dist(xy, person.xy) - person.radius_m - self._radius_m


def _comes(person: Person, velocity: XY, base: Base) -> bool:
    """Whether somebody goes for the robot."""
    x, y = base.xy[0] - person.x_m, base.xy[1] - person.y_m
    return velocity[0] * x + velocity[1] * y > COMES_COS * math.hypot(*velocity) * math.hypot(x, y)
