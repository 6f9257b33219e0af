"""Errors that say where, what was expected, what came, and what to do about it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches

MOST_NAMED = 12
"""Known words in a message: a longer list hides what it says."""
LONGEST_SHOWN = 80
"""Characters of a value in a message."""
MOST_TOLD = 12
"""Errors that are told together: after mending so many, a user checks again."""


Location = tuple[str | int, ...]
"""The way from a document's root to a value in it: keys and list indexes."""


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

    def __reduce__(self) -> tuple[object, ...]:
        return _rebuilt, (self.expected, self.got, self.remedy, self.where)

    def at(self, where: Where) -> InputError:
        """The same error, placed (a place that is already known is kept)."""
        return InputError(expected=self.expected, got=self.got, remedy=self.remedy, where=self.where or where)


def _rebuilt(expected: str, got: str, remedy: str, where: Where | None) -> InputError:
    """For pickle: an error that crosses to another process keeps its parts."""
    return InputError(expected=expected, got=got, remedy=remedy, where=where)


class ManyInputErrors(InputError):  # noqa: N818 - its name says that there are several
    """Several things in one file cannot be used: told together, they can be mended together.

    Args:
        errors: Each with its place, at least one; the first one's parts are those of the whole.
    """

    def __init__(self, errors: Sequence[InputError]) -> None:
        self.errors = tuple(errors)
        first = self.errors[0]
        super().__init__(expected=first.expected, got=first.got, remedy=first.remedy, where=first.where)

    def __str__(self) -> str:
        lines = [str(error) for error in self.errors[:MOST_TOLD]]
        more = len(self.errors) - len(lines)
        return "\n".join([*lines, f"... and {more} more of this kind."] if more else lines)

    def __reduce__(self) -> tuple[object, ...]:
        return ManyInputErrors, (self.errors,)

    def at(self, where: Where) -> InputError:
        """The same: each has its place."""
        return self


class WrongValueError(InputError, ValueError):
    """What a record refuses at construction; the reader of a file gives it a place.

    It is a `ValueError` too, which is what pydantic takes for a refusal.
    """

    def __init__(self, *, expected: str, got: object, remedy: str = "Change it here.") -> None:
        super().__init__(expected=expected, got=str(got), remedy=remedy)

    def __reduce__(self) -> tuple[object, ...]:
        return _refused, (self.expected, self.got, self.remedy)


def _refused(expected: str, got: str, remedy: str) -> WrongValueError:
    """For pickle."""
    return WrongValueError(expected=expected, got=got, remedy=remedy)


def closest(name: str, names: Iterable[str], labels: Mapping[str, str] | None = None) -> str:
    """A remedy that names the closest known word, or known ones when none is close.

    Args:
        name: What came, in whatever case.
        names: The known words.
        labels: Further words that a user may think of, each with the known word that it stands for.
    """
    known = sorted(set(names))
    meant = {word.lower(): word for word in reversed(known)}
    meant |= {label.lower(): word for label, word in (labels or {}).items()}
    near = get_close_matches(name.lower(), meant, n=1, cutoff=0.6)
    if near:
        return f"Did you mean {meant[near[0]]!r}?"
    if not known:
        return "None is known here."
    more = f", ... ({len(known)} in all)" if len(known) > MOST_NAMED else ""
    return f"Known are: {', '.join(known[:MOST_NAMED])}{more}."


def unknown_word(expected: str, got: str, known: Iterable[str], *, where: Where | None = None) -> InputError:
    """A refusal of a word that is none of the known ones; the remedy names the closest of them."""
    return InputError(expected=expected, got=repr(got), remedy=closest(got, known), where=where)


def shown(value: object) -> str:
    """A value as a message names it: what Python calls it, on one line and not too long."""
    text = " ".join(repr(value).split())
    return text if len(text) <= LONGEST_SHOWN else f"{text[: LONGEST_SHOWN - 3]}..."
