"""Declared facts that decide whether a robot may pass a person at the scenario's reduced margin.

Culture, gender and preferences play no part. An unknown fact counts against it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from datetime import date
from typing import TYPE_CHECKING

from comity.parameters.acquaintance import situation_of
from comity.parameters.perception import NOTHING
from comity_fis import Interval
from comity_fis.proxemics import PERSON_MARGIN_M
from comity_sim2d.scene.margin_facts import MarginFacts

if TYPE_CHECKING:
    from comity.people.profile import Declared, Profile
    from comity.scenario import Scenario

MARGIN_FACTS = ("age", "hearing", "sight", "mobility")
UNIMPAIRED = frozenset({"full", "good", "normal", "unimpaired"})
"""Words for unimpaired hearing, sight and mobility; no other word counts."""

DENIED = frozenset({"no", "not", "never", "without"})
"""Words with which a mobility that names a wheelchair declares none."""


def reads_margin_facts(scenario: Scenario) -> bool:
    """Whether the scenario has a reduced margin, which depends on declared facts."""
    return scenario.robot.margin_m < PERSON_MARGIN_M


def margin_facts(
    scenario: Scenario, declared: Mapping[str, Declared], day: date | None
) -> dict[str, MarginFacts]:
    """Margin facts by person; empty if the scenario has no reduced margin.

    A person's later changes in the scenario count from the start: the least favourable applies. So does a
    posture declared in the profile, if the scenario has the person stand.

    Args:
        scenario: The scenario, with people's situations.
        declared: Profiles by name.
        day: Day of dated facts.
    """
    if not reads_margin_facts(scenario):
        return {}
    told = {
        name: [one.situation for one in scenario.changes if one.person == name and one.situation]
        for name in scenario.people
    }
    return {
        name: margin_facts_of(one.profile, day, situation_of(scenario.people[name]), told[name])
        for name, one in declared.items()
    }


def margin_facts_of(
    profile: Profile,
    day: date | None,
    situation: Mapping[str, object] = NOTHING,
    later: Iterable[Mapping[str, object]] = (),
) -> MarginFacts:
    """Margin facts of one person.

    Args:
        profile: The person's profile.
        day: Day of dated facts; None: today.
        situation: Facts stated for the encounter, which take precedence over the profile.
        later: Facts of the person after each later change.
    """
    declared = profile.facts(day or date.today())
    now = {**declared, **situation}
    posture = {name: fact for name, fact in declared.items() if name == "posture"}
    each = [_facts({**now, **told}) for told in (NOTHING, posture, *later)]
    known = [one.age_years for one in each if one.age_years is not None]
    return MarginFacts(
        age_years=min(known) if len(known) == len(each) else None,
        walks_unaided=all(one.walks_unaided for one in each),
        uses_wheelchair=any(one.uses_wheelchair for one in each),
        hears_well=all(one.hears_well for one in each),
        sees_well=all(one.sees_well for one in each),
        stands=all(one.stands for one in each),
        words=tuple(dict(pair for one in reversed(each) for pair in one.words).items()),
    )


def _facts(facts: Mapping[str, object]) -> MarginFacts:
    age = facts.get("age")
    age = age.low if isinstance(age, Interval) else age
    return MarginFacts(
        age_years=float(age) if isinstance(age, int | float) else None,
        walks_unaided=_is_unimpaired(facts.get("mobility")),
        uses_wheelchair=_is_wheelchair(facts.get("mobility")),
        hears_well=_is_unimpaired(facts.get("hearing")),
        sees_well=_is_unimpaired(facts.get("sight")),
        stands=facts.get("posture", "standing") == "standing",
        words=tuple(
            (name, str(word))
            for name in MARGIN_FACTS[1:]
            if (word := facts.get(name)) is not None and not _is_unimpaired(word)
        ),
    )


def _is_unimpaired(word: object) -> bool:
    return str(word).strip().casefold() in UNIMPAIRED


def _is_wheelchair(words: object) -> bool:
    told = str(words).casefold().split()
    return "wheelchair" in told and DENIED.isdisjoint(told)
