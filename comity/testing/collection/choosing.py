"""Which tests `-k` chooses: words of their names, `and`, `or`, `not` and brackets, as pytest has them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from typing import Any

from lark import Lark, Token, Transformer, UnexpectedInput
from lark.exceptions import UnexpectedToken

from comity_fis import InputError, Where

Names = Sequence[str]
"""What a test is called by, in small letters."""
Choice = Callable[[Names], bool]

_LETTER = r"[\w:+\-.\[\]\\\/]"
_GRAMMAR = rf"""
    ?either: both (_OR both)*
    ?both: one (_AND one)*
    ?one: _NOT one -> no
        | "(" either ")"
        | WORD -> word
    _AND.2: /and(?!{_LETTER})/
    _OR.2: /or(?!{_LETTER})/
    _NOT.2: /not(?!{_LETTER})/
    WORD: /(?!(and|or|not)(?!{_LETTER})){_LETTER}+/
    %ignore /\s+/
"""
_EXAMPLE = "(german or arab) and not seed1"
_DEEPEST = 100
"""Brackets and `not` in one another: more than anybody writes."""


def choice(words: str) -> Choice:
    """Whether a test is meant: a word holds where it is a part of a name; capitals make no difference.

    Raises:
        InputError: if the words are no such expression.
    """
    if words.count("(") + words.lower().count("not") > _DEEPEST:
        raise _refusal(f"more than {_DEEPEST} brackets and `not`")
    try:
        tree = _parser().parse(words)
    except UnexpectedInput as error:
        at = _place(error, words)
        got = repr(words[at:].split(maxsplit=1)[0]) if at < len(words) else "the end"
        raise _refusal(got, _joined(words, at)) from None
    chosen: Choice = _Choices().transform(tree)
    return chosen


def _place(error: UnexpectedInput, words: str) -> int:
    """Where the first character is that cannot stand there."""
    ended = isinstance(error, UnexpectedToken) and error.token.type == "$END"
    return len(words) if ended else error.pos_in_stream or 0


def _joined(words: str, at: int) -> str | None:
    """The same with `and` wherever it is missing between two words; None where something else is wrong."""
    while at < len(words):
        words = f"{words[:at].rstrip()} and {words[at:]}"
        try:
            _parser().parse(words)
        except UnexpectedInput as error:
            before, at = at, _place(error, words)
            if at <= before + len(" and"):
                return None
        else:
            return words
    return None


def _refusal(got: str, instead: str | None = None) -> InputError:
    return InputError(
        expected="words of tests' names with `and`, `or`, `not` and brackets",
        got=got,
        remedy=f"Write it like `{instead or _EXAMPLE}`.",
        where=Where("-k"),
    )


@cache
def _parser() -> Lark:
    return Lark(_GRAMMAR, parser="lalr", start="either", maybe_placeholders=False)


class _Choices(Transformer[Token, Choice]):
    """From the words to what they choose."""

    def word(self, parts: Sequence[Token]) -> Choice:
        wanted = str(parts[0]).lower()
        return lambda names: any(wanted in name for name in names)

    def no(self, parts: Sequence[Choice]) -> Choice:
        return lambda names: not parts[0](names)

    def both(self, parts: Sequence[Choice]) -> Choice:
        return lambda names: all(part(names) for part in parts)

    def either(self, parts: Sequence[Choice]) -> Choice:
        return lambda names: any(part(names) for part in parts)

    def __default__(self, data: str, children: list[Any], meta: Any) -> Any:
        return children[0]
