"""Who of a scenario is known from earlier meetings, and what a visit adds to that."""

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
"""The posture where none is told: nobody is met lying down unless a person says so."""


def situation_of(person: PersonSpec) -> dict[str, Fact]:
    """What holds around a person of a scenario, by variable."""
    return {"posture": person.posture, **person.situation}


def usual_situation(declared: Declared, day: date | None) -> dict[str, Fact]:
    """What holds around a person where nothing is told of it: the posture that they declared, or standing.

    Args:
        declared: Who it is.
        day: On which; None for today.
    """
    posture, _ = held(declared.profile.posture, day or date.today())
    return {"posture": posture.casefold() if posture else STANDING}


def learnt_about(
    declared: Declared, rulebook: Rulebook, situation: Mapping[str, object], day: date | None
) -> dict[str, Learnt]:
    """What earlier meetings with a person who is kept in the store taught, by parameter.

    Args:
        declared: Who it is.
        rulebook: It has the spread of people around its values.
        situation: Only what was seen in the same one counts.
        day: Preferences have drifted until then; None for today. What is known of a child counts for nothing.

    Raises:
        InputError: if the file in the store was damaged.
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
    """How near the robot comes to a stored person in a situation, with what that is made of.

    Args:
        declared: The person.
        rulebook: The rules.
        situation: By variable; what the rulebook does not know is left out.
        day: Of the facts.
    """
    told = {name: fact for name, fact in situation.items() if name in rulebook.variables}
    learnt = learnt_about(declared, rulebook, situation, day)
    at = day_for(day, declared.profile)
    return infer_for(declared, rulebook, situation=told, at=at, learnt=learnt)[DISTANCE]


def learnt_here(
    declared: Declared, rulebook: Rulebook, told: Mapping[str, object], day: date | None
) -> dict[str, Learnt]:
    """The same where only some facts are told: those of the situation, else the person's usual one.

    Args:
        declared: Who it is.
        rulebook: It knows which variables describe a situation.
        told: By variable.
        day: Preferences have drifted until then; None for today.

    Raises:
        InputError: if the file in the store was damaged.
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
    """What earlier meetings taught about the people of a scenario, by person and parameter.

    What the scenario embeds goes before the store.

    Args:
        file: The scenario.
        others: Who has another profile than the scenario's.
        declared: Everybody's profile.
        rulebook: It has the spread of people around its values.
        day: Preferences have drifted until then; None for today.
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
    """What a visit adds to what is known; None where nobody looked, or where the person said what they want.

    Args:
        visit: How it went.
        values: The parameters it was made with.
        situation: What held around the person.
        day: When it was.
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
    """What culture and situation alone give."""
    others = ("learnt", "safety", "operator")
    return sum(float(part.value) for part in value.contributions if part.origin not in others)
