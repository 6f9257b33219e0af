"""Local extrema of a function: the points between which it is monotonic."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise

Function = Callable[[float], float]

GOLDEN = (5**0.5 - 1) / 2

SAME = 1e-12
"""Tolerance: values that differ by less are equal."""


def turning_places(function: Function, knots: Sequence[float]) -> tuple[float, ...]:
    """The knots and every local extremum between them.

    Args:
        function: At most one maximum and one minimum between neighbouring knots, and none beyond them.
        knots: Ascending.
    """
    turns = {
        turn
        for left, right in pairwise(knots)
        for sign in (1, -1)
        for turn in (extreme(function, sign, left, right),)
        if sign * function(turn) > max(sign * function(left), sign * function(right)) + SAME
    }
    return tuple(sorted({*knots, *turns}))


def extreme(function: Function, sign: int, low: float, high: float) -> float:
    """Location of the maximum in [low, high], or minimum for sign -1, by golden-section search."""
    best = max((sign * function(x), x) for x in (low, high))
    for _ in range(60):  # 0.618^60 is below 1e-12
        left, right = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
        at_left, at_right = sign * function(left), sign * function(right)
        best = max(best, (at_left, left), (at_right, right))
        low, high = (low, right) if at_left >= at_right else (left, high)
    return best[1]


def largest(function: Function, places: Sequence[float], low: float, high: float) -> float:
    """The maximum in [low, high] of a function whose extrema are among `places`."""
    return max(function(x) for x in (low, *(x for x in places if low < x < high), high))


def crossing(function: Function, low: float, high: float) -> float:
    """Root of a function that changes sign between the ends, by bisection."""
    rises = function(high) > 0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (low, middle) if (function(middle) > 0) is rises else (middle, high)
    return (low + high) / 2
