"""Degrees of many numbers at once: MATLAB's curves are scikit-fuzzy's, whose functions take arrays."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from comity_fis.membership.curved import Curved
from comity_fis.membership.function import (
    Bump,
    Complement,
    Membership,
    Singleton,
    Trapezoid,
    TwoTermGaussian,
)

Floats = NDArray[np.float64]


@np.errstate(over="ignore")  # steep edges, exp and powers may overflow on the way to a degree of 0 or 1
def degrees(term: Membership, xs: Floats) -> Floats:
    """The degrees of numbers, in an array of the same shape."""
    match term:
        case Trapezoid():
            return _trapezoid(term, xs)
        case Singleton(place):
            at_place: Floats = np.asarray(xs == place, dtype=np.float64)
            return at_place
        case TwoTermGaussian(first, second):
            return np.minimum(_bump(first, xs) + _bump(second, xs), 1.0)
        case Complement(part):
            return 1.0 - degrees(part, xs)
        case Curved():
            return _curve(term, xs.ravel()).reshape(xs.shape)
    one_by_one = (term(x) for x in xs.ravel().tolist())
    return np.fromiter(one_by_one, dtype=np.float64, count=xs.size).reshape(xs.shape)


def _trapezoid(term: Trapezoid, xs: Floats) -> Floats:
    """Faster than scikit-fuzzy's, and most columns are of trapezoids; an edge may be vertical."""
    a, b, c, d = term.knots
    rising = (xs - a) / (b - a) if a < b else np.where(xs >= b, 1.0, 0.0)
    falling = (d - xs) / (d - c) if c < d else np.where(xs <= c, 1.0, 0.0)
    np.minimum(rising, falling, out=rising)
    return np.clip(rising, 0.0, 1.0, out=rising)


def _bump(bump: Bump, xs: Floats) -> Floats:
    off = xs - bump.centre
    off *= 1 / bump.width
    off *= off
    np.negative(off, out=off)
    np.exp(off, out=off)
    off *= bump.height
    return off


def _curve(term: Curved, xs: Floats) -> Floats:
    import skfuzzy

    numbers = term.parameters
    match term.matlab:
        case "gauss2mf":  # scikit-fuzzy refuses crossed centres
            left_sigma, left, right_sigma, right = numbers
            rise = skfuzzy.gaussmf(np.minimum(xs, left), left, left_sigma)
            found = rise * skfuzzy.gaussmf(np.maximum(xs, right), right, right_sigma)
        case "pimf":  # and crossed shoulders
            found = skfuzzy.smf(xs, *numbers[:2]) * skfuzzy.zmf(xs, *numbers[2:])
        case "gaussmf" | "sigmf" | "dsigmf" | "psigmf":  # in MATLAB the width comes first
            pairs = zip(numbers[1::2], numbers[::2], strict=True)
            found = getattr(skfuzzy, term.matlab)(xs, *(number for pair in pairs for number in pair))
        case _:
            found = getattr(skfuzzy, term.matlab)(xs, *numbers)
    degrees: NDArray[Any] = np.abs(found)  # MATLAB's dsigmf is the absolute difference
    return degrees
