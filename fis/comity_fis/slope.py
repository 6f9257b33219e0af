"""How fast a degree of membership changes, on one side of a value."""

from __future__ import annotations

from math import inf
from typing import Literal

from comity_fis.membership import Bump, Membership, Trapezoid, TwoTermGaussian

Side = Literal[-1, 1]
"""Below or above: at a corner the two slopes differ."""

HERE = 1e-8
"""Relative to the value's size, or to 1 where that is smaller."""


def slope(term: Membership, x: float, side: Side) -> float:
    """The derivative of a membership function at `x`, coming from one side; infinite where it jumps there."""
    match term:
        case Trapezoid():
            return _of_trapezoid(term, x, side)
        case TwoTermGaussian(first, second):
            above_the_cut = first(x) + second(x) > 1.0
            return 0.0 if above_the_cut else _of_bump(first, x) + _of_bump(second, x)
        case _:
            return _by_differences(term, x, side)


def _of_trapezoid(term: Trapezoid, x: float, side: Side) -> float:
    a, b, c, d = term.knots
    rises, falls = (a <= x < b, c <= x < d) if side > 0 else (a < x <= b, c < x <= d)
    if rises:
        return 1 / (b - a)
    if falls:
        return -1 / (d - c)
    # A vertical edge belongs to the trapezoid: leaving it is a jump down.
    if side < 0 and x == a == b:
        return inf
    return -inf if side > 0 and x == c == d else 0.0


def _of_bump(bump: Bump, x: float) -> float:
    return -2 * (x - bump.centre) / bump.width**2 * bump(x)


def _by_differences(term: Membership, x: float, side: Side) -> float:
    """From three values on the one side, none of them beyond the next knot: good to about 1e-7.

    A knot that is nearer than `HERE` counts as `x` itself: between values so close only rounding differs.
    """
    scale = max(1.0, abs(x))
    ahead = [side * (knot - x) for knot in term.knots if side * (knot - x) > HERE * scale]
    step = side * min([1e-5 * scale, *(distance / 2 for distance in ahead)])
    return (-3 * term(x) + 4 * term(x + step) - term(x + 2 * step)) / (2 * step)
