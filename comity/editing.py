"""From words such as `age=71` or `distance=0.9` to a checked profile, or to nothing at all."""

from __future__ import annotations

import re
from collections.abc import Mapping
from datetime import date
from pathlib import Path
from typing import Any

from comity.profile import Declared, Profile, day_for
from comity.values import infer_for
from comity_fis import InputError, Rulebook, Where, closest, load_rulebook, shipped_rulebooks
from comity_fis.yaml_file import dump_yaml, parse_yaml

DEFAULT = "bruno2017"
"""The rulebook that judges a wish first."""

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


def edited(document: Mapping[str, Any], words: Mapping[str, str], books: Books) -> Document:
    """A profile's document with some keys changed; `unknown` takes one back.

    Args:
        document: As it is kept; empty for somebody new.
        words: `KEY=VALUE`: a key of the profile, `settings.PARAMETER` or a friendly word for one,
            `other.VARIABLE`. Values are YAML.
        books: Which parameters there are.

    Raises:
        InputError: for a key that there is not.
    """
    new: Document = {
        key: dict(value) if isinstance(value, dict) else value for key, value in document.items()
    }
    for key, text in words.items():
        section, name = _place(key, books)
        value = _value(text, key)
        inside = new.setdefault(section, {}) if section else new
        if value == "unknown":
            inside.pop(name, None)
        else:
            inside[name] = _metres(value) if section == "settings" else value
        if section and not inside:
            del new[section]
    return {key: new[key] for key in Profile.model_fields if key in new}


def checked(document: Mapping[str, Any], books: Books, at: date | None = None) -> Profile:
    """The profile that a document holds, every fact usable and every wish one that can be granted.

    Raises:
        InputError: if it is not; nothing has been written.
    """
    name = str(document.get("name"))
    try:
        file = parse_yaml(dump_yaml(document), Path(name), name)
        profile = file.check(Profile)
        infer_for(
            Declared(profile.model_copy(update={"settings": books.judged(profile.settings)}), None),
            books.first,
            at=day_for(at, profile),
        )
        return profile
    except InputError as error:  # lines of a document that nobody has seen yet would mislead
        raise InputError(
            expected=error.expected, got=error.got, remedy=error.remedy, where=Where(f"profile {name}")
        ) from None


class Books:
    """The rulebooks that may judge a wish: the one in use, then those that ship with Comity."""

    def __init__(self, name: str | None = None) -> None:
        self.first: Rulebook = load_rulebook(name or DEFAULT)
        self._others = () if name else tuple(other for other in shipped_rulebooks() if other != DEFAULT)

    def judged(self, settings: Mapping[str, Any]) -> dict[str, Any]:
        """The wishes that the first rulebook judges; the others are judged here, by one that knows them.

        Raises:
            InputError: if a wish cannot be granted.
        """
        mine = {name: wish for name, wish in settings.items() if name in self.first.parameters}
        for name in settings.keys() - mine.keys():
            (self._knowing(name) or self.first).checked_settings({name: settings[name]})
        return mine

    def knows(self, parameter: str) -> bool:
        """Whether some rulebook has a parameter."""
        return parameter in self.first.parameters or self._knowing(parameter) is not None

    def _knowing(self, parameter: str) -> Rulebook | None:
        return next((book for book in map(load_rulebook, self._others) if parameter in book.parameters), None)


def _place(key: str, books: Books) -> tuple[str | None, str]:
    """The section of a profile that a key belongs to, and its name there."""
    section, dot, name = key.partition(".")
    if dot and section in ("settings", "other") and name:
        return section, FRIENDLY.get(name, name) if section == "settings" else name
    facts = [field for field in Profile.model_fields if field not in ASIDE]
    if key in facts:
        return None, key
    if key in FRIENDLY or books.knows(key):
        return "settings", FRIENDLY.get(key, key)
    raise InputError(
        expected="a key of a profile, or something that a person may ask for",
        got=repr(key),
        remedy=f"{closest(key, [*facts, *FRIENDLY, *books.first.parameters])} "
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


def _metres(value: Any) -> Any:
    """`90 cm` and `0.9 m` as metres; anything else as it came."""
    found = re.fullmatch(r"([0-9.]+) ?(m|cm)", value) if isinstance(value, str) else None
    return round(float(found[1]) * METRES[found[2]], 6) if found else value
