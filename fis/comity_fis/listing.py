"""Names in a sentence: `a`, `a and b`, `a, b and c`."""

from __future__ import annotations

from collections.abc import Iterable


def listed(names: Iterable[str], word: str = "and") -> str:
    """Names as a sentence has them; empty where there are none.

    Args:
        names: In their order.
        word: Before the last: `and` or `or`.
    """
    *most, last = [*names] or [""]
    return f"{', '.join(most)} {word} {last}" if most else last
