"""Everything that is decided before the world moves: whose profile, which values, what scene, which plan."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import date
from functools import partial
from numbers import Integral
from time import monotonic
from typing import TYPE_CHECKING

from comity.answers.plan import Unmet
from comity.parameters.cast import Cast, cast_of
from comity.parameters.margin import margin_facts
from comity.people.profile import Profile, ProfileGiven
from comity.planning.circumstances import circumstances, require_gestures
from comity.planning.diagnosis import GoalsUnmet, UnservedCase, diagnose, in_words
from comity.planning.punctuality import diagnose_deadlines
from comity.planning.request import PlanningRequest, ask
from comity.planning.serving import plan_for_most
from comity.simulation.changes import Changes
from comity.simulation.faults import Faults
from comity.simulation.placement import placed
from comity.simulation.scenery import require_margin, scene_of
from comity.specification.goals import agenda_of
from comity_domain import ENGINE, NoPlan, PlanningFailed, Visitee, VisitPlan, plan_with
from comity_executor import Limits, Speaker, leaves_of, manner_of
from comity_fis import Inference, InputError, Learnt, Rulebook
from comity_sim2d import RouteMap, Scene, places

if TYPE_CHECKING:
    from comity.parameters.which_rulebook import ChosenRulebook
    from comity.scenario import Scenario, ScenarioFile
    from comity.schedule import Happening

ATTEND_S = 4.0
"""Long enough for a reaction after a moment's hesitation, sensed late (our choice)."""


@dataclass(frozen=True, slots=True)
class PlannedEpisode:
    """A scenario with all its questions answered; every input was valid."""

    file: ScenarioFile
    chosen: ChosenRulebook
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
    """People whom the goals name, whether or not a plan can serve them."""
    asked: PlanningRequest
    plan: VisitPlan
    learnt: Mapping[str, Mapping[str, Learnt]]
    """By person and parameter, of those with whom something was learnt."""
    kept_as: Mapping[str, str | None]
    """By person, the name under which meetings are remembered; None where they are not."""
    attend_s: float
    """How long the robot watches how each person takes its coming."""
    happenings: tuple[Happening, ...]
    """What happens while the plan is carried out."""
    speaker: Speaker
    """What the robot says, and how it addresses people."""
    engine: str
    """Who plans, also when things change."""
    without_visit: tuple[tuple[UnservedCase, str], ...]
    """Those whom no plan can serve, each with the reason; the plan is for the others."""

    @property
    def unmet(self) -> tuple[Unmet, ...]:
        """Their goals, with what stands in the way: found again when asked, by trying other worlds."""
        return tuple(diagnose(case, reason) for case, reason in self.without_visit)


@dataclass(frozen=True, slots=True)
class ResolvedScenario:
    """A scenario with all its questions answered that take no planning."""

    file: ScenarioFile
    """With everybody placed."""
    cast: Cast
    values: Mapping[str, Inference]
    visitees: tuple[Visitee, ...]
    scene: Scene
    changes: tuple[Happening, ...]


def resolved(
    file: ScenarioFile,
    *,
    profiles: Mapping[str, ProfileGiven] | None = None,
    rulebook: str | None = None,
    at: date | None = None,
    learnt: Mapping[str, Mapping[str, Learnt]] | None = None,
    seed: int = 0,
) -> ResolvedScenario:
    """Who is where, what they would like and what happens on the way, checked without a plan.

    Args:
        file: The scenario.
        profiles: As for `prepare`, like all that follows.
        rulebook: Another one.
        at: Another day.
        learnt: What earlier meetings taught.
        seed: For random places.

    Raises:
        InputError: if anything that a user wrote cannot be used.
    """
    file = placed(file, seed)
    cast = cast_of(file, profiles=profiles, rulebook=rulebook, at=at, learnt=learnt)
    require_gestures(file, cast.rulebook)
    values = cast.values()
    visitees = tuple(_visitee(cast, name, values[name]) for name in file.scenario.visited())
    facts = margin_facts(file.scenario, cast.declared, cast.day)
    scene = scene_of(file, values, seed, margin_facts=facts)
    require_margin(file, scene)
    file.goal_check.places(places(scene))
    changes = Changes(cast, scene).happenings()
    Faults(file, scene, leaves=()).require_doors()
    return ResolvedScenario(file, cast, values, visitees, scene, changes)


def require_seed(seed: object) -> None:
    """Refuse what no random numbers can be drawn from.

    Raises:
        InputError: It is no whole number of 0 or more.
    """
    if isinstance(seed, bool) or not isinstance(seed, Integral) or int(seed) < 0:
        raise InputError(
            expected="as seed a whole number of 0 or more", got=repr(seed), remedy="Give one, such as 0."
        )


def prepare(
    file: ScenarioFile,
    *,
    profiles: Mapping[str, ProfileGiven] | None = None,
    rulebook: str | None = None,
    at: date | None = None,
    learn: bool = False,
    learnt: Mapping[str, Mapping[str, Learnt]] | None = None,
    seed: int = 0,
    engine: str = ENGINE,
) -> PlannedEpisode:
    """Answer all questions of a scenario and plan.

    Args:
        file: The scenario.
        profiles: Other profiles than the scenario's, by person: shipped or stored names, files, or profiles
            written out.
        rulebook: Another rulebook than the scenario's: a shipped name or a file.
        at: Another day than the scenario's to take dated facts on.
        learn: Whether the robot is to see how everybody takes its coming, also where nobody reacts.
        learnt: What earlier meetings taught, by person and parameter; None for what is remembered of them.
        seed: For random places; that of the episode.
        engine: Who plans: `comity`, or an engine by the name that unified-planning has for it.

    Raises:
        InputError: if anything that a user wrote cannot be used.
        GoalsUnmet: if no plan meets the goals, or none was found.
    """
    stage = resolved(file, profiles=profiles, rulebook=rulebook, at=at, learnt=learnt, seed=seed)
    file, cast, values, scene = stage.file, stage.cast, stage.values, stage.scene
    visitees, route_map = stage.visitees, RouteMap(scene)
    attend_s = _attend_s(file.scenario, learn=learn)
    asked = ask(scene, route_map, visitees, groups=file.scenario.groups, attend_s=attend_s)
    asked, plan = _plan(asked, scene, route_map, file, engine)
    leaves = leaves_of(plan, values, Limits.attentive(attend_s)) if file.scenario.faults else ()
    return PlannedEpisode(
        file=file,
        chosen=cast.chosen,
        rulebook=cast.rulebook,
        day=cast.day,
        profiles={name: declared.profile for name, declared in cast.declared.items()},
        values=values,
        scene=scene,
        route_map=route_map,
        visitees=visitees,
        asked=asked,
        plan=plan,
        happenings=(*stage.changes, *Faults(file, scene, leaves).happenings()),
        engine=engine,
        without_visit=tuple(
            (_case(cast, scene, visitee), asked.unreachable[visitee.name])
            for visitee in visitees
            if visitee.name in asked.unreachable
        ),
        learnt=cast.learnt,
        kept_as={name: declared.kept_as for name, declared in cast.declared.items()},
        attend_s=attend_s,
        speaker=cast.speaker,
    )


def _plan(
    asked: PlanningRequest, scene: Scene, route_map: RouteMap, file: ScenarioFile, engine: str
) -> tuple[PlanningRequest, VisitPlan]:
    limits = file.scenario.limits
    ends_s = monotonic() + limits.planning_s
    make = partial(plan_with, engine, time_limit_s=limits.planning_s)
    try:
        return plan_for_most(asked, scene, route_map, make)
    except PlanningFailed as failed:
        raise _goals_unmet(failed, asked, limits.planning_s, ends_s=ends_s) from None


def _goals_unmet(
    failed: PlanningFailed, asked: PlanningRequest, planning_s: float, *, ends_s: float
) -> GoalsUnmet:
    """Which goal fails and why, or that the time did not do to know, and which setting gives more."""
    found = diagnose_deadlines(asked.request, ends_s=ends_s)
    cut_off = failed.cut_off or not found.in_time
    sentences = [in_words(goal) for goal in found.unmet] or ([] if failed.cut_off else [failed.remedy])
    if not found.complete:
        which = "Whether other" if found.unmet else "Which" if isinstance(failed, NoPlan) else "Whether"
        sentences.append(f"{which} deadlines stand in the way is not known.")
    if cut_off:
        sentences.append(
            f"For more time, write `limits: {{planning_s: {4 * planning_s:g}}}` into the scenario: it is "
            f"{planning_s:g} now, in seconds."
        )
    return GoalsUnmet(failed.reason, remedy=" ".join(sentences), unmet=found.unmet, cut_off=cut_off)


def _case(cast: Cast, scene: Scene, visitee: Visitee) -> UnservedCase:
    """A person who cannot be reached, and how they would be met without some of their wishes."""
    settings = cast.declared[visitee.name].profile.settings
    return UnservedCase(scene, visitee, partial(_values_without, cast, visitee.name), tuple(settings))


def _values_without(cast: Cast, person: str, dropped: Sequence[str]) -> Inference:
    """A person's values, had they not these wishes."""
    settings = cast.declared[person].profile.settings
    return cast.values_wishing(person, {name: wish for name, wish in settings.items() if name not in dropped})


def _attend_s(scenario: Scenario, *, learn: bool) -> float:
    if scenario.limits.attend_s is not None:
        return scenario.limits.attend_s
    return ATTEND_S if learn or any(person.comfort for person in scenario.people.values()) else 0.0


def _visitee(cast: Cast, name: str, values: Inference) -> Visitee:
    scenario = cast.file.scenario
    goal = next(goal for goal in scenario.goals if goal.greet == name)
    profile = cast.declared[name].profile
    now = circumstances(scenario, name, values, cast.rulebook, profile=profile, day=cast.day)
    try:
        manner_of(values)  # what the acts read means what they take it for, or the world never starts
        cast.speaker.wordings_of(values, name)
        return Visitee(
            name,
            values,
            now,
            priority_m=goal.priority or 0.0,
            by_s=goal.by_s,
            skip_m=goal.skip,
            after=goal.after,
            not_from=frozenset(goal.not_from or ()),
            agenda=agenda_of(scenario.goals, name),
        )
    except InputError as error:
        raise error.at(cast.chosen.where) from None
