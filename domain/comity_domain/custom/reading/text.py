"""Parses a PDDL file into nested forms with positions: for locations in messages, not for planning."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from comity_fis.errors import InputError, Where
from comity_fis.validation.no_file import no_file
from comity_fis.validation.undecodable import REMEDY, undecodable

MAX_DEPTH = 60
"""Maximum nesting of brackets; real domains stay below 20."""
_TOKEN = re.compile(r"(?:;[^\n]*|\s+)|([()]|[^\s();]+)")
_ONE_DEFINE = "Keep one (define ...) in each file, and check the brackets before this place."


@dataclass(frozen=True, slots=True)
class Form:
    """A word, or a bracketed list of forms."""

    word: str
    """The word in lower case, since PDDL ignores case; empty for a list."""
    items: tuple[Form, ...]
    start: int
    """Offset in the file, in characters."""

    @property
    def head(self) -> str:
        """The first word of a list; empty if there is none."""
        return self.items[0].word if self.items else ""

    @property
    def rest(self) -> tuple[Form, ...]:
        """All forms after the head."""
        return self.items[1:]

    def all(self) -> Iterator[Form]:
        """The form and all forms nested in it, in file order."""
        waiting: list[Form] = [self]
        while waiting:
            form = waiting.pop()
            yield form
            waiting.extend(reversed(form.items))

    def __str__(self) -> str:
        text = self.word or f"({' '.join(map(str, self.items))})"
        return text if len(text) <= 60 else f"{text[:57]}..."


@dataclass(frozen=True, slots=True)
class PddlText:
    """The parsed text of one file."""

    name: str
    """File name in messages."""
    text: str
    define: Form
    """The whole file: `(define ...)`."""

    def where(self, form: Form) -> Where:
        """Line and column of a form."""
        return _where(self.name, self.text, form.start)

    def refused(self, form: Form, expected: str, got: str, remedy: str) -> InputError:
        """The error for a rejected form, with its location."""
        return InputError(expected=expected, got=got, remedy=remedy, where=self.where(form))

    def section(self, keyword: str) -> Form | None:
        """The first section with that keyword."""
        return next((form for form in self.define.items if form.head == keyword), None)

    def actions(self) -> dict[str, Form]:
        """The actions of a domain, by name."""
        kinds = (":action", ":durative-action")
        forms = (form for form in self.define.items if form.head in kinds and len(form.items) > 1)
        return {form.items[1].word: form for form in forms}


def read_text(path: Path) -> PddlText:
    """Parse a file.

    Raises:
        InputError: The file does not exist, is not text, or has unmatched brackets.
    """

    def refuse(got: str, remedy: str) -> InputError:
        return InputError(expected="a PDDL file", got=got, remedy=remedy, where=Where(str(path)))

    try:
        if not path.is_file():
            raise refuse(no_file(path), "Check the path and its spelling.")
        text = path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        where, got = undecodable(error, str(path))
        raise InputError(expected="UTF-8 text", got=got, remedy=REMEDY, where=where) from None
    except (OSError, ValueError) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
        raise refuse(reason, "Check the path and its permissions.") from None
    return PddlText(str(path), text, parsed(text, str(path)))


def parsed(text: str, name: str) -> Form:
    """Parse a text into the one list that encloses it.

    Raises:
        InputError: There is no list, there are several, or one is not closed.
    """
    open_forms: list[tuple[int, list[Form]]] = []
    done: list[Form] = []
    for found in _TOKEN.finditer(text):
        token, start = found[1], found.start()
        if token is None:
            continue
        if wrong := _misplaced(token, depth=len(open_forms), ended=bool(done)):
            got = repr(token[:40])
            raise InputError(expected=wrong[0], got=got, remedy=wrong[1], where=_where(name, text, start))
        if token == "(":
            open_forms.append((start, []))
            continue
        opened, items = open_forms.pop() if token == ")" else (start, [])
        form = Form("" if token == ")" else token.lower(), tuple(items), opened)
        (open_forms[-1][1] if open_forms else done).append(form)
    if open_forms or not done:
        unclosed = ("a ')' for this '('", "the end of the file", "Close the bracket.")
        empty = ("PDDL", "an empty file", "Start it with (define (domain NAME).")
        expected, got, remedy = unclosed if open_forms else empty
        where = _where(name, text, open_forms[-1][0] if open_forms else 0)
        raise InputError(expected=expected, got=got, remedy=remedy, where=where)
    return done[0]


def _misplaced(token: str, *, depth: int, ended: bool) -> tuple[str, str] | None:
    """What was expected in place of a token, and the remedy; None if the token may stand there."""
    if ended:
        return "nothing after the closing bracket", _ONE_DEFINE
    if depth == 0 and token != "(":
        return "PDDL, which starts with '('", "Name a PDDL file."
    if depth == MAX_DEPTH and token == "(":
        return f"at most {MAX_DEPTH} nested brackets", "Flatten the expression."
    return None


def _where(name: str, text: str, start: int) -> Where:
    return Where(name, text.count("\n", 0, start) + 1, start - text.rfind("\n", 0, start))
