"""Quotes in sentences: those that YAML takes for its own, and those of a name that is an article, too."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence

from comity.testing.grammar.sentence import Place, parsed
from comity.testing.grammar.vocabulary import ARTICLE, QUOTED
from comity_fis import InputError, Where

_QUOTES = "'\""


def advised(refusal: InputError, text: str) -> InputError:
    """What YAML says of a file; where it stumbles over the quotes of a sentence, how to write that.

    Args:
        refusal: With the line.
        text: The file.
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
    """Refuse an article that may be a person, and a name of several words, which would be taken for several.

    Args:
        text: The sentence.
        names: Those that may stand in it.
        place: Of the n-th character.

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
    """Whether a line begins an item of the list under `expect`, whose dash may stand below the `e`."""
    dash = lines[at].find("- ")
    if lines[at][:dash].strip():
        return False
    above = (line for line in reversed(lines[:at]) if not re.match(rf"\s*$| *#| {{{dash},}}[ -]", line))
    return re.match(r"expect:\s*(#.*)?$", next(above, "")) is not None


def _unquoted(item: str) -> Iterator[str]:
    """The sentence as it stands, and without the quotes around it; only what has any in it."""
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
