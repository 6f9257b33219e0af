"""PDDL as nested forms of words that remember where they stand.

unified-planning parses the PDDL; this reader is there so that every complaint can name a line and a column,
and so that no file can keep the parser busy for minutes.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from comity_fis.errors import InputError, Where
from comity_fis.validation.no_file import no_file
from comity_fis.validation.undecodable import REMEDY, undecodable

MAX_BYTES = 2_000_000
MAX_DEPTH = 60
"""Nesting of brackets. Real domains stay below 20."""
MAX_WORDS = 30_000
"""Words and brackets of one file: unified-planning's reader takes about 4 ms for each fact of a problem."""

_TOKEN = re.compile(r"(?P<comment>;[^\n]*)|(?P<space>\s+)|(?P<bracket>[()])|(?P<word>[^\s();]+)")
_WORD = re.compile(
    r"[:?]?[A-Za-z][A-Za-z0-9_-]*|[<>]=?|[=+*/-]|[+-]?(\d{1,15}(\.\d{0,12})?|\.\d{1,12})|#t", re.ASCII
)
_NUMBER = re.compile(r"[+-]?[\d.]+([eE][+-]?\d+)?", re.ASCII)
"""Whatever is meant as a number."""


@dataclass(frozen=True, slots=True)
class Word:
    """One word of a file."""

    written: str
    where: Where

    @property
    def text(self) -> str:
        """In lower case: PDDL does not tell cases apart."""
        return self.written.lower()

    @property
    def is_variable(self) -> bool:
        """Whether it starts with a question mark."""
        return self.written.startswith("?")

    @property
    def is_number(self) -> bool:
        """Whether it is one."""
        return self.written.lstrip("+-")[:1] in set("0123456789.")

    @property
    def is_name(self) -> bool:
        """Whether it can name a thing."""
        return self.written[:1].isalpha()

    def __str__(self) -> str:
        return self.written


@dataclass(frozen=True, slots=True)
class Form:
    """A pair of brackets and what stands between them."""

    items: tuple[Item, ...]
    where: Where

    @property
    def head(self) -> str:
        """The first word in lower case; empty where there is none."""
        return self.items[0].text if self.items and isinstance(self.items[0], Word) else ""

    @property
    def rest(self) -> tuple[Item, ...]:
        """Everything behind the head."""
        return self.items[1:]

    def __str__(self) -> str:
        text = f"({' '.join(map(str, self.items))})"
        return text if len(text) <= 60 else f"{text[:57]}..."


Item = Word | Form


def read_form(path: Path) -> Form:
    """The one form `(define ...)` of a PDDL file.

    Raises:
        InputError: if there is no such file, it is over a limit, or it is not PDDL.
    """
    return parse_form(_text(path), str(path))


def parse_form(text: str, name: str) -> Form:
    """The same for a text.

    Args:
        text: The PDDL.
        name: How messages call it.

    Raises:
        InputError: as `read_form`.
    """
    form: Form | None = None
    open_forms: list[tuple[Where, list[Item]]] = []
    for token, where in _tokens(text, name):
        if token == "(":
            if form is not None:
                raise complaint(where, "nothing after the closing bracket", "another '('", _ONE_DEFINE)
            if len(open_forms) == MAX_DEPTH:
                raise complaint(
                    where, f"at most {MAX_DEPTH} nested brackets", "deeper ones", "Flatten the expression."
                )
            open_forms.append((where, []))
        elif not open_forms:
            raise _outside(token, where, ended=form is not None)
        elif token == ")":
            opened, items = open_forms.pop()
            closed = Form(tuple(items), opened)
            if open_forms:
                open_forms[-1][1].append(closed)
            else:
                form = closed
        else:
            open_forms[-1][1].append(_word(token, where))
    if open_forms:
        opened = open_forms[-1][0]
        raise complaint(opened, "a ')' for this '('", "the end of the file", "Close the bracket.")
    if form is None:
        raise complaint(Where(name), "PDDL", "an empty file", "Start it with (define (domain NAME).")
    return form


_ONE_DEFINE = "Keep one (define ...) in each file, and check the brackets before this place."


def complaint(where: Where, expected: str, got: str, remedy: str) -> InputError:
    """An error at a place."""
    return InputError(expected=expected, got=got, remedy=remedy, where=where)


def _outside(token: str, where: Where, *, ended: bool) -> InputError:
    if token == ")":
        return complaint(
            where, "as many ')' as '('", "one ')' more", "Remove it, or open a bracket before it."
        )
    if ended:
        return complaint(where, "nothing after the closing bracket", repr(token[:40]), _ONE_DEFINE)
    return complaint(where, "PDDL, which starts with '('", repr(token[:40]), "Name a PDDL file.")


def _word(token: str, where: Where) -> Word:
    if _NUMBER.fullmatch(token) and not _WORD.fullmatch(token):
        raise complaint(
            where,
            "a number such as 12 or 0.5, of at most 15 digits before the point and 12 behind it",
            ascii(token[:40]),
            "Write it out without an exponent; where it is too large, measure in a larger unit.",
        )
    if token[:1] == "-" and token[1:2].isalpha() and _WORD.fullmatch(token[1:]):
        raise complaint(where, "a blank after the '-'", f"'{token}'", f"Write '- {token[1:]}'.")
    if len(token) > 100 or not _WORD.fullmatch(token):
        raise complaint(
            where,
            "a name of letters, digits, '-' and '_' that starts with a letter, or a number such as 12 or 0.5",
            ascii(token[:40]),
            "Rename it here and wherever it is used.",
        )
    return Word(token, where)


def _tokens(text: str, name: str) -> Iterator[tuple[str, Where]]:
    line, line_start, count = 1, 0, 0
    for found in _TOKEN.finditer(text):
        token = found[0]
        if found.lastgroup in ("word", "bracket"):
            count += 1
            where = Where(name, line, found.start() - line_start + 1)
            if count > MAX_WORDS:
                raise complaint(
                    where, f"at most {MAX_WORDS} words and brackets", "more", "Plan a smaller problem."
                )
            yield token, where
        elif found.lastgroup == "space" and "\n" in token:
            line += token.count("\n")
            line_start = found.start() + token.rindex("\n") + 1


def _text(path: Path) -> str:
    def refuse(got: str, remedy: str) -> InputError:
        return complaint(Where(str(path)), "a PDDL file", got, remedy)

    try:
        if not path.is_file():
            raise refuse(no_file(path), "Check the path and its spelling.")
        if path.stat().st_size > MAX_BYTES:
            raise refuse(f"{path.stat().st_size} bytes", f"Keep it below {MAX_BYTES} bytes.")
        return path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        where, got = undecodable(error, str(path))
        raise complaint(where, "UTF-8 text", got, REMEDY) from None
    except (OSError, ValueError) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
        raise refuse(reason, "Check the path and its permissions.") from None
