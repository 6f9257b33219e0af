"""The language for a person: one that they stated or requested, else the site's.

Rules may only choose among a person's stated languages. Nationality never determines a language.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from datetime import date
from typing import TYPE_CHECKING

from comity.people.dated import held
from comity.people.language import iso639
from comity_domain.problem.bound_parameters import GREETING_LANGUAGE
from comity_fis import Choice, Contribution

if TYPE_CHECKING:
    from comity.people.profile import Profile
    from comity_fis import Inference, ParameterValue


def in_a_stated_language(
    values: Inference, stated: Sequence[str], site: str | None, without_culture: Callable[[], Inference]
) -> Inference:
    """A person's parameters, with a language that they stated or requested, or else the site's.

    Args:
        values: The inferred parameters.
        stated: The person's languages, by code or name, in order of preference.
        site: ISO 639-3 code of the site's language; None without a site.
        without_culture: Infers the parameters without the person's culture.
    """
    value = values.parameters.get(GREETING_LANGUAGE)
    if value is None or value.asked_for or isinstance(value.value, float):
        return values
    codes = [iso639(words) for words in stated]
    if value.origin != "neutral":
        others = bool(codes) and value.word not in codes
        if not others and without_culture()[GREETING_LANGUAGE].value == value.value:
            return values
        why = "they speak others" if others else "it follows from a nationality alone"
        given = f"{GREETING_LANGUAGE}: rules give {value.word}, which is not spoken, for {why}"
        note = f"{given}; a language is stated."
        values = replace(values, notes=(*values.notes, note))
    spoken = value.desirability.memberships if isinstance(value.desirability, Choice) else ()
    if known := [code for code in codes if code in spoken]:
        text = f"they said that they speak {', '.join(stated)}"
        return _with(values, _given(value, known[0], Contribution("situation", known[0], text)))
    code = site or str(value.neutral)
    if value.origin == "neutral" and code == value.word:
        return values
    text = "the language of the site" if site else "neutral value"
    why = f"they speak {', '.join(stated)}" if stated else "no language is stated"
    return _with(values, _given(value, code, Contribution("neutral", code, f"{text}: {why}")))


def stated_languages(profile: Profile, day: date | None, told: Mapping[str, object]) -> tuple[str, ...]:
    """The languages that a person stated, in order of preference.

    Args:
        profile: The person's profile.
        day: The day in question.
        told: Facts stated for the encounter, which take precedence over the profile.
    """
    now = told.get("language", told.get("languages"))
    if isinstance(now, str):
        return (now,)
    languages, _ = held(profile.languages, day or date.today())
    return tuple(languages or ())


def _given(value: ParameterValue, code: str, why: Contribution) -> ParameterValue:
    note = why.text if why.origin == "neutral" else ""
    return replace(value, value=code, origin=why.origin, contributions=(why,), fired=(), parts=(), note=note)


def _with(values: Inference, value: ParameterValue) -> Inference:
    return replace(values, parameters={**values.parameters, GREETING_LANGUAGE: value})
