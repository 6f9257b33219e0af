"""A PDDL file as nested forms that know where they stand: for places in messages, not for planning."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from comity_fis.errors import InputError, Where
from comity_fis.validation.no_file import no_file
from comity_fis.validation.undecodable import REMEDY, undecodable

MAX_DEPTH = 60
"""Nesting of brackets. Real domains stay below 20."""
_TOKEN = re.compile(r"(?:;[^\n]*|\s+)|([()]|[^\s();]+)")
_ONE_DEFINE = "Keep one (define ...) in each file, and check the brackets before this place."


@dataclass(frozen=True, slots=True)
class Form:
    """A word, or a pair of brackets and what stands between them."""

    word: str
    """In lower case, as PDDL does not tell cases apart; empty for brackets."""
    items: tuple[Form, ...]
    start: int
    """Characters before it in the file."""

    @property
    def head(self) -> str:
        """The first word between the brackets; empty where there is none."""
        return self.items[0].word if self.items else ""

    @property
    def rest(self) -> tuple[Form, ...]:
        """Everything behind the head."""
        return self.items[1:]

    def all(self) -> Iterator[Form]:
        """The form and every form in it, in the order of the file."""
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
    """One file."""

    name: str
    """As messages call it."""
    text: str
    define: Form
    """All of it: `(define ...)`."""

    def where(self, form: Form) -> Where:
        """The line and the column of a form."""
        return _where(self.name, self.text, form.start)

    def refused(self, form: Form, expected: str, got: str, remedy: str) -> InputError:
        """The refusal of a form, at its place."""
        return InputError(expected=expected, got=got, remedy=remedy, where=self.where(form))

    def section(self, keyword: str) -> Form | None:
        """The first section of that name."""
        return next((form for form in self.define.items if form.head == keyword), None)

    def actions(self) -> dict[str, Form]:
        """The actions of a domain, by name."""
        kinds = (":action", ":durative-action")
        forms = (form for form in self.define.items if form.head in kinds and len(form.items) > 1)
        return {form.items[1].word: form for form in forms}


def read_text(path: Path) -> PddlText:
    """The forms of a file.

    Raises:
        InputError: There is no such file, it is no text, or its brackets do not match.
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
    """The one pair of brackets around all of a text.

    Raises:
        InputError: There is none, there are several, or one is not closed.
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
    """What was expected in the place of a token and what to do; None where it may stand there."""
    if ended:
        return "nothing after the closing bracket", _ONE_DEFINE
    if depth == 0 and token != "(":
        return "PDDL, which starts with '('", "Name a PDDL file."
    if depth == MAX_DEPTH and token == "(":
        return f"at most {MAX_DEPTH} nested brackets", "Flatten the expression."
    return None


def _where(name: str, text: str, start: int) -> Where:
    return Where(name, text.count("\n", 0, start) + 1, start - text.rfind("\n", 0, start))
