"""Everything that is decided before the world moves: whose profile, which values, what scene, which plan."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import date
from typing import TYPE_CHECKING

from comity.library import looks_like_a_file
from comity.profile import Declared, Profile, day_for, load_profile
from comity.request import Asked, ask
from comity.scenery import scene_of
from comity.values import infer_for, refuse_unknown
from comity_domain import Plan, Visitee, make_plan
from comity_executor import greeting_text, manner_of
from comity_fis import Inference, InputError, Rulebook, Where, closest, load_rulebook, read_rulebook
from comity_sim2d import RouteMap, Scene

if TYPE_CHECKING:
    from comity.scenario import Person, ScenarioFile
    from comity_fis.yaml_file import YamlFile


@dataclass(frozen=True, slots=True)
class Prepared:
    """A scenario with all its questions answered; every input was valid."""

    file: ScenarioFile
    rulebook_file: YamlFile
    rulebook: Rulebook
    day: date | None
    """On which the facts were taken; None where none depends on it."""
    profiles: Mapping[str, Profile]
    """By person."""
    values: Mapping[str, Inference]
    """By person, of everybody in the scenario, visited or not."""
    scene: Scene
    route_map: RouteMap
    asked: Asked
    plan: Plan


def prepare(
    file: ScenarioFile,
    *,
    profiles: Mapping[str, str] | None = None,
    rulebook: str | None = None,
    at: date | None = None,
) -> Prepared:
    """Answer all questions of a scenario and plan.

    Args:
        file: The scenario.
        profiles: Other profiles than the scenario's, by person: shipped or stored names, or files.
        rulebook: Another rulebook than the scenario's: a shipped name or a file.
        at: Another day than the scenario's to take dated facts on.

    Raises:
        InputError: if anything that a user wrote cannot be used.
        PlanningFailed: if the planner finds nothing.
    """
    book_file, book = _rulebook(file, rulebook)
    chosen = _profiles(file, profiles or {})
    day = day_for(at or file.scenario.at, *(declared.profile for declared in chosen.values()))
    values = {name: _values(file, name, chosen[name], book, day) for name in file.scenario.people}
    visitees = tuple(
        _visitee(file, name, values[name], override=rulebook) for name in file.scenario.visited()
    )
    scene = scene_of(file, {name: _own_distance(inference) for name, inference in values.items()})
    route_map = RouteMap(scene)
    asked = ask(scene, route_map, visitees)
    plan = make_plan(asked.request, time_limit_s=file.scenario.limits.planning_s)
    profiles_used = {name: declared.profile for name, declared in chosen.items()}
    return Prepared(file, book_file, book, day, profiles_used, values, scene, route_map, asked, plan)


def values_in(file: ScenarioFile) -> tuple[Rulebook, Mapping[str, Inference]]:
    """The rulebook of a scenario and everybody's values by it, without a plan.

    Raises:
        InputError: if anything that a user wrote cannot be used.
    """
    _, book = _rulebook(file, None)
    chosen = _profiles(file, {})
    day = day_for(file.scenario.at, *(declared.profile for declared in chosen.values()))
    return book, {name: _values(file, name, chosen[name], book, day) for name in file.scenario.people}


def _rulebook(file: ScenarioFile, other: str | None) -> tuple[YamlFile, Rulebook]:
    written = other or file.scenario.rulebook
    if not isinstance(written, str):
        inside = file.file.part("rulebook")
        return inside, load_rulebook(inside)
    if other is None and looks_like_a_file(written, file.folder / written):
        written = str(file.folder / written)
    try:
        found = read_rulebook(written)
        return found, load_rulebook(found)
    except InputError as error:
        raise error.at(Where("--rulebook") if other else file.where("rulebook")) from None


def _profiles(file: ScenarioFile, others: Mapping[str, str]) -> dict[str, Declared]:
    people = file.scenario.people
    for name in others:
        if name not in people:
            raise InputError(
                expected=f"somebody of the scenario {file.scenario.name}",
                got=repr(name),
                remedy=closest(name, people),
                where=Where("--as"),
            )
    return {
        name: load_profile(others[name], where=Where("--as"))
        if name in others
        else _own_profile(file, name, person)
        for name, person in people.items()
    }


def _own_profile(file: ScenarioFile, name: str, person: Person) -> Declared:
    if isinstance(person.profile, Profile):
        return Declared(person.profile, file.file.part("people", name, "profile"))
    return load_profile(person.profile, beside=file.folder, where=file.where("people", name, "profile"))


def _values(file: ScenarioFile, name: str, declared: Declared, book: Rulebook, day: date | None) -> Inference:
    person = file.scenario.people[name]
    try:
        refuse_unknown(person.situation, book, f"the situation of {name}")
        situation = {"posture": person.posture, **person.situation}
        return infer_for(declared, book, situation=situation, at=day)
    except InputError as error:
        raise error.at(file.where("people", name)) from None


def _visitee(file: ScenarioFile, name: str, values: Inference, *, override: str | None) -> Visitee:
    try:
        manner_of(values)  # what the acts read means what they take it for, or the world never starts
        greeting_text(name, values)
        return Visitee(name, values)
    except InputError as error:
        raise error.at(Where("--rulebook") if override else file.where("rulebook")) from None


def _own_distance(values: Inference) -> float:
    """How far somebody would like a robot to pass: as far as they would like it to stop."""
    return values["conversational_distance"].number
