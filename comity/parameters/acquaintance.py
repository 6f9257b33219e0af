"""What is known about a scenario's people from earlier encounters, and what a visit adds."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from datetime import date
from typing import TYPE_CHECKING

from comity.parameters.own_words import in_the_rulebooks_case
from comity.parameters.values import infer_for
from comity.people.adulthood import is_under_age
from comity.people.dated import held
from comity.people.learnt_file import Observation, learnt_on
from comity.people.profile import day_for
from comity.people.remembered import remembered
from comity_domain.problem.bound_parameters import DISTANCE
from comity_fis import Learnt, NumericParameter

if TYPE_CHECKING:
    from comity.people.fact import Fact
    from comity.people.profile import Declared
    from comity.scenario import PersonSpec, ScenarioFile
    from comity_executor import Visit
    from comity_fis import Inference, ParameterValue, Rulebook


STANDING = "standing"
"""Default posture: nobody is assumed to lie down unless stated."""


def situation_of(person: PersonSpec) -> dict[str, Fact]:
    """The situation of a person in a scenario, by variable."""
    return {"posture": person.posture, **person.situation}


def usual_situation(declared: Declared, day: date | None) -> dict[str, Fact]:
    """A person's usual situation: their declared posture, or standing.

    Args:
        declared: The person's profile.
        day: The day; None: today.
    """
    posture, _ = held(declared.profile.posture, day or date.today())
    return {"posture": posture.casefold() if posture else STANDING}


def learnt_about(
    declared: Declared, rulebook: Rulebook, situation: Mapping[str, object], day: date | None
) -> dict[str, Learnt]:
    """What earlier encounters with a stored person taught, by parameter.

    Args:
        declared: The person's profile.
        rulebook: Gives the standard deviation between individuals.
        situation: Only observations in this situation count.
        day: Preferences drift until this day; None: today. Data about children are ignored.

    Raises:
        InputError: The stored file is damaged.
    """
    parameter = rulebook.parameters.get(DISTANCE)
    if declared.kept_as is None or not isinstance(parameter, NumericParameter):
        return {}
    if is_under_age(declared.profile, day):
        return {}
    document = remembered(declared.kept_as)
    if document is None:
        return {}
    learnt = learnt_on(day or date.today(), document.in_situation(situation), parameter.spread)
    return {DISTANCE: learnt} if learnt else {}


def met_at(
    declared: Declared, rulebook: Rulebook, situation: Mapping[str, Fact], day: date
) -> ParameterValue:
    """The robot's distance to a stored person in a situation, with its contributions.

    Args:
        declared: The person's profile.
        rulebook: The rulebook.
        situation: Situation by variable; unknown variables are ignored.
        day: Day of the facts.
    """
    told = {name: fact for name, fact in situation.items() if name in rulebook.variables}
    learnt = learnt_about(declared, rulebook, situation, day)
    at = day_for(day, declared.profile)
    return infer_for(declared, rulebook, situation=told, at=at, learnt=learnt)[DISTANCE]


def learnt_here(
    declared: Declared, rulebook: Rulebook, told: Mapping[str, object], day: date | None
) -> dict[str, Learnt]:
    """`learnt_about` for a partly stated situation, completed by the person's usual one.

    Args:
        declared: The person's profile.
        rulebook: Defines which variables describe a situation.
        told: Stated facts, by variable.
        day: Preferences drift until this day; None: today.

    Raises:
        InputError: The stored file is damaged.
    """
    variables = rulebook.variables
    here = {
        name: in_the_rulebooks_case(fact, name, rulebook)
        for name, fact in told.items()
        if name in variables and variables[name].kind == "situation"
    }
    return learnt_about(declared, rulebook, {**usual_situation(declared, day), **here}, day)


def learnt_with(
    file: ScenarioFile,
    others: Collection[str],
    declared: Mapping[str, Declared],
    rulebook: Rulebook,
    day: date | None,
) -> dict[str, dict[str, Learnt]]:
    """What earlier encounters taught about the people of a scenario, by person and parameter.

    Data in the scenario take precedence over the store.

    Args:
        file: The scenario.
        others: People with another profile than the scenario's.
        declared: All profiles, by person.
        rulebook: Gives the standard deviation between individuals.
        day: Preferences drift until this day; None: today.
    """
    known: dict[str, dict[str, Learnt]] = {}
    for name, person in file.scenario.people.items():
        if is_under_age(declared[name].profile, day):
            continue
        if person.learnt is not None and name not in others:
            known[name] = {about: value.as_learnt() for about, value in person.learnt.items()}
        elif learnt := learnt_about(declared[name], rulebook, situation_of(person), day):
            known[name] = learnt
    return known


def observation(
    visit: Visit, values: Inference, situation: Mapping[str, Fact], day: date
) -> Observation | None:
    """The observation from a visit; None without one, or if the person has a setting.

    Args:
        visit: The visit.
        values: The person's parameters during the visit.
        situation: The person's situation.
        day: Day of the visit.
    """
    value = values[DISTANCE]
    if visit.noticed is None or any(part.origin == "setting" for part in value.contributions):
        return None
    return Observation(
        day=day,
        situation=dict(situation),
        model_m=round(model_m(value), 4),
        distance_m=round(max(0.0, visit.noticed.distance_m), 4),
        signal=visit.noticed.kind,
    )


def model_m(value: ParameterValue) -> float:
    """The value by culture and situation alone [m]."""
    others = ("learnt", "safety", "operator")
    return sum(float(part.value) for part in value.contributions if part.origin not in others)
