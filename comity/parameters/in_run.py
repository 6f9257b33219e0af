"""A person's parameters in a run, which includes only profile data that a rule or setting used."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from comity.parameters.consent import in_this_meeting
from comity.parameters.perception import notes_of_unheard
from comity.parameters.unread import noting_unread
from comity.parameters.unread_facts import notes_for_a_run
from comity.parameters.used import used_of
from comity.parameters.values import Facts, cases_of, infer_for

if TYPE_CHECKING:
    from datetime import date

    from comity.people.profile import Declared
    from comity_domain import Task
    from comity_fis import Inference, Learnt, Rulebook


def infer_in_run(
    declared: Declared,
    rulebook: Rulebook,
    *,
    situation: Facts,
    at: date | None,
    learnt: Mapping[str, Learnt] | None,
    site: str | None,
    agenda: Sequence[Task],
    also: Collection[str] = (),
) -> Inference:
    """The values of `infer_for`, with inputs and notes limited to what rules read.

    Consent to touch is the exception: it is taken from the situation, as a run is an encounter.

    Args:
        declared: The person's profile.
        rulebook: The rulebook.
        situation: The current situation, by variable.
        at: Day of the facts.
        learnt: Corrections learnt from earlier encounters, by parameter.
        site: ISO 639-3 code of the site's language.
        agenda: Tasks of the visit; empty for a person whom no goal names.
        also: Facts that something other than the rulebook reads.

    Raises:
        InputError: As for `infer_for`, or if no rule reads a fact.
    """
    situation, stored = in_this_meeting(situation, declared.profile, at)
    cases_of(declared, rulebook, situation=situation, at=at)
    used = used_of(declared, rulebook, at)
    values = noting_unread(
        infer_for(used, rulebook, situation=situation, at=at, learnt=learnt, site=site), rulebook
    )
    profile = declared.profile
    told = {"culture": profile.culture, **profile.facts(at)}
    unread = notes_for_a_run({name: told[name] for name in told if name not in also}, rulebook)
    unheard = notes_of_unheard(values, agenda)
    return replace(values, notes=(*values.notes, *stored, *unread, *unheard))
