"""Everything that is decided before the world moves: whose profile, which values, what scene, which plan."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import date
from typing import TYPE_CHECKING

from comity.acquaintance import learnt_with, situation_of
from comity.changes import Changes
from comity.circumstances import circumstances
from comity.diagnosis import Case, GoalsUnmet, Unmet, diagnose, diagnose_deadlines
from comity.faults import Faults
from comity.goals import agenda_of
from comity.library import looks_like_a_file
from comity.placement import placed
from comity.profile import Declared, Profile, day_for, load_profile
from comity.request import Asked, ask
from comity.scenery import scene_of
from comity.values import infer_for, refuse_unknown
from comity_domain import Plan, PlanningFailed, Visitee, make_plan
from comity_executor import Limits, greeting_text, leaves_of, manner_of
from comity_fis import Inference, InputError, Learnt, Rulebook, Where, closest, load_rulebook, read_rulebook
from comity_sim2d import RouteMap, Scene, places

if TYPE_CHECKING:
    from comity.scenario import Person, Scenario, ScenarioFile
    from comity.schedule import Happening
    from comity_domain import Orders
    from comity_fis.yaml_file import YamlFile

ATTEND_S = 4.0
"""Long enough for a reaction after a moment's hesitation, sensed late (our choice)."""


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
    visitees: tuple[Visitee, ...]
    """Whom the goals name, whether or not a plan can serve them."""
    asked: Asked
    plan: Plan
    learnt: Mapping[str, Mapping[str, Learnt]]
    """By person and parameter, of those with whom something was learnt."""
    kept_as: Mapping[str, str | None]
    """By person, the name under which meetings are remembered; None where they are not."""
    attend_s: float
    """How long the robot watches how each person takes its coming."""
    happenings: tuple[Happening, ...]
    """What happens while the plan is carried out."""
    unmet: tuple[Unmet, ...]
    """The goals of those whom no plan can serve; the plan is for the others."""


def prepare(
    file: ScenarioFile,
    *,
    profiles: Mapping[str, str] | None = None,
    rulebook: str | None = None,
    at: date | None = None,
    learn: bool = False,
    learnt: Mapping[str, Mapping[str, Learnt]] | None = None,
    seed: int = 0,
    orders: Orders | None = None,
) -> Prepared:
    """Answer all questions of a scenario and plan.

    Args:
        file: The scenario.
        profiles: Other profiles than the scenario's, by person: shipped or stored names, or files.
        rulebook: Another rulebook than the scenario's: a shipped name or a file.
        at: Another day than the scenario's to take dated facts on.
        learn: Whether the robot is to see how everybody takes its coming, also where nobody reacts.
        learnt: What earlier meetings taught, by person and parameter; None for what is remembered of them.
        seed: For random places; that of the episode.
        orders: Where orders of visits are kept, as `make_plan` says; the plan is the same with and without.

    Raises:
        InputError: if anything that a user wrote cannot be used.
        GoalsUnmet: if no plan meets the goals, or none was found.
    """
    file = placed(file, seed)
    book_file, book = _rulebook(file, rulebook)
    chosen = _profiles(file, profiles or {})
    day = day_for(at or file.scenario.at, *(declared.profile for declared in chosen.values()))
    if learnt is None:
        learnt = learnt_with(file, tuple(profiles or ()), chosen, book, day)
    values = {
        name: _values(file, name, chosen[name], book, day=day, learnt=learnt.get(name))
        for name in file.scenario.people
    }
    visitees = tuple(
        _visitee(file, name, values[name], book, override=rulebook) for name in file.scenario.visited()
    )
    scene = scene_of(file, {name: _own_distance(inference) for name, inference in values.items()})
    file.goal_check.places(places(scene))
    route_map = RouteMap(scene)
    attend_s = _attend_s(file.scenario, learn=learn)
    happenings = Changes(file, scene, chosen, book, day, learnt).happenings()
    asked = ask(scene, route_map, visitees, groups=file.scenario.groups, attend_s=attend_s)
    plan = _plan(asked, file, orders)
    if file.scenario.faults:
        leaves = leaves_of(plan, values, Limits.attentive(attend_s))
        happenings += Faults(file, scene, leaves).happenings()
    profiles_used = {name: declared.profile for name, declared in chosen.items()}

    def values_with(name: str, declared: Declared) -> Inference:
        return _values(file, name, declared, book, day=day, learnt=learnt.get(name))

    unmet = tuple(
        diagnose(_case(visitee, scene, chosen[visitee.name], values_with), asked.unreachable[visitee.name])
        for visitee in visitees
        if visitee.name in asked.unreachable
    )
    return Prepared(
        file=file,
        rulebook_file=book_file,
        rulebook=book,
        day=day,
        profiles=profiles_used,
        values=values,
        scene=scene,
        route_map=route_map,
        visitees=visitees,
        asked=asked,
        plan=plan,
        happenings=happenings,
        unmet=unmet,
        learnt=learnt,
        kept_as={name: declared.kept_as for name, declared in chosen.items()},
        attend_s=attend_s,
    )


def _plan(asked: Asked, file: ScenarioFile, orders: Orders | None) -> Plan:
    limits = file.scenario.limits
    try:
        return make_plan(
            asked.request, time_limit_s=limits.planning_s, memory_mb=limits.planning_mb, orders=orders
        )
    except PlanningFailed as failed:
        raise GoalsUnmet(failed, diagnose_deadlines(asked.request)) from None


def _case(
    visitee: Visitee, scene: Scene, declared: Declared, values_with: Callable[[str, Declared], Inference]
) -> Case:
    settings = declared.profile.settings

    def without(dropped: Sequence[str]) -> Inference:
        kept = {name: wish for name, wish in settings.items() if name not in dropped}
        return values_with(
            visitee.name, replace(declared, profile=declared.profile.model_copy(update={"settings": kept}))
        )

    return Case(scene, visitee, without, tuple(settings))


def values_in(
    file: ScenarioFile,
    *,
    profiles: Mapping[str, str] | None = None,
    rulebook: str | None = None,
    at: date | None = None,
) -> tuple[Rulebook, Mapping[str, Inference]]:
    """The rulebook of a scenario and everybody's values by it, without a plan.

    Args:
        file: The scenario.
        profiles: Other profiles than the scenario's, by person.
        rulebook: Another rulebook than the scenario's.
        at: Another day than the scenario's to take dated facts on.

    Raises:
        InputError: if anything that a user wrote cannot be used.
    """
    _, book = _rulebook(file, rulebook)
    chosen = _profiles(file, profiles or {})
    day = day_for(at or file.scenario.at, *(declared.profile for declared in chosen.values()))
    learnt = learnt_with(file, tuple(profiles or ()), chosen, book, day)
    return book, {
        name: _values(file, name, chosen[name], book, day=day, learnt=learnt.get(name))
        for name in file.scenario.people
    }


def _rulebook(file: ScenarioFile, other: str | None) -> tuple[YamlFile, Rulebook]:
    found = rulebook_of(file, other)
    try:
        return found, load_rulebook(found)
    except InputError as error:
        raise error.at(Where("--rulebook") if other else file.where("rulebook")) from None


def rulebook_of(file: ScenarioFile, other: str | None = None) -> YamlFile:
    """The file of a scenario's rulebook, or of another one, read and not yet checked.

    Raises:
        InputError: if there is none, or it is no YAML.
    """
    written = other or file.scenario.rulebook
    if not isinstance(written, str):
        return file.file.part("rulebook")
    if other is None and looks_like_a_file(written, file.folder / written):
        written = str(file.folder / written)
    try:
        return read_rulebook(written)
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


def _attend_s(scenario: Scenario, *, learn: bool) -> float:
    if scenario.limits.attend_s is not None:
        return scenario.limits.attend_s
    return ATTEND_S if learn or any(person.comfort for person in scenario.people.values()) else 0.0


def _values(
    file: ScenarioFile,
    name: str,
    declared: Declared,
    book: Rulebook,
    *,
    day: date | None,
    learnt: Mapping[str, Learnt] | None,
) -> Inference:
    person = file.scenario.people[name]
    try:
        refuse_unknown(person.situation, book, f"the situation of {name}")
        return infer_for(declared, book, situation=situation_of(person), at=day, learnt=learnt)
    except InputError as error:
        raise error.at(file.where("people", name)) from None


def _visitee(
    file: ScenarioFile, name: str, values: Inference, book: Rulebook, *, override: str | None
) -> Visitee:
    goal = next(goal for goal in file.scenario.goals if goal.greet == name)
    now = circumstances(file.scenario, name, values, book)
    try:
        manner_of(values)  # what the acts read means what they take it for, or the world never starts
        greeting_text((name,), values)
        return Visitee(
            name,
            values,
            now,
            priority_m=goal.priority or 0.0,
            by_s=goal.by_s,
            skip_m=goal.skip,
            agenda=agenda_of(file.scenario.goals, name),
        )
    except InputError as error:
        raise error.at(Where("--rulebook") if override else file.where("rulebook")) from None


def _own_distance(values: Inference) -> float:
    """How far somebody would like a robot to pass: as far as they would like it to stop."""
    return values["conversational_distance"].number
