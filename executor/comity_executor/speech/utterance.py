"""An utterance: wordings with names filled in, as written, in Latin letters, and for a synthesiser."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace

from comity_executor.speech.address import Address, name_of
from comity_executor.speech.wording import NAME, Wording, unnamed


@dataclass(frozen=True, slots=True)
class Spelling:
    """Words in a language's script and in Latin letters."""

    text: str
    latin: str


PLAIN_NAME = Spelling(NAME, NAME)
AND = Spelling(", ", ", ")


@dataclass(frozen=True, slots=True)
class Called:
    """A person named in an utterance."""

    person: str
    """Name in the scenario."""
    address: Address | None = None
    """Form of address that they asked for; None if not stated."""


@dataclass(frozen=True, slots=True)
class Utterance:
    """One or several consecutive wordings, for one person or a group."""

    wordings: tuple[Wording, ...]
    """Wordings in one language; the first names the people."""
    people: tuple[Called, ...]
    """The people named; if empty, no name is said."""
    name_form: Spelling = PLAIN_NAME
    """Form of a name for people who have not stated a form of address: `{name}-san`."""
    joined: Spelling = AND
    """Conjunction between the last two names."""
    thing: str = ""
    """The object handed over, named as in the scenario."""

    @property
    def language(self) -> str:
        """BCP 47 tag."""
        return self.wordings[0].language

    @property
    def text(self) -> str:
        """The text in the script of the language."""
        return self._filled(latin=False, spoken=False)

    @property
    def latin(self) -> str:
        """The text in Latin letters, except for names that people stated in others."""
        return self._filled(latin=True, spoken=False)

    @property
    def spoken(self) -> str:
        """The text for a synthesiser, with stated pronunciations in place of names."""
        return self._filled(latin=False, spoken=True)

    def without(self, people: Collection[str]) -> Utterance:
        """A copy that does not name these people."""
        return replace(self, people=tuple(one for one in self.people if one.person not in people))

    def _filled(self, *, latin: bool, spoken: bool) -> str:
        and_ = self.joined.latin if latin else self.joined.text
        *others, last = [self._name(one, latin=latin, spoken=spoken) for one in self.people] or [""]
        name = and_.join(filter(None, (", ".join(others), last)))
        templates = ((one.latin if latin else None) or one.text for one in self.wordings)
        filled = ((one if name else unnamed(one)).format(name=name, thing=self.thing) for one in templates)
        return " ".join(filter(None, filled))

    def _name(self, one: Called, *, latin: bool, spoken: bool) -> str:
        if one.address is not None:
            return one.address.spoken if spoken else one.address.written
        form = self.name_form.latin if latin else self.name_form.text
        return form.replace(NAME, name_of(one.person))
