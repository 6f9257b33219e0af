"""Names in a sentence: `a`, `a and b`, `a, b and c`."""

from __future__ import annotations

from collections.abc import Collection, Iterable


def listed(names: Iterable[str], word: str = "and") -> str:
    """Names as a sentence has them; empty where there are none.

    Args:
        names: In their order.
        word: Before the last: `and` or `or`.
    """
    *most, last = [*names] or [""]
    return f"{', '.join(most)} {word} {last}" if most else last


def with_verb(names: Collection[str], one: str, more: str) -> str:
    """Names and what they do: `ada is`, `ada and ben are`.

    Args:
        names: In their order.
        one: The verb where there is one name.
        more: The verb where there are several.
    """
    return f"{listed(names)} {one if len(names) == 1 else more}"
