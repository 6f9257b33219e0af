"""From the changes that a scenario writes down to happenings, checked before anything moves."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from datetime import date
from typing import TYPE_CHECKING

from comity.acquaintance import situation_of
from comity.happenings import EmergencyStopPressed, ValuesChange, Walk, way_of
from comity.values import infer_for, refuse_unknown
from comity_fis import InputError
from comity_sim2d.obstacles import floor_plan
from comity_sim2d.scene import find_person

if TYPE_CHECKING:
    from comity.change import Change
    from comity.fact import Fact
    from comity.profile import Declared
    from comity.scenario import ScenarioFile
    from comity.schedule import Happening
    from comity_fis import Inference, Learnt, Rulebook
    from comity_sim2d import Scene


@dataclass(frozen=True, slots=True)
class Changes:
    """The changes of one scenario.

    Args:
        file: The scenario.
        scene: Where everybody starts.
        declared: Everybody's profile.
        rulebook: The rules.
        day: On which facts are taken.
        learnt: What earlier meetings taught, by person and parameter.
    """

    file: ScenarioFile
    scene: Scene
    declared: Mapping[str, Declared]
    rulebook: Rulebook
    day: date | None
    learnt: Mapping[str, Mapping[str, Learnt]]

    def happenings(self) -> tuple[Happening, ...]:
        """All of them, by time; what somebody asks for is added to what they asked for before.

        Raises:
            InputError: for a place that nobody can walk to, a wish that cannot be granted, or a fact that no
                rulebook knows; with its line.
        """
        return tuple(self._happenings())

    def _happenings(self) -> Iterator[Happening]:
        declared = dict(self.declared)
        people = self.file.scenario.people
        situations: dict[str, dict[str, Fact]] = {name: situation_of(people[name]) for name in people}
        places = {person.name: person.xy for person in self.scene.people}
        numbered = sorted(enumerate(self.file.scenario.changes), key=lambda each: each[1].at_s)
        for i, change in numbered:
            if change.emergency_stop_s is not None:
                yield EmergencyStopPressed(change.at_s, change.emergency_stop_s)
                continue
            name = change.person or ""
            if change.moves_to_m is not None:
                yield self._walk(i, name, change, change.moves_to_m, places)
            else:
                declared[name] = _asking(declared[name], change.says or {})
                situations[name] |= change.situation or {}
                values = self._values(i, name, declared[name], situations[name])
                yield ValuesChange(change.at_s, name, values, _in_words(name, change))

    def _walk(
        self,
        i: int,
        name: str,
        change: Change,
        to_m: tuple[float, float],
        places: dict[str, tuple[float, float]],
    ) -> Walk:
        person, plan = find_person(self.scene.people, name), floor_plan(self.scene)
        blocker = plan.blocker(to_m, person.radius_m)
        somebody = replace(person, x_m=places[name][0], y_m=places[name][1])
        if blocker is not None or way_of(somebody, to_m, plan) is None:
            raise InputError(
                expected=f"a free place that {name} can walk to",
                got=f"{list(to_m)}, which {blocker.relation if blocker else 'no way leads to'}",
                remedy="Move it away from walls and furniture, or open a way.",
                where=self.file.where("changes", i, "moves_to_m"),
            )
        places[name] = to_m
        heading_rad = None if change.facing_deg is None else math.radians(change.facing_deg)
        return Walk(change.at_s, name, to_m, heading_rad, change.speed_m_s)

    def _values(self, i: int, name: str, declared: Declared, situation: Mapping[str, Fact]) -> Inference:
        try:
            refuse_unknown(situation, self.rulebook, f"the situation of {name}")
            return infer_for(
                declared, self.rulebook, situation=situation, at=self.day, learnt=self.learnt.get(name)
            )
        except InputError as error:
            raise error.at(self.file.where("changes", i)) from None


def _asking(declared: Declared, says: Mapping[str, Fact]) -> Declared:
    """The same person with further settings; a complaint about them is not one about the profile's file."""
    if not says:
        return declared
    settings = {**declared.profile.settings, **says}
    return replace(declared, profile=declared.profile.model_copy(update={"settings": settings}), file=None)


def _in_words(name: str, change: Change) -> str:
    verb, told = ("asked for", change.says) if change.says else ("is now", change.situation)
    return f"{name} {verb} {', '.join(f'{key} {value}' for key, value in (told or {}).items())}"
