"""Formats numbers with as many digits as their range needs, even if they are large compared with it."""

from __future__ import annotations

from math import ceil, log10

MOST = 17
"""Significant digits that distinguish all floats."""


def resolving_digits(number: float, span: float, digits: int) -> int:
    """Significant digits that resolve a number as finely as `digits` resolve its range.

    Args:
        number: It may be far larger than its range: 1.7e9 in a range of 0.5.
        span: Width of the range, above 0.
        digits: Significant digits relative to the range.
    """
    if not number or not span:
        return digits
    return min(digits + max(0, ceil(log10(abs(number)) - log10(span))), MOST)


def resolved(number: float, span: float, digits: int = 5) -> str:
    """The number as text: `24.344` in a range of 85, `2.4344e-06` in one of 8.5e-06."""
    return f"{number:.{resolving_digits(number, span, digits)}g}"
