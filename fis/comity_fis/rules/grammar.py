"""The rule language: `if individualism is LC1 and gender is not female then approach_speed is slow`.

`and` binds tighter than `or`, and `not` tighter than both; brackets group. A hedge precedes a term (`is very
LC1`, `is not more or less LC1`). Names that are not plain words are quoted.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping
from difflib import get_close_matches
from functools import cache
from typing import Any

from lark import Lark, Token, Transformer, UnexpectedInput, v_args
from lark.exceptions import UnexpectedCharacters, UnexpectedToken, VisitError

from comity_fis.errors import InputError, Where, closest
from comity_fis.listing import listed
from comity_fis.rules.hedge import HEDGES
from comity_fis.rules.rule import And, Condition, Hedged, Is, Not, Or

Place = Callable[[int], Where]
"""Location of the n-th character of a text, counted from 0."""

Terms = Mapping[str, Collection[str]]
"""Names allowed before `is`, each with the terms allowed after it."""

Parts = tuple[Condition, tuple[Is, ...]]
"""A rule's antecedent and consequents."""

MAX_LENGTH = 1000
"""Maximum length of a rule [characters]."""

MAX_NESTING = 50
"""Maximum nesting of brackets and `not`s in a rule; deeper ones would exhaust the stack."""

GRAMMAR = r"""
    rule: _IF _disjunction _THEN consequent (_AND consequent)*
    guard: _disjunction
    consequent: _name _IS _name

    _disjunction: conjunction | either
    either: conjunction (_OR conjunction)+
    ?conjunction: factor (_AND factor)*
    ?factor: literal | negation | "(" _disjunction ")"
    negation: _NOT factor
    ?literal: _name _IS _name -> positive
            | _name _IS _NOT _name -> negative
            | _name _IS HEDGE _name -> hedged
            | _name _IS _NOT HEDGE _name -> not_hedged
    _name: PLAIN | QUOTED

    _IF: /if\b/i
    _THEN: /then\b/i
    _AND: /and\b/i
    _OR: /or\b/i
    _NOT: /not\b/i
    _IS: /is\b/i
    PLAIN: /(?!(if|then|and|or|not|is)\b(?!-))[a-z_][a-z0-9_-]*/i
    HEDGE.1: /(very|extremely|somewhat|more\s+or\s+less)\b(?!-)/i
    QUOTED: /'[^'\n]+'|"[^"\n]+"/
    %ignore /\s+/
"""

NESTS = re.compile(r"\(|\bnot\b", re.IGNORECASE)
AFTER_IS = re.compile(r"\bis\s+(?:not\s+)?(?P<word>[a-z_][a-z0-9_-]*)\s+$", re.IGNORECASE)
"""A word in the position of a hedge, at the end of the text parsed so far."""

TWICE = re.compile(rf"\b(?:{'|'.join(HEDGES)})\s+(?P<word>{'|'.join(HEDGES)})\s+$", re.IGNORECASE)
"""A hedge after a hedge, at the end of the text parsed so far."""

MEANING = {
    "PLAIN": "a name",
    "LPAR": "'('",
    "RPAR": "')'",
    "$END": "the end",
    "QUOTED": "a name",
    "HEDGE": "a hedge",
}
"""Names of the terminals in messages, except for keywords."""


def parse_rule(
    text: str, *, inputs: Terms, outputs: Terms, place: Place = lambda n: Where("rule", 1, n + 1)
) -> Parts:
    """Parse a rule into its antecedent and consequents.

    Args:
        text: The rule.
        inputs: What a rule may read.
        outputs: What a rule may conclude.
        place: Location of a character, for messages.

    Raises:
        InputError: With the location of the first wrong word, and the closest known one.
    """
    parts: Parts = _parsed(text, "rule", inputs, outputs, place)
    return parts


def parse_guard(
    text: str, *, inputs: Terms, place: Place = lambda n: Where("requires", 1, n + 1)
) -> Condition:
    """Parse a condition without conclusion, such as `touch_consent is given`.

    Raises:
        InputError: As in `parse_rule`.
    """
    condition: Condition = _parsed(text, "guard", inputs, {}, place)
    return condition


@cache
def _parser() -> Lark:
    return Lark(GRAMMAR, parser="lalr", start=["rule", "guard"], propagate_positions=False)


def _parsed(text: str, start: str, inputs: Terms, outputs: Terms, place: Place) -> Any:
    if len(text) > MAX_LENGTH:
        raise InputError(
            expected=f"at most {MAX_LENGTH} characters",
            got=f"{len(text)}",
            remedy="Split it into several rules.",
            where=place(0),
        )
    if (nesting := len(NESTS.findall(text))) > MAX_NESTING:
        raise InputError(
            expected=f"at most {MAX_NESTING} brackets and `not`s in one rule",
            got=f"{nesting}",
            remedy="Split it into several rules.",
            where=place(0),
        )
    try:
        return _Builder(inputs, outputs, place).transform(_parser().parse(text, start=start))
    except UnexpectedInput as error:
        raise _syntax_error(error, text, place) from None
    except VisitError as error:
        raise error.orig_exc from None


def _syntax_error(error: UnexpectedInput, text: str, place: Place) -> InputError:
    offset, got, allowed = len(text), "the end", set[str]()
    if isinstance(error, UnexpectedCharacters):
        offset = error.pos_in_stream or 0
        got, allowed = repr(text[offset]), error.allowed
    elif isinstance(error, UnexpectedToken):
        allowed = error.accepts or error.expected
        if error.token.type != "$END":
            offset, got = error.token.start_pos or 0, repr(str(error.token))
    words = sorted({MEANING.get(name, f"{name.lower().lstrip('_')!r}") for name in allowed})
    if hedge := _hedge_error(text[:offset], place):
        return hedge
    return InputError(
        expected=listed(words, "or") or "a rule",
        got=got,
        remedy="Write it like `if individualism is LC1 and gender is female then approach_speed is slow`.",
        where=place(offset),
    )


def _hedge_error(read: str, place: Place) -> InputError | None:
    """The error for the last word parsed, if it was meant as a hedge."""
    if twice := TWICE.search(read):
        return InputError(
            expected="one hedge before a term",
            got=repr(twice["word"]),
            remedy="Keep one of them; `extremely` is stronger than `very`.",
            where=place(twice.start("word")),
        )
    word = AFTER_IS.search(read)
    if not word or not get_close_matches(word["word"].lower(), HEDGES, n=1):
        return None
    misplaced = word["word"].lower() in HEDGES
    return InputError(
        expected="a conclusion without a hedge" if misplaced else "a hedge or a term",
        got=repr(word["word"]),
        remedy="A hedge belongs into the condition." if misplaced else closest(word["word"], HEDGES),
        where=place(word.start("word")),
    )


@v_args(inline=True)
class _Builder(Transformer[Token, Any]):
    """Transforms lark's tree to conditions; checks every name while its location is known."""

    def __init__(self, inputs: Terms, outputs: Terms, place: Place) -> None:
        super().__init__()
        self._inputs = inputs
        self._outputs = outputs
        self._place = place

    def rule(self, antecedent: Condition, *consequents: Is) -> Parts:
        return antecedent, consequents

    def guard(self, condition: Condition) -> Condition:
        return condition

    def consequent(self, name: Token, term: Token) -> Is:
        return self._is(name, term, self._outputs, "a parameter of this rulebook")

    def positive(self, name: Token, term: Token) -> Is:
        return self._is(name, term, self._inputs, "a variable of this rulebook")

    def negative(self, name: Token, term: Token) -> Not:
        return Not(self.positive(name, term))

    def hedged(self, name: Token, hedge: Token, term: Token) -> Hedged:
        return Hedged(" ".join(hedge.lower().split()), self.positive(name, term))

    def not_hedged(self, name: Token, hedge: Token, term: Token) -> Not:
        return Not(self.hedged(name, hedge, term))

    def negation(self, part: Condition) -> Not:
        return Not(part)

    def conjunction(self, *parts: Condition) -> And:
        return And(parts)

    def either(self, *parts: Condition) -> Or:
        return Or(parts)

    def _is(self, name: Token, term: Token, known: Terms, what: str) -> Is:
        bare_name, bare_term = name.strip("'\""), term.strip("'\"")
        for word, bare, words, kind in (
            (name, bare_name, known, what),
            (term, bare_term, known.get(bare_name, ()), f"a term of {bare_name}"),
        ):
            if bare not in words:
                raise InputError(
                    expected=kind,
                    got=repr(bare),
                    remedy=getattr(words, "remedy", "") or closest(bare, words),
                    where=self._place(word.start_pos or 0),
                )
        return Is(bare_name, bare_term)
