"""Edits a stored profile by words such as `age=71` or `distance=0.9`; all changes are validated."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from datetime import date
from pathlib import Path
from typing import Any

from comity.parameters.consent import refuse_resting
from comity.parameters.perception import refuse_clash
from comity.parameters.values import cases_of
from comity.parameters.which_rulebook import EVIDENCE
from comity.people.consents import lapse, require_consent
from comity.people.profile import Declared, Profile, day_for
from comity.people.store import Store
from comity_fis import (
    InputError,
    NumericParameter,
    Parameter,
    Rulebook,
    Where,
    closest,
    load_rulebook,
    shipped_rulebooks,
)
from comity_fis.validation.yaml_file import YamlFile, dump_yaml, parse_yaml

FRIENDLY = {
    "distance": "conversational_distance",
    "speed": "approach_speed",
    "direction": "approach_direction",
    "greeting": "greeting_modality",
    "gesture": "greeting_gesture",
    "volume": "voice_volume",
    "rate": "speech_rate",
}
"""Everyday names of parameters that a person may set."""

METRES = {"m": 1.0, "cm": 0.01}
ASIDE = ("schema_version", "name", "settings", "other")
"""Keys of a profile that are not facts."""

Document = dict[str, Any]


def edited(document: Mapping[str, Any], words: Mapping[str, str], judges: Books) -> Document:
    """A profile's document with some keys changed; `unknown` removes one.

    Args:
        document: The stored document; empty for a new person.
        words: `KEY=VALUE`: a key of the profile, `settings.PARAMETER` or its everyday name, or
            `other.VARIABLE`. Values are YAML.
        judges: The rulebooks, which define the parameters.

    Raises:
        InputError: A key does not exist, or two mean the same.
    """
    new: Document = {
        key: dict(value) if isinstance(value, dict) else value for key, value in document.items()
    }
    named = dict[tuple[str | None, str], str]()
    for key, text in words.items():
        section, name = place = _place(key, judges)
        if place in named:
            raise InputError(
                expected="each wish and fact once",
                got=f"{named[place]} and {key}, which mean the same",
                remedy="Keep one of them.",
                where=Where("profile set"),
            )
        named[place] = key
        value = _value(text, key)
        inside = new.setdefault(section, {}) if section else new
        if value == "unknown":
            inside.pop(name, None)
        else:
            inside[name] = judges.in_their_case(name, metres(value)) if section == "settings" else value
        if section and not inside:
            del new[section]
    return {key: new[key] for key in Profile.model_fields if key in new}


def keep_edited(name: str, words: Mapping[str, str], judges: Books) -> Profile:
    """Change some keys of a stored profile, under a lock.

    Args:
        name: Name of the person; a new person is stored from now on.
        words: As for `edited`.
        judges: The rulebooks, which define the parameters and the settings that can be granted.

    Raises:
        InputError: The changed profile is invalid, or the person does not consent to being stored or touched;
            nothing is written.
    """
    lapse(name)
    require_consent(name, "remember")
    profiles: list[Profile] = []

    def changed(file: YamlFile | None) -> Document:
        document = edited(kept_document(name, file), words, judges)
        asked = {name for section, name in (_place(key, judges) for key in words) if section == "settings"}
        profiles.append(checked(document, judges, asked=asked))
        if "touch_consent" in words and "given" in str(document.get("touch_consent")).casefold():
            require_consent(name, "touch")
        return document

    Store().change_profile(name, changed)
    return profiles[-1]


def kept_document(name: str, file: YamlFile | None) -> Document:
    """The validated profile document of a person's file; for a new person, only their name.

    Raises:
        InputError: The stored file is damaged.
    """
    if file is None:
        return {"schema_version": 1, "name": name}
    file.check(Profile)
    return dict(file.data)


def checked(
    document: Mapping[str, Any], judges: Books, at: date | None = None, *, asked: Collection[str] = ()
) -> Profile:
    """The profile of a document, after validating every fact and every setting.

    Args:
        document: The document to be stored.
        judges: The rulebooks.
        at: The day; None: today if facts depend on it.
        asked: Parameters of the new settings, which are rejected without the required consent. An earlier
            setting is suspended instead, so that consent can be withdrawn at any time.

    Raises:
        InputError: It is invalid; nothing has been written.
    """
    name = str(document.get("name"))
    try:
        file = parse_yaml(dump_yaml(document), Path(name), name)
        profile = file.check(Profile)
        judges.judge(profile, day_for(at, profile), asked)
        return profile
    except InputError as error:  # line numbers of an unsaved document would mislead
        raise InputError(
            expected=error.expected, got=error.got, remedy=error.remedy, where=Where(f"profile {name}")
        ) from None


@dataclass(frozen=True, slots=True)
class Books:
    """The rulebooks that may validate a setting."""

    first: Rulebook
    others: tuple[str, ...]
    """Names of further rulebooks, for settings that the first does not define; loaded on demand."""

    def judge(self, profile: Profile, day: date | None, asked: Collection[str]) -> None:
        """Validate all facts and settings: each setting by the first rulebook that defines it.

        Raises:
            InputError: A fact is invalid, or a setting cannot be granted.
        """
        for name, wish in profile.settings.items():
            book = self._knowing(name) or self.first
            book.checked_settings({name: wish})
            _refuse_unsafe(wish, book.parameters[name])
        refuse_clash(profile, day)
        for book in (self.first, *self._others()):
            declared = Declared(profile if book is self.first else self._about(profile, book), None)
            for case in cases_of(declared, book, at=day):
                refuse_resting(asked, case.rests)

    def _about(self, profile: Profile, book: Rulebook) -> Profile:
        """The profile reduced to the variables and settings that this further rulebook validates."""
        other = {name: fact for name, fact in profile.other.items() if name in book.variables}
        settings = {
            name: wish
            for name, wish in profile.settings.items()
            if (knowing := self._knowing(name)) and knowing.name == book.name
        }
        return profile.model_copy(update={"other": other, "settings": settings})

    def knows(self, parameter: str) -> bool:
        """Whether some rulebook defines a parameter."""
        return self._knowing(parameter) is not None

    def in_their_case(self, parameter: str, wish: Any) -> Any:
        """A setting in words, with the capitalisation of the rulebook that defines it."""
        book = self._knowing(parameter)
        terms = book.parameters[parameter].terms if book and isinstance(wish, str) else ()
        return next((term for term in terms if term.casefold() == wish.casefold()), wish)

    def _knowing(self, parameter: str) -> Rulebook | None:
        return next((book for book in (self.first, *self._others()) if parameter in book.parameters), None)

    def _others(self) -> Iterator[Rulebook]:
        return map(load_rulebook, self.others)


def _refuse_unsafe(wish: Any, parameter: Parameter) -> None:
    """Reject a number that safety would change: an accepted setting has to be kept."""
    if not isinstance(parameter, NumericParameter) or parameter.check(wish) in parameter.safe:
        return
    nearest = parameter.safe.clamp(float(wish))
    raise InputError(
        expected=f"{parameter.name} that safety leaves as it is",
        got=f"{wish:g} {parameter.unit}",
        remedy=f"Ask for {nearest:g} {parameter.unit}, the nearest that is safe.",
    )


def books(name: str | None = None) -> Books:
    """The given rulebook; None: the default one for stored people, then the others."""
    others = () if name else tuple(other for other in shipped_rulebooks() if other != EVIDENCE)
    return Books(load_rulebook(name or EVIDENCE), others)


def _place(key: str, judges: Books) -> tuple[str | None, str]:
    """The section of a profile that a key belongs to, and its name there."""
    section, dot, name = key.partition(".")
    if dot and section in ("settings", "other") and name:
        return section, FRIENDLY.get(name, name) if section == "settings" else name
    facts = [field for field in Profile.model_fields if field not in ASIDE]
    if key in facts:
        return None, key
    if key in FRIENDLY or judges.knows(key):
        return "settings", FRIENDLY.get(key, key)
    raise InputError(
        expected="a key of a profile, or something that a person may ask for",
        got=repr(key),
        remedy=f"{closest(key, [*facts, *FRIENDLY, *judges.first.parameters])} "
        "`settings.PARAMETER=...` and `other.VARIABLE=...` name any.",
        where=Where("profile set"),
    )


def _value(text: str, key: str) -> Any:
    try:
        return parse_yaml(text, Path(key), key).data
    except InputError as error:
        raise InputError(
            expected=f"{error.expected} as the value of {key}",
            got=error.got,
            remedy=f"Check the quotes and brackets of {key}=...",
            where=Where("profile set"),
        ) from None


def metres(value: Any) -> Any:
    """`90 cm` and `0.9 m` as metres; anything else unchanged."""
    found = re.fullmatch(r"([0-9.]+) ?(m|cm)", value) if isinstance(value, str) else None
    return round(float(found[1]) * METRES[found[2]], 6) if found else value
