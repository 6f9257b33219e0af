"""Everything that is decided before the world moves: whose profile, which values, what scene, which plan."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity.circumstances import circumstances
from comity.diagnosis import Case, GoalsUnmet, Unmet, diagnose, diagnose_deadlines
from comity.library import looks_like_a_file
from comity.profile import Declared, Profile, load_profile
from comity.request import Asked, ask
from comity.scenery import scene_of
from comity.values import infer_for, refuse_unknown
from comity_domain import Plan, PlanningFailed, Visitee, make_plan
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
    profiles: Mapping[str, Profile]
    """By person."""
    values: Mapping[str, Inference]
    """By person, of everybody in the scenario, visited or not."""
    scene: Scene
    route_map: RouteMap
    asked: Asked
    plan: Plan
    unmet: tuple[Unmet, ...]
    """The goals of those whom no plan can serve; the plan is for the others."""


def prepare(
    file: ScenarioFile, *, profiles: Mapping[str, str] | None = None, rulebook: str | None = None
) -> Prepared:
    """Answer all questions of a scenario and plan.

    Args:
        file: The scenario.
        profiles: Other profiles than the scenario's, by person: shipped names or files.
        rulebook: Another rulebook than the scenario's: a shipped name or a file.

    Raises:
        InputError: if anything that a user wrote cannot be used.
        GoalsUnmet: if no plan meets the goals, or none was found.
    """
    book_file, book = _rulebook(file, rulebook)
    chosen = _profiles(file, profiles or {})
    values = {name: _values(file, name, chosen[name], book) for name in file.scenario.people}
    visitees = tuple(
        _visitee(file, name, values[name], book, override=rulebook) for name in file.scenario.visited()
    )
    scene = scene_of(file, {name: _own_distance(inference) for name, inference in values.items()})
    route_map = RouteMap(scene)
    asked = ask(scene, route_map, visitees, groups=file.scenario.groups)
    plan = _plan(asked, file)
    profiles_used = {name: declared.profile for name, declared in chosen.items()}
    unmet = tuple(
        diagnose(_case(visitee, scene, file, chosen[visitee.name], book), asked.unreachable[visitee.name])
        for visitee in visitees
        if visitee.name in asked.unreachable
    )
    return Prepared(file, book_file, book, profiles_used, values, scene, route_map, asked, plan, unmet)


def _plan(asked: Asked, file: ScenarioFile) -> Plan:
    limits = file.scenario.limits
    try:
        return make_plan(asked.request, time_limit_s=limits.planning_s, memory_mb=limits.planning_mb)
    except PlanningFailed as failed:
        raise GoalsUnmet(failed, diagnose_deadlines(asked.request)) from None


def _case(visitee: Visitee, scene: Scene, file: ScenarioFile, declared: Declared, book: Rulebook) -> Case:
    settings = declared.profile.settings

    def without(dropped: Sequence[str]) -> Inference:
        kept = {name: wish for name, wish in settings.items() if name not in dropped}
        profile = declared.profile.model_copy(update={"settings": kept})
        return _values(file, visitee.name, Declared(profile, declared.file), book)

    return Case(scene, visitee, without, tuple(settings))


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


def _values(file: ScenarioFile, name: str, declared: Declared, book: Rulebook) -> Inference:
    person = file.scenario.people[name]
    try:
        refuse_unknown(person.situation, book, f"the situation of {name}")
        return infer_for(declared, book, situation={"posture": person.posture, **person.situation})
    except InputError as error:
        raise error.at(file.where("people", name)) from None


def _visitee(
    file: ScenarioFile, name: str, values: Inference, book: Rulebook, *, override: str | None
) -> Visitee:
    goal = next(goal for goal in file.scenario.goals if goal.greet == name)
    now = circumstances(file.scenario, name, values, book)
    try:
        return Visitee(name, values, now, priority_m=goal.priority, by_s=goal.by_s, skip_m=goal.skip)
    except InputError as error:
        raise error.at(Where("--rulebook") if override else file.where("rulebook")) from None


def _own_distance(values: Inference) -> float:
    """How far somebody would like a robot to pass: as far as they would like it to stop."""
    return values["conversational_distance"].number
