"""Questions to the experimenter, one line each; what cannot be used is asked again with the remedy."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TextIO, TypeVar

from comity_fis import InputError
from comity_fis.errors import WrongValueError

T = TypeVar("T")
OPEN = "-"
"""Typed where a question is left open."""


class AnswersEndedError(Exception):
    """The lines ended: the session goes on another time."""


@dataclass(frozen=True, slots=True)
class Asker:
    """Where questions go and answers come from: a terminal, or a script."""

    lines: TextIO
    shown: TextIO

    def say(self, text: str) -> None:
        """Show something that is not answered."""
        print(text, file=self.shown, flush=True)

    def ask(self, question: str, read: Callable[[str], T]) -> T:
        """The first answer that can be used.

        Args:
            question: Shown before each answer.
            read: Makes a value of a line, or raises `InputError` or `WrongValueError`.

        Raises:
            AnswersEndedError: at the end of the lines.
        """
        while True:
            print(f"{question}: ", end="", file=self.shown, flush=True)
            line = self.lines.readline()
            if not line.endswith("\n"):  # what was not ended by Enter was not answered
                self.say("")
                raise AnswersEndedError
            try:
                return read(line.strip())
            except (InputError, WrongValueError) as error:
                self.say(f"  {error}")


def agreed(words: str) -> bool:
    """Yes or no.

    Raises:
        WrongValueError: it is neither.
    """
    if words.lower() in ("yes", "no"):
        return words.lower() == "yes"
    raise WrongValueError(expected="yes or no", got=repr(words), remedy="Type one of the two words.")
