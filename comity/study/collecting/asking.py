"""Questions to the experimenter, one line each; an invalid answer is asked again with the remedy."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TextIO, TypeVar

from comity_fis import InputError
from comity_fis.errors import WrongValueError

T = TypeVar("T")
OPEN = "-"
"""Input that leaves a question open."""


class AnswersEndedError(Exception):
    """The input ended; the session can be continued later."""


@dataclass(frozen=True, slots=True)
class Asker:
    """Source of answers and target of questions: a terminal, or a script."""

    lines: TextIO
    shown: TextIO

    def say(self, text: str) -> None:
        """Show text that needs no answer."""
        print(text, file=self.shown, flush=True)

    def ask(self, question: str, read: Callable[[str], T]) -> T:
        """The first valid answer.

        Args:
            question: Shown before each answer.
            read: Converts a line to a value, or raises `InputError` or `WrongValueError`.

        Raises:
            AnswersEndedError: at the end of the input.
        """
        while True:
            print(f"{question}: ", end="", file=self.shown, flush=True)
            line = self.lines.readline()
            if not line.endswith("\n"):  # a line not ended by Enter is no answer
                self.say("")
                raise AnswersEndedError
            try:
                return read(line.strip())
            except (InputError, WrongValueError) as error:
                self.say(f"  {error}")


def agreed(words: str) -> bool:
    """Parse yes or no.

    Raises:
        WrongValueError: if it is neither.
    """
    if words.lower() in ("yes", "no"):
        return words.lower() == "yes"
    raise WrongValueError(expected="yes or no", got=repr(words), remedy="Type one of the two words.")
