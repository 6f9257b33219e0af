"""Infers the parameters of the robot's actions from a person's profile."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field, replace
from datetime import date
from typing import TYPE_CHECKING

from comity.parameters.consent import (
    CONSENT,
    NO_TOUCH_NOTE,
    asks_for_no_touch,
    note_of_rest,
    refuse_contact_without_touch,
    resting,
)
from comity.parameters.language import in_a_stated_language, stated_languages
from comity.parameters.own_words import own_words
from comity.parameters.perception import perceiving
from comity.parameters.standing import WeightedCulture, reads_culture, standing
from comity.parameters.unread_facts import notes_of_unread_facts
from comity.parameters.wishes import decided_here
from comity.people.adulthood import NOTE, is_under_age
from comity.people.culture import Belonging
from comity.people.dated import UNKNOWN
from comity.people.profile import PERSONAL
from comity_domain import refuse_gesture_in_words
from comity_fis import InputError, Interval, Part, Where, mixed, unknown_word
from comity_fis.errors import WrongValueError
from comity_fis.validation.one_line import one_line

if TYPE_CHECKING:
    from comity.people.profile import Declared
    from comity_fis import Inference, Learnt, Rulebook
    from comity_fis.variables.parameter import Category

Fact = float | str | Interval | None
"""A fact; None, or the word `unknown`, if it is unknown."""

Facts = Mapping[str, Fact]
"""Facts by variable."""


def infer_for(
    declared: Declared,
    rulebook: Rulebook,
    *,
    situation: Facts | None = None,
    mode: str = "exact",
    at: date | None = None,
    learnt: Mapping[str, Learnt] | None = None,
    site: str | None = None,
) -> Inference:
    """Infer one person's parameters in one situation.

    For a person of several cultures, the values for each are combined by weight.

    Args:
        declared: The person's profile.
        rulebook: The rulebook.
        situation: The current situation, by variable; it takes precedence over the profile.
        mode: How the centroid is computed: exact, matlab or skfuzzy.
        at: Day of the facts; required if some depend on it.
        learnt: Corrections learnt from encounters with the person, by parameter.
        site: ISO 639-3 code of the site's language; None without a site.

    Raises:
        InputError: A fact is outside its variable's domain, a setting cannot be granted, or the day is
            missing; with the line of the profile if it is in there.
    """
    told = situation or {}
    _refuse_unspeakable(told)
    inference = _by_culture(declared, rulebook, told, mode=mode, at=at, learnt=learnt)
    if is_under_age(declared.profile, at, told.get("age")):
        inference = replace(inference, notes=(*inference.notes, NOTE))
    stated = stated_languages(declared.profile, at, told)

    def without_culture() -> Inference:
        nothing = {**told, **_no_culture(rulebook)}
        return _by_culture(declared, rulebook, nothing, mode=mode, at=at, learnt=learnt)

    inference = in_a_stated_language(inference, stated, site, without_culture)
    return perceiving(inference, declared.profile, at, told)


def _refuse_unspeakable(told: Facts) -> None:
    """Reject words that are not one printable line, and a culture that is not a word."""
    for name, fact in told.items():
        if isinstance(fact, str):
            try:
                one_line(fact)
            except WrongValueError as error:
                raise error.at(Where(name)) from None
        elif name == "culture" and fact is not None:
            raise InputError(
                expected="one culture, such as 'SWE'",
                got=repr(fact),
                remedy="Write several into a profile, as in {'culture': {'EGY': 1, 'SWE': 2}}.",
                where=Where(name),
            )


def _by_culture(
    declared: Declared,
    rulebook: Rulebook,
    told: Facts,
    *,
    mode: str,
    at: date | None,
    learnt: Mapping[str, Learnt] | None,
) -> Inference:
    """The values for each of the person's cultures, combined by weight."""
    cases = cases_of(declared, rulebook, situation=told, at=at)
    parts = [
        Part(
            case.name,
            case.weight,
            replace(
                rulebook.infer(case.inputs, settings=case.settings, mode=mode, learnt=learnt),
                notes=case.notes,
                sources=case.sources,
            ),
        )
        for case in cases
    ]
    return parts[0].inference if len(parts) == 1 else mixed(parts, rulebook.parameters)


def _no_culture(rulebook: Rulebook) -> Facts:
    """Inputs that mark a person's culture, and everything derived from it, as unknown."""
    return {"culture": None} | {variable.name: None for variable in reads_culture(rulebook)}


@dataclass(frozen=True, slots=True)
class CultureCase:
    """A person's inputs by one of their cultures."""

    name: str
    """Name of the culture; empty for a person who declared none."""
    weight: float
    inputs: Mapping[str, Fact]
    """Known inputs, by variable of the rulebook."""
    settings: Mapping[str, float | str]
    """Settings that the rulebook defines and can grant, by parameter."""
    rests: Mapping[str, Category]
    """Settings that are suspended without consent, by parameter."""
    notes: tuple[str, ...] = ()
    sources: Mapping[str, str] = field(default_factory=dict)
    """Sources of inputs that the person did not declare, by variable."""


def cases_of(
    declared: Declared, rulebook: Rulebook, *, situation: Facts | None = None, at: date | None = None
) -> tuple[CultureCase, ...]:
    """The rulebook's inputs for a person: one case per culture, or a single one.

    Raises:
        InputError: As for `infer_for`.
    """
    now, heard = _told_now(situation or {}, rulebook)
    facts, notes, standings = _checked(declared, rulebook, at)
    notes = tuple(dict.fromkeys((*notes, *heard)))
    if "culture" in now:
        words = now.pop("culture")
        standings = (standing(Belonging(UNKNOWN if words is None else str(words)), rulebook),)
    wishes, unheard = decided_here(declared.profile.settings, rulebook)
    notes = (*notes, *unheard)
    if asks_for_no_touch(declared.profile.settings, rulebook):
        now[CONSENT] = "withheld"
        notes = (*notes, NO_TOUCH_NOTE)
    told = [
        (one.label, one.weight, _inputs(rulebook, {**one.facts, **facts, **now}), one.notes, one.sources)
        for one in standings
    ] or [("", 1.0, _inputs(rulebook, {**facts, **now}), (), {})]
    for _, _, inputs, _, _ in told:
        rulebook.checked_inputs(inputs)  # before the settings, whose location in the file differs
    rests = resting(wishes, (inputs for _, _, inputs, _, _ in told), rulebook)
    notes = (*notes, *(note_of_rest(name, category) for name, category in rests.items()))
    settings = {name: wish for name, wish in wishes.items() if name not in rests}
    return tuple(
        CultureCase(name, weight, inputs, settings, rests, (*own, *notes), _left(sources, {**facts, **now}))
        for name, weight, inputs, own, sources in told
    )


def _left(sources: Mapping[str, str], told: Facts) -> Mapping[str, str]:
    """Sources of the variables that were not stated directly."""
    return {name: source for name, source in sources.items() if name not in told}


def _told_now(situation: Facts, rulebook: Rulebook) -> tuple[dict[str, Fact], tuple[str, ...]]:
    """The facts stated for the encounter in the rulebook's terms; None if unknown."""
    told = {name: None if fact == UNKNOWN else fact for name, fact in situation.items()}
    heard, notes = own_words(told, rulebook)
    return {name: heard.get(name) for name in told}, (*notes, *notes_of_unread_facts(told, rulebook))


def refuse_unknown(facts: Facts, rulebook: Rulebook, place: str) -> None:
    """Reject a fact that the rulebook does not accept, most likely a typo.

    `PERSONAL` facts and consent to touch are accepted by all rulebooks.
    """
    for name in facts:
        if name not in rulebook.facts and name not in (*PERSONAL, CONSENT):
            raise unknown_word(
                f"a variable of the rulebook {rulebook.name} in {place}", name, rulebook.variables
            )


def _checked(
    declared: Declared, rulebook: Rulebook, at: date | None
) -> tuple[Facts, tuple[str, ...], tuple[WeightedCulture, ...]]:
    """Facts, notes and cultures of a profile, each validated separately, so that errors have a line."""
    profile = declared.profile
    with _placing(declared, *profile.location("age")):
        facts, notes = own_words(profile.facts(at), rulebook)
    notes = (*notes, *notes_of_unread_facts({"culture": profile.culture, **profile.facts(at)}, rulebook))
    for name, fact in facts.items():
        with _placing(declared, *profile.location(name, at)):
            rulebook.checked_inputs(_inputs(rulebook, {name: fact}))
    standings = tuple(_standings(declared, rulebook, at))
    _refuse_idle_region(declared, standings)
    wishes, _ = decided_here(profile.settings, rulebook)
    for name, wish in wishes.items():
        with _placing(declared, "settings", name):
            rulebook.checked_settings({name: wish})
    with _placing(declared, "settings", "greeting_gesture"):
        refuse_gesture_in_words(profile.settings)
        refuse_contact_without_touch(profile.settings, rulebook)
    return facts, notes, standings


def _standings(declared: Declared, rulebook: Rulebook, at: date | None) -> Iterator[WeightedCulture]:
    for belonging in declared.profile.cultures(at):
        with _placing(declared, *belonging.location):
            yield standing(belonging, rulebook)


def _refuse_idle_region(declared: Declared, standings: tuple[WeightedCulture, ...]) -> None:
    """Reject a region that would silently be ignored, as all cultures have scores."""
    region = declared.profile.region
    if region is None or any(one.notes or one.region == region or not one.facts for one in standings):
        return
    if standings:
        with _placing(declared, "region"):
            raise InputError(
                expected="a culture without a score of its own beside `region`",
                got=", ".join(one.label for one in standings),
                remedy="Remove `region`, or write it as the culture.",
            )


def _inputs(rulebook: Rulebook, known: Facts) -> dict[str, Fact]:
    """The rulebook's inputs; None blocks the derivation of a variable from another fact."""
    return {
        name: fact
        for name, fact in known.items()
        if name in rulebook.facts and (fact is not None or name in rulebook.variables)
    }


def _placing(declared: Declared, *location: str | int) -> AbstractContextManager[None]:
    return declared.file.placing(*location) if declared.file else nullcontext()
