"""Conversion of a scenario's changes to happenings, checked before execution."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from comity.parameters.acquaintance import situation_of
from comity.parameters.passing import asked_speed_m_s, own_distance_m
from comity.parameters.values import refuse_unknown
from comity.schedule import Announced
from comity.simulation.happenings import EmergencyStopPressed, ValuesChange, WalkStart
from comity.simulation.sent_way import way_of
from comity_fis import InputError
from comity_sim2d import SceneError
from comity_sim2d.scene.obstacles import floor_plan
from comity_sim2d.scene.person import find_person

if TYPE_CHECKING:
    from comity.parameters.cast import Cast
    from comity.people.fact import Fact
    from comity.people.profile import Declared
    from comity.scenario import ScenarioFile
    from comity.schedule import Happening
    from comity.specification.change import Change
    from comity_fis import Inference
    from comity_sim2d import Scene


@dataclass(frozen=True, slots=True)
class Changes:
    """The changes of one scenario.

    Args:
        cast: Its people, with the rulebook and the date.
        scene: The initial scene.
    """

    cast: Cast
    scene: Scene

    def happenings(self) -> tuple[Happening, ...]:
        """All happenings, by time.

        Raises:
            InputError: with its line, for an unreachable place, a wish that cannot be granted, or a fact
                unknown to every rulebook.
        """
        return tuple(self._happenings())

    def _happenings(self) -> Iterator[Happening]:
        values = changes_of_values(self.cast)
        places = {person.name: person.xy for person in self.scene.people}
        for i, change in _by_time(self.cast.file):
            name = change.person or ""
            if change.emergency_stop_s is not None:
                stop = EmergencyStopPressed(change.at_s, change.emergency_stop_s)
                yield Announced(stop, "change", self.scene.robot.name, stop.reason)
            elif change.moves_to_m is not None:
                walk = self._walk(i, name, change, change.moves_to_m, places)
                yield Announced(walk, "change", name, f"{name} is sent to {walk.there}")
            else:
                told = self._passable(i, values[i])
                yield Announced(told, "message" if change.says else "change", name, told.text)

    def _passable(self, i: int, change: ValuesChange) -> ValuesChange:
        """The change, once checked that the robot can comply with it while driving."""
        person = find_person(self.scene.people, change.person)
        try:
            replace(
                person,
                personal_distance_m=own_distance_m(change.values),
                approach_speed_m_s=asked_speed_m_s(change.values),
            )
        except SceneError as error:
            raise error.at(self.cast.file.where("changes", i)) from None
        return change

    def _walk(
        self,
        i: int,
        name: str,
        change: Change,
        to_m: tuple[float, float],
        places: dict[str, tuple[float, float]],
    ) -> WalkStart:
        person, plan = find_person(self.scene.people, name), floor_plan(self.scene)
        blocker = plan.blocker(to_m, person.radius_m)
        somebody = replace(person, x_m=places[name][0], y_m=places[name][1])
        if blocker is not None or way_of(somebody, to_m, plan) is None:
            raise InputError(
                expected=f"a free place that {name} can walk to",
                got=f"{list(to_m)}, which {blocker.relation if blocker else 'no way leads to'}",
                remedy="Move it away from walls and furniture, or open a way.",
                where=self.cast.file.where("changes", i, "moves_to_m"),
            )
        places[name] = to_m
        heading_rad = None if change.facing_deg is None else math.radians(change.facing_deg)
        return WalkStart(change.at_s, name, to_m, heading_rad, change.speed_m_s)


def changes_of_values(cast: Cast) -> dict[int, ValuesChange]:
    """Later parameters of everybody, by the change's index in the file, in order of time.

    Requests of a person accumulate.

    Raises:
        InputError: with its line, for a wish that cannot be granted, or a fact unknown to every rulebook.
    """
    found: dict[int, ValuesChange] = {}
    for i, change, declared, situation in _said(cast.file, cast.declared):
        name = change.person or ""
        values = _values(cast, i, name, declared, situation)
        found[i] = ValuesChange(change.at_s, name, values, _in_words(name, change))
    return found


def said_by(file: ScenarioFile, declared: Declared, name: str, t: float) -> tuple[Declared, dict[str, Fact]]:
    """A person's requests, and the facts of their situation, at a time of the episode [s].

    Args:
        file: The scenario.
        declared: The person's initial declarations.
        name: Name of the person.
        t: The time; statements at that time count.
    """
    now = declared, situation_of(file.scenario.people[name])
    for _, change, asking, situation in _said(file, {name: declared}):
        if change.at_s <= t:
            now = asking, dict(situation)
    return now


def _said(
    file: ScenarioFile, people: Mapping[str, Declared]
) -> Iterator[tuple[int, Change, Declared, Mapping[str, Fact]]]:
    """Every change with statements, by time, with the person's declarations and situation from then on."""
    declared = dict(people)
    situations = {name: situation_of(file.scenario.people[name]) for name in people}
    for i, change in _by_time(file):
        if change.person in declared and (change.says or change.situation):
            name = change.person
            declared[name] = _asking(declared[name], change.says or {})
            situations[name] |= change.situation or {}
            yield i, change, declared[name], situations[name]


def _by_time(file: ScenarioFile) -> list[tuple[int, Change]]:
    return sorted(enumerate(file.scenario.changes), key=lambda each: each[1].at_s)


def _values(cast: Cast, i: int, name: str, declared: Declared, situation: Mapping[str, Fact]) -> Inference:
    try:
        refuse_unknown(situation, cast.rulebook, f"the situation of {name}")
        return cast.values_told(name, declared, situation)
    except InputError as error:
        raise error.at(cast.file.where("changes", i)) from None


def _asking(declared: Declared, says: Mapping[str, Fact]) -> Declared:
    """The person with further settings; errors in them do not refer to the profile's file."""
    if not says:
        return declared
    settings = {**declared.profile.settings, **says}
    return replace(declared, profile=declared.profile.model_copy(update={"settings": settings}), file=None)


def _in_words(name: str, change: Change) -> str:
    verb, told = ("asked for", change.says) if change.says else ("is now", change.situation)
    return f"{name} {verb} {', '.join(f'{key} {value}' for key, value in (told or {}).items())}"
