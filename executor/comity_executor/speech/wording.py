"""One wording with its metadata: language, script, Latin form, register, occasion, reviewer."""

from __future__ import annotations

import re
from dataclasses import dataclass
from datetime import date
from typing import Literal, get_args

from comity_executor.speech.script import LATIN, read_script, read_tag, require_script
from comity_fis.errors import WrongValueError
from comity_fis.validation.one_line import one_line

Use = Literal[
    "greet",
    "honour",
    "offer_help",
    "hint_at_help",
    "hand_over",
    "take_leave",
    "ask_to_pass",
    "hint_at_passing",
    "announce_coming",
    "stopped_in_front",
    "stopped_left",
    "stopped_right",
    "stopped_behind",
    "announce_leaving",
]
"""Purpose of a wording.

`honour`: after a greeting, if the style is rhetorical. `offer_help`, `hint_at_help`: after a greeting, if the
directness is high or low. `hand_over`: when handing over an object. `ask_to_pass`: to a person who obstructs
the path, and `hint_at_passing` if the directness is low. The others tell a person who cannot see that the
robot approaches, where it has stopped, and that it leaves. Real robots must say those too, and use the
`plain` ones until the others are reviewed.
"""
NAMES_NOBODY: tuple[Use, ...] = ("honour", "offer_help", "hint_at_help")
"""Purposes that follow a wording which names the person."""
Register = Literal["plain", "informal", "neutral", "formal"]
"""Formality. `plain` is the simplest word with the name: for a robot without reviewed wordings."""
Occasion = Literal["first_meeting"]
NAME, THING = "{name}", "{thing}"
_BLANK = re.compile(r"\{[^}]*\}?|\}")
_COMMAS = ",،、"


@dataclass(frozen=True, slots=True, kw_only=True)
class Wording:
    """A wording for one purpose, in one language and register.

    Raises:
        WrongValueError: Its fields are invalid or inconsistent.
    """

    language: str
    """BCP 47 tag."""
    script: str
    """ISO 15924 code of the script of every letter in `text`."""
    use: Use
    register: Register
    text: str
    """The text in its script, with `{name}` for the person."""
    latin: str | None = None
    """The text in Latin letters; None if `text` is in Latin letters."""
    occasion: Occasion | None = None
    """The only occasion for it; None: any encounter."""
    reviewed_by: str | None = None
    """Speaker of the language who has reviewed it; None if nobody has."""
    reviewed_on: date | None = None
    """Day of the review."""

    def __post_init__(self) -> None:
        read_tag(self.language)
        read_script(self.script)
        for words, script, what in ((self.text, self.script, "`text`"), (self.latin, LATIN, "`latin`")):
            if words is not None:
                one_line(words)
                require_script(_BLANK.sub("", words), script, what)
                self._require_blanks(words)
        self._require(self.use in get_args(Use), f"`use` as one of {', '.join(get_args(Use))}", self.use)
        if (self.script == LATIN) != (self.latin is None):
            there = "no `latin`" if self.script == LATIN else "`latin`, the same in Latin letters"
            raise WrongValueError(
                expected=f"{there} beside a text in the script {self.script}",
                got=repr(self.latin or "none"),
                remedy="Remove it." if self.script == LATIN else "Add it: terminals and pictures show it.",
            )
        if (self.reviewed_by is None) != (self.reviewed_on is None):
            raise WrongValueError(
                expected="`reviewed_by` and `reviewed_on`, or neither",
                got="a review without a " + ("name" if self.reviewed_by is None else "date"),
                remedy="Write who reviewed it and on which day.",
            )

    @property
    def is_reviewed(self) -> bool:
        """Whether a speaker of the language has reviewed it."""
        return self.reviewed_by is not None

    @property
    def key(self) -> tuple[Use, Register, Occasion | None]:
        """Unique key within a language."""
        return self.use, self.register, self.occasion

    def _require_blanks(self, words: str) -> None:
        blanks, names = _BLANK.findall(words), self.use not in NAMES_NOBODY
        allowed = {*([NAME] if names else []), *([THING] if self.use == "hand_over" else [])}
        holds = allowed.issuperset(blanks) and blanks.count(NAME) == names and blanks.count(THING) <= 1
        expected = f"{NAME} once" if names else "no blank to fill in"
        self._require(holds, f"{expected} in a wording to {self.use.replace('_', ' ')}", words)

    @staticmethod
    def _require(holds: bool, expected: str, got: str) -> None:
        if not holds:
            raise WrongValueError(
                expected=expected, got=repr(got), remedy=f"Write for example {'Hello, {name}.'!r}."
            )


def unnamed(template: str) -> str:
    """A template without the name and the comma that sets it off."""
    if template.startswith(NAME):
        rest = template.removeprefix(NAME).lstrip(f"{_COMMAS} ")
        return rest[:1].upper() + rest[1:] if rest.strip(".。") else ""
    return re.sub(rf"[{_COMMAS}]?\s*{re.escape(NAME)}", "", template)
