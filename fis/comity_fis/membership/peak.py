"""The largest value of a function that has one peak at most between neighbouring knots."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from itertools import pairwise

GOLDEN = (5**0.5 - 1) / 2


def highest(function: Callable[[float], float], knots: Iterable[float], low: float, high: float) -> float:
    """The largest value in [low, high], to 1e-12 of the distance between knots."""
    places = (low, *sorted(x for x in knots if low < x < high), high)
    return max(function(peak(function, left, right)) for left, right in pairwise(places))


def peak(function: Callable[[float], float], low: float, high: float) -> float:
    """Where the largest value in [low, high] is, by golden-section search."""
    best = max((low, high), key=function)
    for _ in range(60):  # 0.618^60 is below 1e-12
        left, right = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
        best = max((best, left, right), key=function)
        low, high = (low, right) if function(left) >= function(right) else (left, high)
    return best
