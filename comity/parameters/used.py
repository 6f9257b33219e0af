"""The part of a profile that a rulebook uses: facts that its rules read on a given day, and settings."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from datetime import date
from typing import TYPE_CHECKING, Any

from comity.parameters.consent import CONSENT
from comity.parameters.perception import is_read
from comity.people.adulthood import AGE_BAND, is_under_age
from comity.people.profile import Profile
from comity_domain.problem.bound_parameters import GREETING_LANGUAGE
from comity_fis import Interval

ADDRESS = "form_of_address"
"""A fact that no rule reads, but that the robot's speech uses."""

if TYPE_CHECKING:
    from comity.people.profile import Declared
    from comity_fis import Rulebook


def used_facts(rulebook: Rulebook) -> frozenset[str]:
    """Facts read by an enabled rule or a requirement; always consent, as it can exclude contact."""
    read = rulebook.program.reads & rulebook.variables.keys()
    derivations = (rulebook.variables[name].derived_from for name in read)
    return frozenset({*read, *(one.fact for one in derivations if one), CONSENT})


def reads_languages(rulebook: Rulebook) -> bool:
    """Whether a person's stated languages affect a rule or the language of speech."""
    return "language" in used_facts(rulebook) or GREETING_LANGUAGE in rulebook.parameters


def used_of(
    declared: Declared, rulebook: Rulebook, day: date | None, *, also: Collection[str] = ()
) -> Declared:
    """A person's profile reduced to what the rulebook uses: no prose, dates or unread facts.

    Args:
        declared: The person's validated profile.
        rulebook: The rulebook.
        day: Day of the facts; required if some depend on it.
        also: Facts that something other than the rulebook reads.
    """
    used = used_facts(rulebook).union(also)
    return replace(declared, profile=Profile.model_validate(_used(declared.profile, rulebook, day, used)))


def _used(profile: Profile, rulebook: Rulebook, day: date | None, used: Collection[str]) -> dict[str, Any]:
    told = profile.facts(day)
    facts = {name: fact for name, fact in told.items() if name in used or is_read(name, fact)}
    if is_under_age(profile, day):  # read by the protection of children
        facts.update((name, told[name]) for name in ("age", AGE_BAND) if name in told)
    if profile.form_of_address is not None:  # used in speech
        facts[ADDRESS] = profile.form_of_address
    if reads_languages(rulebook) and (languages := told.get("languages")):
        facts["languages"] = languages
    if isinstance(
        facts.get("age"), Interval
    ):  # a year of birth gives one of two ages, which a profile cannot state
        del facts["age"]
        facts["birth_year"] = profile.birth_year
    other = {name: facts.pop(name) for name in profile.other if name in facts}
    culture = _cultures(profile, day) if "culture" in used else {}
    return {"name": profile.name, **culture, **facts, "other": other, "settings": profile.settings}


def _cultures(profile: Profile, day: date | None) -> dict[str, Any]:
    """The cultures that apply on the day, without their dates."""
    culture: Any = profile.culture
    if isinstance(culture, tuple):
        counting = [one for one in culture if one.counts(day)]
        culture = tuple(one.model_copy(update={"from_": None, "until": None}) for one in counting)
    return {"culture": culture, "region": profile.region} if culture else {}
