"""Who of a scenario is known from earlier meetings, and what a visit adds to that."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import date
from typing import TYPE_CHECKING

from comity.learnt_file import PARAMETER, Observation, learnt_on
from comity.remembered import remembered, remembered_as
from comity_fis import Learnt, NumericParameter

if TYPE_CHECKING:
    from comity.fact import Fact
    from comity.profile import Declared
    from comity.scenario import Person, ScenarioFile
    from comity_executor import Visit
    from comity_fis import Inference, ParameterValue, Rulebook


def situation_of(person: Person) -> dict[str, Fact]:
    """What holds around a person, by variable."""
    return {"posture": person.posture, **person.situation}


def learnt_with(
    file: ScenarioFile,
    others: Mapping[str, str],
    declared: Mapping[str, Declared],
    rulebook: Rulebook,
    day: date | None,
) -> dict[str, dict[str, Learnt]]:
    """What earlier meetings taught, by person and parameter.

    What the scenario embeds goes before the store, in which only those are looked up whose profile the
    scenario or the command line names.

    Args:
        file: The scenario.
        others: Other profiles than the scenario's, by person.
        declared: Everybody's profile.
        rulebook: It has the spread of people around its values.
        day: Preferences have drifted until then; None for today.
    """
    known: dict[str, dict[str, Learnt]] = {}
    parameter = rulebook.parameters.get(PARAMETER)
    for name, person in file.scenario.people.items():
        if person.learnt is not None and name not in others:
            known[name] = {about: value.as_learnt() for about, value in person.learnt.items()}
            continue
        kept = kept_as(file, others, declared, name)
        document = remembered(kept) if kept else None
        if document and isinstance(parameter, NumericParameter):
            seen = document.in_situation(situation_of(person))
            learnt = learnt_on(day or date.today(), seen, parameter.spread)
            if learnt:
                known[name] = {PARAMETER: learnt}
    return known


def kept_as(
    file: ScenarioFile, others: Mapping[str, str], declared: Mapping[str, Declared], person: str
) -> str | None:
    """The name under which meetings with a person of a scenario are remembered; None where they are not."""
    named = others.get(person, file.scenario.people[person].profile)
    return remembered_as(named, declared[person].profile) if isinstance(named, str) else None


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
    value = values[PARAMETER]
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
    return sum(float(part.value) for part in value.contributions if part.origin not in ("learnt", "safety"))
