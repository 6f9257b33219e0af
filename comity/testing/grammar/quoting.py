"""Quotes in sentences: those that YAML strips, and those around names that are also articles."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence

from comity.testing.grammar.sentence import Place, parsed
from comity.testing.grammar.vocabulary import ARTICLE, QUOTED
from comity_fis import InputError, Where

_QUOTES = "'\""


def advised(refusal: InputError, text: str) -> InputError:
    """YAML's error; if the quotes of a sentence caused it, with the correct spelling as the remedy.

    Args:
        refusal: YAML's error, with the line.
        text: Content of the file.
    """
    line = refusal.where.line if refusal.where else None
    lines = text.split("\n")
    if line is None or line > len(lines) or not _in_expect(lines, line - 1):
        return refusal
    better = next(filter(_is_sentence, _unquoted(lines[line - 1].strip().removeprefix("- ").strip())), None)
    if better is None:
        return refusal
    doubled = better.replace("'", "''")
    return InputError(
        expected="one text behind the dash",
        got="quotes that YAML takes for those of a text of their own",
        remedy=f"Put quotes around the whole sentence: `- '{doubled}'`.",
        where=refusal.where,
    )


def require_quotes(text: str, names: Collection[str], place: Place) -> None:
    """Refuse unquoted names that would be misread: an article, or a name of several words.

    Args:
        text: The sentence.
        names: Names that may occur in it.
        place: Position of the n-th character.

    Raises:
        InputError: with its place.
    """
    articles = [name for name in names if re.fullmatch(ARTICLE, name, re.IGNORECASE)]
    phrases = [name for name in names if " " in name]
    if not articles and not phrases:
        return
    bare = re.sub(QUOTED, lambda quoted: " " * len(quoted[0]), text)
    for name in sorted(phrases, key=len, reverse=True):
        if found := re.search(rf"(?<!\w){re.escape(name)}(?!\w)", bare):
            raise InputError(
                expected=f"quotes around the name {name!r}, which has several words",
                got=f"{name!r} without them",
                remedy=f'Write `"{name}"`.',
                where=place(found.start()),
            )
    for word in re.finditer(rf"(?<![\w./-]){ARTICLE}", bare, re.IGNORECASE):
        if word[0] in articles:
            raise InputError(
                expected=f"quotes around the name {word[0]!r}, which is an article, too",
                got=f"{word[0]!r} without them",
                remedy=f'Write `"{word[0]}"`; an article can be left out.',
                where=place(word.start()),
            )


def _in_expect(lines: Sequence[str], at: int) -> bool:
    """Whether a line begins an item of the `expect` list, whose dash may be indented less than usual."""
    dash = lines[at].find("- ")
    if lines[at][:dash].strip():
        return False
    above = (line for line in reversed(lines[:at]) if not re.match(rf"\s*$| *#| {{{dash},}}[ -]", line))
    return re.match(r"expect:\s*(#.*)?$", next(above, "")) is not None


def _unquoted(item: str) -> Iterator[str]:
    """The sentence as written, and without the quotes around it; only if it contains quotes."""
    if any(sign in item for sign in _QUOTES):
        yield item
        if item[0] in _QUOTES and item[-1] == item[0]:
            yield item[1:-1]


def _is_sentence(text: str) -> bool:
    try:
        parsed(text, lambda _: Where("expect"))
    except InputError:
        return False
    return True
