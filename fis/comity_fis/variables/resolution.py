"""Numbers with as many digits as their range needs, however large they are beside it."""

from __future__ import annotations

from math import ceil, log10

MOST = 17
"""Significant digits that tell every two numbers apart."""


def resolving_digits(number: float, span: float, digits: int) -> int:
    """Significant digits that give a number as finely as `digits` give its range.

    Args:
        number: Which may be far larger than its range: 1.7e9 in a range of 0.5.
        span: The width of the range, above 0.
        digits: Significant ones of the range.
    """
    if not number or not span:
        return digits
    return min(digits + max(0, ceil(log10(abs(number)) - log10(span))), MOST)


def resolved(number: float, span: float, digits: int = 5) -> str:
    """The number as text: `24.344` in a range of 85, `2.4344e-06` in one of 8.5e-06."""
    return f"{number:.{resolving_digits(number, span, digits)}g}"
