"""From words such as `age=71` or `distance=0.9` to a checked profile, or to nothing at all."""

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
"""What people call the parameters that they may ask for."""

METRES = {"m": 1.0, "cm": 0.01}
ASIDE = ("schema_version", "name", "settings", "other")
"""Keys of a profile that are no answer to a question."""

Document = dict[str, Any]


def edited(document: Mapping[str, Any], words: Mapping[str, str], judges: Books) -> Document:
    """A profile's document with some keys changed; `unknown` takes one back.

    Args:
        document: As it is kept; empty for a new person.
        words: `KEY=VALUE`: a key of the profile, `settings.PARAMETER` or a friendly word for one,
            `other.VARIABLE`. Values are YAML.
        judges: They know which parameters there are.

    Raises:
        InputError: for a key that there is not, or two that mean the same.
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
    """Change some keys of what is kept of a person; nobody else changes it meanwhile.

    Args:
        name: Of the person; a new person is kept from now on.
        words: As for `edited`.
        judges: They know which parameters there are, and which wishes can be granted.

    Raises:
        InputError: if the profile cannot be used with the change, or the person did not agree to be kept or
            touched; nothing is written.
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
    """What a person's file holds, checked to be a profile; of a new person, their name.

    Raises:
        InputError: if the file in the store was damaged.
    """
    if file is None:
        return {"schema_version": 1, "name": name}
    file.check(Profile)
    return dict(file.data)


def checked(
    document: Mapping[str, Any], judges: Books, at: date | None = None, *, asked: Collection[str] = ()
) -> Profile:
    """The profile that a document holds, every fact usable and every wish one that can be granted.

    Args:
        document: As it is to be kept.
        judges: The rulebooks.
        at: On which day; today where it is None and the facts depend on it.
        asked: The wishes that are new, by parameter: they are refused where consent is missing. One that was
            granted before rests instead, so that consent can be taken back at any time.

    Raises:
        InputError: if it is not; nothing has been written.
    """
    name = str(document.get("name"))
    try:
        file = parse_yaml(dump_yaml(document), Path(name), name)
        profile = file.check(Profile)
        judges.judge(profile, day_for(at, profile), asked)
        return profile
    except InputError as error:  # lines of a document that nobody has seen yet would mislead
        raise InputError(
            expected=error.expected, got=error.got, remedy=error.remedy, where=Where(f"profile {name}")
        ) from None


@dataclass(frozen=True, slots=True)
class Books:
    """The rulebooks that may judge a wish."""

    first: Rulebook
    others: tuple[str, ...]
    """Asked about what the first does not decide; by name, because they are seldom needed."""

    def judge(self, profile: Profile, day: date | None, asked: Collection[str]) -> None:
        """Look at all facts and wishes: each wish by the first rulebook that knows it.

        Raises:
            InputError: if a fact cannot be used, or a wish cannot be granted.
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
        """What one of the other rulebooks is asked about: no variable or wish that is not its to judge."""
        other = {name: fact for name, fact in profile.other.items() if name in book.variables}
        settings = {
            name: wish
            for name, wish in profile.settings.items()
            if (knowing := self._knowing(name)) and knowing.name == book.name
        }
        return profile.model_copy(update={"other": other, "settings": settings})

    def knows(self, parameter: str) -> bool:
        """Whether some rulebook has a parameter."""
        return self._knowing(parameter) is not None

    def in_their_case(self, parameter: str, wish: Any) -> Any:
        """A wish in words as the rulebook that judges it writes them, where only capitals differ."""
        book = self._knowing(parameter)
        terms = book.parameters[parameter].terms if book and isinstance(wish, str) else ()
        return next((term for term in terms if term.casefold() == wish.casefold()), wish)

    def _knowing(self, parameter: str) -> Rulebook | None:
        return next((book for book in (self.first, *self._others()) if parameter in book.parameters), None)

    def _others(self) -> Iterator[Rulebook]:
        return map(load_rulebook, self.others)


def _refuse_unsafe(wish: Any, parameter: Parameter) -> None:
    """Refuse a number that safety would change: what is promised has to be kept."""
    if not isinstance(parameter, NumericParameter) or parameter.check(wish) in parameter.safe:
        return
    nearest = parameter.safe.clamp(float(wish))
    raise InputError(
        expected=f"{parameter.name} that safety leaves as it is",
        got=f"{wish:g} {parameter.unit}",
        remedy=f"Ask for {nearest:g} {parameter.unit}, the nearest that is safe.",
    )


def books(name: str | None = None) -> Books:
    """One rulebook by name or file; without one that of runs with people who are kept, then the others."""
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
    """`90 cm` and `0.9 m` as metres; anything else as it came."""
    found = re.fullmatch(r"([0-9.]+) ?(m|cm)", value) if isinstance(value, str) else None
    return round(float(found[1]) * METRES[found[2]], 6) if found else value
