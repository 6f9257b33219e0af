"""One wording with its facts: language, script, Latin form, register, occasion, and who reviewed it."""

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
"""What a wording is said for.

`honour`: after a greeting, where the style is rhetorical. `offer_help`, `hint_at_help`: after a greeting,
where the directness is high or low. `hand_over`: with something that is handed over. `ask_to_pass`: to a
person who blocks the path, and `hint_at_passing` where the directness is low. The others tell a person who
does not see that the robot comes, where it has stopped, and that it leaves; a real robot, too, has to say so,
and says the `plain` ones until the others are reviewed.
"""
NAMES_NOBODY: tuple[Use, ...] = ("honour", "offer_help", "hint_at_help")
"""These follow words that have named the person."""
Register = Literal["plain", "informal", "neutral", "formal"]
"""How formal it is. `plain` is the plainest word for it with the name: what a robot says that has nothing
reviewed to say."""
Occasion = Literal["first_meeting"]
NAME, THING = "{name}", "{thing}"
_BLANK = re.compile(r"\{[^}]*\}?|\}")
_COMMAS = ",،、"


@dataclass(frozen=True, slots=True, kw_only=True)
class Wording:
    """What the robot says for one purpose, in one language and register.

    Raises:
        WrongValueError: its facts contradict one another, or are none.
    """

    language: str
    """By its BCP 47 tag."""
    script: str
    """By its ISO 15924 code: every letter of `text` belongs to it."""
    use: Use
    register: Register
    text: str
    """As it is written in its script, with `{name}` where the person is named."""
    latin: str | None = None
    """The same in Latin letters; None where `text` is."""
    occasion: Occasion | None = None
    """When alone it is said; None for any meeting."""
    reviewed_by: str | None = None
    """Who speaks the language and has read it; None where nobody has."""
    reviewed_on: date | None = None
    """The day on which they did."""

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
        """Whether a person who speaks the language has read it."""
        return self.reviewed_by is not None

    @property
    def key(self) -> tuple[Use, Register, Occasion | None]:
        """What there is one of in a language."""
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
    """A template without its name, and without the comma that sets it off."""
    if template.startswith(NAME):
        rest = template.removeprefix(NAME).lstrip(f"{_COMMAS} ")
        return rest[:1].upper() + rest[1:] if rest.strip(".。") else ""
    return re.sub(rf"[{_COMMAS}]?\s*{re.escape(NAME)}", "", template)
