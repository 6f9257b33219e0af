"""Errors that say where, what was expected, what came, and what to do about it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from difflib import get_close_matches


class ComityError(Exception):
    """The base of every error that Comity raises on purpose."""


@dataclass(frozen=True, slots=True)
class Where:
    """The place in what a user wrote."""

    file: str
    """A path as the user gave it, or the option's name when it came from the command line."""
    line: int | None = None
    """Counted from 1; None where the whole file is meant."""
    column: int | None = None
    """Counted from 1."""

    def __str__(self) -> str:
        return ":".join(str(part) for part in (self.file, self.line, self.column) if part is not None)


class InputError(ComityError):
    """What a user wrote cannot be used.

    Args:
        expected: What would have been right, without a full stop.
        got: What came instead, quoted where it is the user's own word.
        remedy: What to do now: one whole sentence.
        where: The place, as far as it is known.
    """

    def __init__(self, *, expected: str, got: str, remedy: str, where: Where | None = None) -> None:
        self.expected = expected
        self.got = got
        self.remedy = remedy
        self.where = where
        super().__init__(str(self))

    def __str__(self) -> str:
        place = f"{self.where}: " if self.where else ""
        return f"{place}expected {self.expected}, got {self.got}. {self.remedy}"

    def at(self, where: Where) -> InputError:
        """The same error, placed (a place that is already known is kept)."""
        return InputError(
            expected=self.expected, got=self.got, remedy=self.remedy, where=self.where or where
        )


def closest(name: str, names: Iterable[str]) -> str:
    """A remedy that names the closest known word, or all of them when none is close."""
    known = sorted(names)
    near = get_close_matches(name, known, n=1, cutoff=0.6)
    if near:
        return f"Did you mean {near[0]!r}?"
    return f"Known are: {', '.join(known)}." if known else "None is known here."
