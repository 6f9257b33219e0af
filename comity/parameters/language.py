"""The language in which a person is spoken to: one that they stated or asked for, else that of the site.

Rules may only choose among the languages that a person stated. No language follows from a nationality.
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
    """A person's parameters, spoken to in a language that they stated or asked for, or in the site's.

    Args:
        values: What rules and wishes give.
        stated: The languages that the person stated, by code or name, the best liked first.
        site: The language of the site by its ISO 639-3 code; None where there is no site.
        without_culture: Gives what the rules say, had the person declared no culture.
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
    """The languages that a person stated, the best liked first.

    Args:
        profile: What they declared.
        day: On which.
        told: What is told here and now, by fact: it goes before the profile.
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
