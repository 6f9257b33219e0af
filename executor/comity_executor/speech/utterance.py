"""What the robot says at one time: wordings with names filled in, as written, in Latin letters, as spoken."""

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
    """A person who is named."""

    person: str
    """As in the scenario."""
    address: Address | None = None
    """How they asked to be addressed; None where they did not say."""


@dataclass(frozen=True, slots=True)
class Utterance:
    """One or several wordings, one after the other, to one person or a company."""

    wordings: tuple[Wording, ...]
    """All of one language; the first names the people."""
    people: tuple[Called, ...]
    """Those who are named; without any, the words are said without a name."""
    name_form: Spelling = PLAIN_NAME
    """How a name is said of which the person has stated no form: `{name}-san`."""
    joined: Spelling = AND
    """What stands between the last two names."""
    thing: str = ""
    """What is handed over, as the scenario calls it."""

    @property
    def language(self) -> str:
        """By its BCP 47 tag."""
        return self.wordings[0].language

    @property
    def text(self) -> str:
        """In the script of the language."""
        return self._filled(latin=False, spoken=False)

    @property
    def latin(self) -> str:
        """In Latin letters, but for names that the person has stated in others."""
        return self._filled(latin=True, spoken=False)

    @property
    def spoken(self) -> str:
        """In the script of the language, with a pronunciation that was stated in place of the name."""
        return self._filled(latin=False, spoken=True)

    def without(self, people: Collection[str]) -> Utterance:
        """The same where some are not to be named."""
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
