"""Forms of address: as the person asked for, else the scenario's name."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Address:
    """The form of address that a person asked for; nothing is added to it."""

    name: str
    title: str | None = None
    title_first: bool = True
    """Whether the title is said before the name."""
    pronunciation: str | None = None
    """Pronunciation of the name, in IPA or any letters; None if it is spoken as written."""

    @property
    def written(self) -> str:
        """Title and name in the order that the person stated: `Dr Okafor`."""
        return self._in_order(self.name)

    @property
    def spoken(self) -> str:
        """The same with the pronunciation in place of the name: `Dr oh-KAH-for`."""
        return self._in_order(self.pronunciation or self.name)

    def _in_order(self, name: str) -> str:
        parts = (self.title, name) if self.title_first else (name, self.title)
        return " ".join(filter(None, parts))


def name_of(person: str) -> str:
    """A scenario's name as spoken: with its own capitals, else capitalised word by word."""
    name = person.replace("_", " ")
    return name.title() if name.islower() else name


def without_names(text: str, people: Iterable[str]) -> str:
    """A scenario's text without the names of some people, and without the commas around them."""
    names = "|".join(re.escape(name_of(person)) for person in sorted(people, key=len, reverse=True))
    return re.sub(rf",? (?:{names})\b", "", text) if names else text
