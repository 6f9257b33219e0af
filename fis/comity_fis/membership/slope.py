"""How fast a degree of membership changes, on both sides of a value."""

from __future__ import annotations

from math import inf
from typing import Literal

from comity_fis.membership.function import Membership, Singleton, Trapezoid, TwoTermGaussian

Side = Literal[-1, 1]
"""Below or above: at a corner the two slopes differ."""

HERE = 1e-8
"""Relative to the value's size, or to 1 where that is smaller."""


def slopes(term: Membership, x: float) -> tuple[float, float]:
    """The derivatives of a membership function at `x` from below and above; infinite where it jumps there."""
    if isinstance(term, Trapezoid):
        return _of_trapezoid(term, x)
    if isinstance(term, Singleton):
        return (inf, -inf) if x == term.place else (0.0, 0.0)
    if isinstance(term, TwoTermGaussian):
        slope = _of_gaussian(term, x)
        return slope, slope
    return _by_differences(term, x, -1), _by_differences(term, x, 1)


def _of_trapezoid(term: Trapezoid, x: float) -> tuple[float, float]:
    a, b, c, d = term.a, term.b, term.c, term.d
    if a < x < b:
        return 1 / (b - a), 1 / (b - a)
    if c < x < d:
        return -1 / (d - c), -1 / (d - c)
    # A vertical edge belongs to the trapezoid: leaving it is a jump down.
    below = above = 0.0
    if x == a == b:
        below = inf
    elif a < b and x == a:
        above = 1 / (b - a)
    elif a < b and x == b:
        below = 1 / (b - a)
    if x == c == d:
        above = -inf
    elif c < d and x == c:
        above = -1 / (d - c)
    elif c < d and x == d:
        below = -1 / (d - c)
    return below, above


def _of_gaussian(term: TwoTermGaussian, x: float) -> float:
    first, second = term.first, term.second
    one, other = first(x), second(x)
    if one + other > 1.0:
        return 0.0  # cut off
    slopes = (x - first.centre) / first.width**2 * one + (x - second.centre) / second.width**2 * other
    return -2 * slopes


def _by_differences(term: Membership, x: float, side: Side) -> float:
    """From three values on the one side, none of them beyond the next knot: good to about 1e-7.

    A knot that is nearer than `HERE` counts as `x` itself: between values so close only rounding differs.
    """
    scale = max(1.0, abs(x))
    ahead = [side * (knot - x) for knot in term.knots if side * (knot - x) > HERE * scale]
    step = side * min([1e-5 * scale, *(distance / 2 for distance in ahead)])
    return (-3 * term(x) + 4 * term(x + step) - term(x + 2 * step)) / (2 * step)
