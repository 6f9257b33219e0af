"""Parsing of sentences with the grammar, and error messages for those that it refuses."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from contextlib import suppress
from difflib import SequenceMatcher
from functools import cache, lru_cache
from typing import Any

from lark import Lark, Token, Transformer, Tree, UnexpectedInput
from lark.exceptions import UnexpectedCharacters, UnexpectedToken, VisitError

from comity.testing.amounts.amount import Amount, Bounds, Times
from comity.testing.expectation import Expectation, ProfileComparison
from comity.testing.grammar.rewording import renamed, rewordings
from comity.testing.grammar.spelling import unit_meant, units_told
from comity.testing.grammar.vocabulary import KEYWORDS, MEANING, grammar
from comity.testing.kinds import KINDS
from comity.testing.kinds.metric import MetricBounds
from comity_fis import InputError, Where, closest
from comity_fis.listing import listed
from comity_fis.validation.one_line import JOINERS

Place = Callable[[int], Where]
"""Maps the number of a character, from 0, to its position in the file."""

MAX_LENGTH = 500
"""Maximum number of characters in one sentence."""
KEPT = 2048
"""Size of the cache of parsed sentences: many scenarios use the same ones."""
_NEAR = 0.6
"""Minimum similarity at which a word is taken for a typo."""
_EMPTY = re.compile(r"(['\"])\s*\1")


def parsed(text: str, place: Place) -> tuple[Expectation | ProfileComparison, tuple[str, ...]]:
    """The expectation of a sentence, and the profiles to which it applies (empty for all).

    Raises:
        InputError: with the place of the first wrong word, and the closest known one.
    """
    if len(text) > MAX_LENGTH:
        raise InputError(
            expected=f"a sentence of at most {MAX_LENGTH} characters",
            got=f"{len(text)}",
            remedy="Split it into several.",
            where=place(0),
        )
    odd = next((i for i, sign in enumerate(text) if not _shows(sign)), None)
    if odd is not None:
        raise InputError(
            expected="text without control characters and marks of direction",
            got=f"U+{ord(text[odd]):04X}",
            remedy="Remove it.",
            where=place(odd),
        )
    try:
        meaning, profiles = _meaning(text)
    except UnexpectedInput as error:
        raise _quoted(text, place) or _refusal(error, text, place) from None
    except VisitError as error:
        if isinstance(error.orig_exc, InputError):
            raise error.orig_exc.at(place(0)) from None
        raise
    except InputError as error:
        raise error.at(place(0)) from None
    if isinstance(meaning, MetricBounds) and (now := renamed(meaning.quantity, text)):
        raise InputError(
            expected="a metric", got=repr(meaning.quantity), remedy=f"Write `{now}`.", where=place(0)
        )
    return meaning, profiles


def _quoted(text: str, place: Place) -> InputError | None:
    """The error if quotes around the whole sentence, besides YAML's, turn it into one name."""
    bare = text.strip()[1:-1]
    if text.strip() not in (f'"{bare}"', f"'{bare}'"):
        return None
    try:
        _meaning(bare)
    except (UnexpectedInput, VisitError, InputError):
        return None
    return InputError(
        expected="a sentence",
        got="one name: there are quotes around all of it, besides those of YAML",
        remedy=f"Leave these quotes out: `{bare}`.",
        where=place(0),
    )


def _shows(sign: str) -> bool:
    """Whether a character may be printed: others control terminals or reverse the text direction."""
    return sign.isprintable() or sign.isspace() or sign in JOINERS


@lru_cache(maxsize=KEPT)
def _meaning(text: str) -> tuple[Expectation | ProfileComparison, tuple[str, ...]]:
    """The parsed meaning, cached; it is immutable and independent of its place."""
    found, profiles = _Values().transform(_parser().parse(text)).children
    return KINDS[found.data].read(found.children), tuple(profiles or ())


@cache
def _parser() -> Lark:
    rules = {name: kind.RULE for name, kind in KINDS.items()}
    return Lark(grammar(rules), parser="lalr", start="sentence", maybe_placeholders=True)


class _Values(Transformer[Token, Any]):
    """Converts tokens to words, amounts and counts; the kind itself remains a tree."""

    def __default_token__(self, token: Token) -> str:
        return str(token).strip("'\"")

    def amount(self, parts: Sequence[str | None]) -> Amount:
        number, unit = parts
        return Amount(float(number or 0), unit)

    def names(self, parts: Sequence[str]) -> tuple[str, ...]:
        return tuple(parts)

    def lower(self, parts: Sequence[Amount]) -> Bounds:
        return Bounds(parts[0], None)

    def upper(self, parts: Sequence[Amount]) -> Bounds:
        return Bounds(None, parts[0])

    def between(self, parts: Sequence[Amount]) -> Bounds:
        return Bounds.between(*parts)

    def around(self, parts: Sequence[Amount]) -> Bounds:
        return Bounds.around(*parts)

    def at_least(self, parts: Sequence[str]) -> Times:
        return Times.written("at_least", parts[0])

    def at_most(self, parts: Sequence[str]) -> Times:
        return Times.written("at_most", parts[0])

    def exactly(self, parts: Sequence[str]) -> Times:
        return Times.written("exactly", parts[0])

    def __default__(self, data: str, children: list[Any], meta: Any) -> Tree[Any]:
        return Tree(str(data), children, meta)


def _refusal(error: UnexpectedInput, text: str, place: Place) -> InputError:
    offset, allowed = len(text), set[str]()
    if isinstance(error, UnexpectedCharacters):
        offset, allowed = error.pos_in_stream or 0, set(error.allowed or ())
    elif isinstance(error, UnexpectedToken):
        allowed = set(error.accepts or error.expected)
        if error.token.type != "$END":
            offset = error.token.start_pos or 0
    phrases = sorted(KEYWORDS[name] for name in allowed if name in KEYWORDS)
    others = sorted({MEANING[name] for name in allowed if name in MEANING})
    if len(text[:offset].split()) == 1 and (opening := _nearest(_openings(), text.split())):
        offset, phrases, others = 0, [opening], []  # the first word was taken for a name
    rest = text[offset:].split()
    begun = _begun(text[:offset])
    instead = _of_greeting(text) or _reworded(text)
    measures = "UNIT" in allowed and text[:offset].rstrip()[-1:].isdigit()
    return InputError(
        expected=_either([*others, *(repr(phrase) for phrase in phrases)]) if offset else "an expectation",
        got=_told(rest),
        remedy=instead or _remedy(rest, phrases, begun, measures=measures),
        where=place(offset),
    )


def _told(rest: Sequence[str]) -> str:
    """The unexpected words."""
    if not rest:
        return "the end"
    return "quotes with nothing in them" if _EMPTY.match(" ".join(rest)) else repr(_phrase(rest) or rest[0])


def _either(words: Sequence[str]) -> str:
    return listed(words, "or") or "the end of the sentence"


def _remedy(rest: Sequence[str], phrases: Sequence[str], begun: str | None, *, measures: bool) -> str:
    """The remedy; `measures` says that a unit may follow the last number."""
    slip = bool(rest) and not _phrase(rest)
    near = (unit_meant(rest) if measures and slip else None) or (_nearest(phrases, rest) if slip else None)
    if near:
        return f"Did you mean {near!r}?"
    if measures and slip and not rest[0][:1].isdigit():
        return units_told()
    if begun:
        return f"Write it like `{begun}`."
    return f"{closest(rest[0] if rest else '', _openings())} For example `{KINDS['metric'].EXAMPLE}`."


def _of_greeting(text: str) -> str | None:
    """Remedy if only the beginning is missing: `no touch` is the content of a greeting."""
    whole = f"greeting contains {text}"
    with suppress(UnexpectedInput, VisitError, InputError):
        _meaning(whole)
        return f"Write `{whole}`."
    return None


def _reworded(text: str) -> str | None:
    """Remedy if a rephrased sentence would parse."""
    for other in rewordings(text):
        with suppress(UnexpectedInput, VisitError, InputError):
            _meaning(other)
            return f"Write `{other}`."
    return None


def _nearest(phrases: Sequence[str], rest: Sequence[str]) -> str | None:
    """The phrase that was probably meant by the next words, if any."""
    near = max(phrases, key=lambda phrase: _likeness(phrase, rest), default=None)
    return near if near and _NEAR <= _likeness(near, rest) < 1 else None


def _phrase(rest: Sequence[str]) -> str | None:
    """The keyword formed by the next words, if any: then it is misplaced, not misspelt."""
    known = [phrase for phrase in KEYWORDS.values() if rest[: len(phrase.split())] == phrase.split()]
    return max(known, key=len, default=None)


def _likeness(phrase: str, rest: Sequence[str]) -> float:
    """Similarity in [0, 1] of a phrase and as many words as it has."""
    read = " ".join(rest[: len(phrase.split())]).lower()
    return SequenceMatcher(None, phrase, read).ratio()


def _openings() -> list[str]:
    """The keywords that begin a sentence."""
    firsts = _parser().parse_interactive("").accepts()  # type: ignore[no-untyped-call]
    return sorted(KEYWORDS[first] for first in firsts if first in KEYWORDS)


def _begun(read: str) -> str | None:
    """The example that shares the most words, in order, with the parsed part of a sentence.

    All names count as equal, and so do all numbers and all units. A first word that is no keyword counts only
    if the example begins with the same word.
    """
    words, first = _word_kinds(read), read.lower().split()[:1]
    shared = {
        kind.EXAMPLE: (*_shared(words, _word_kinds(kind.EXAMPLE)), kind.EXAMPLE.lower().split()[:1] == first)
        for kind in KINDS.values()
    }
    best = max(shared, key=lambda example: shared[example])
    most, at_start, literally = shared[best]
    return best if at_start and (most > 1 or literally) else None


def _shared(words: Sequence[str], others: Sequence[str]) -> tuple[int, int]:
    """Number of words common to two sentences in order, and of those common at the start."""
    blocks = SequenceMatcher(None, words, others, autojunk=False).get_matching_blocks()
    at_start = blocks[0].size if blocks[0][:2] == (0, 0) else 0
    return (sum(block.size for block in blocks), at_start) if at_start else (0, 0)


@lru_cache(maxsize=KEPT)
def _word_kinds(text: str) -> tuple[str, ...]:
    """The grammar's terminals of a text, as far as it can be tokenised."""
    found: list[str] = []
    with suppress(UnexpectedCharacters):
        found.extend(token.type for token in _lexer().lex(text))
    return tuple(found)


@cache
def _lexer() -> Lark:
    rules = {name: kind.RULE for name, kind in KINDS.items()}
    return Lark(grammar(rules), parser=None, lexer="basic", start="sentence")
