"""Changes of the world since the plan was last reviewed, reported once things have come to rest."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import degrees, dist
from typing import TYPE_CHECKING

from comity_executor import Cause
from comity_sim2d import wrap_angle
from comity_sim2d.senses import active_faults

if TYPE_CHECKING:
    from comity.environment import Environment
    from comity_fis import Inference
    from comity_sim2d import Person

MOVED_M, TURNED_DEG = 0.5, 45.0
"""A person who has moved farther [m] or turned more [deg] than this since planning is a change (our choice).
The robot follows smaller moves without a review of the plan."""
SETTLED_M, SETTLED_DEG, SETTLED_S = 0.1, 10.0, 0.5
"""A plan is reviewed once a person who moved or turned has stayed within this distance [m] and angle [deg]
for this time [s]."""


@dataclass(frozen=True, slots=True)
class WorldChange:
    """Something changed about a person or something."""

    about: str
    text: str
    value: float | None = None
    fault: str | None = None
    """What is behind it, where something went wrong on purpose."""
    was_told: bool = False
    """Whether it is not to be seen."""

    @property
    def causes(self) -> tuple[Cause, ...]:
        """As links of a chain."""
        behind = () if self.fault is None else (Cause("fault", self.fault, None),)
        return (*behind, Cause("reading", self.text, self.value))


class Watch:
    """Looks at a world as its robot believes it to be.

    Args:
        world: Its robot knows where everybody is, and which doors are shut.
    """

    def __init__(self, world: Environment) -> None:
        self._world = world
        self._told: list[WorldChange] = []
        self._noted: list[WorldChange] = []
        self._planned_with = self._people()
        """Where everybody was when the plan was last looked at."""
        self._doors = world.doors
        """The doors, likewise."""
        self._seen = self._people()
        self._seen_s = 0.0

    def tell(self, news: WorldChange) -> None:
        """Something that is not to be seen."""
        self._told.append(replace(news, was_told=True))

    def note(self, news: WorldChange) -> None:
        """Something that is to be told, and changes nothing."""
        self._noted.append(news)

    @property
    def was_told(self) -> bool:
        """Whether something that is not to be seen is new."""
        return bool(self._told)

    def has_news(self, t: float) -> bool:
        """Whether something was told or noted, a door changed, or a person moved and stands still again."""
        turned = self._world.doors != self._doors
        return bool(self._told or self._noted) or turned or (self._look(t) and any(self._changed()))

    def take(self) -> tuple[WorldChange, ...]:
        """All that is new; it is not any more."""
        news, self._told, self._noted = (*self._told, *self._noted, *self._changed()), [], []
        self._planned_with, self._doors = self._people(), self._world.doors
        return news

    def _people(self) -> dict[str, Person]:
        return {person.name: person for person in self._world.robot.people}

    def _look(self, t: float) -> bool:
        """Whether everybody has stood still since the last look, which is some time ago."""
        if t - self._seen_s < SETTLED_S:
            return False
        before, self._seen, self._seen_s = self._seen, self._people(), t
        return all(_rests(before[name], person) for name, person in self._seen.items())

    def _changed(self) -> Iterator[WorldChange]:
        for door, now in zip(self._doors, self._world.doors, strict=True):
            if door != now:
                text = f"{now.name} was {'opened' if now.is_open else 'shut'}"
                yield WorldChange(now.name, text, fault=self._world.faults.of(active_faults.door(now.name)))
        for name, person in self._people().items():
            before = self._planned_with[name]
            moved_m = dist(person.xy, before.xy)
            turned_deg = _turned_deg(before, person)
            if moved_m > MOVED_M:
                yield WorldChange(name, f"{name} moved by {moved_m:.2f} m", moved_m)
            elif turned_deg > TURNED_DEG:
                yield WorldChange(name, f"{name} turned by {turned_deg:.0f} deg", turned_deg)


def _rests(before: Person, now: Person) -> bool:
    return dist(before.xy, now.xy) <= SETTLED_M and _turned_deg(before, now) <= SETTLED_DEG


def _turned_deg(before: Person, now: Person) -> float:
    return abs(degrees(wrap_angle(now.heading_rad - before.heading_rad)))


def differences(person: str, before: Inference, after: Inference) -> Iterator[WorldChange]:
    """The parameters that are others now, with what they were."""
    for name, value in after.parameters.items():
        old = before.parameters.get(name)
        if old is None or old.value == value.value:
            continue
        if isinstance(value.value, str) or isinstance(old.value, str):
            yield WorldChange(person, f"{name} of {person} {old.value} -> {value.value} ({value.origin})")
        else:
            words = f"{old.value:.4f} -> {value.value:.4f} ({value.origin})"
            yield WorldChange(person, f"{name} of {person} {words}", float(value.value))
