"""Consent to touch that an operator passes on, in the meeting that is under way."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from comity.parameters.consent import CONSENT
from comity.parameters.in_run import infer_in_run
from comity.people.profile import Declared
from comity.simulation.changes import said_by
from comity.specification.goals import agenda_of
from comity_domain.problem.bound_parameters import DISTANCE

if TYPE_CHECKING:
    from comity.preparation import PlannedEpisode
    from comity_fis import Inference


def consenting(prepared: PlannedEpisode, own: Inference, person: str, *, given: bool, t: float) -> Inference:
    """A person's parameters once they consent to touch, or do not.

    Args:
        prepared: The scenario.
        own: Their parameters before that; how near an operator nudged the robot stays.
        person: Who.
        given: Whether they consent.
        t: When, in the time of the episode [s]: what they said until then counts.

    Raises:
        InputError: if the rulebook cannot be told.
    """
    declared = Declared(prepared.profiles[person], None)
    asking, situation = said_by(prepared.file, declared, person, t)
    values = infer_in_run(
        asking,
        prepared.rulebook,
        situation={**situation, CONSENT: "given" if given else "withheld"},
        at=prepared.day,
        learnt=prepared.learnt.get(person),
        site=prepared.speaker.site,
        agenda=agenda_of(prepared.file.scenario.goals, person),
    )
    if own[DISTANCE].origin != "operator":
        return values
    return replace(values, parameters={**values.parameters, DISTANCE: own[DISTANCE]})
