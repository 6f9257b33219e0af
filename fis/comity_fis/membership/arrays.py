"""Vectorised membership degrees."""

from __future__ import annotations

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
    """Degrees of an array of numbers, in the same shape."""
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
            return term.degrees(xs)
    one_by_one = (term(x) for x in xs.ravel().tolist())
    return np.fromiter(one_by_one, dtype=np.float64, count=xs.size).reshape(xs.shape)


def _trapezoid(term: Trapezoid, xs: Floats) -> Floats:
    """Degrees of a trapezoid, whose edges may be vertical."""
    a, b, c, d = term.knots
    rising = (xs - a) / (b - a) if a < b else np.where(xs >= b, 1.0, 0.0)
    falling = (d - xs) / (d - c) if c < d else np.where(xs <= c, 1.0, 0.0)
    return np.clip(np.minimum(rising, falling), 0.0, 1.0)


def _bump(bump: Bump, xs: Floats) -> Floats:
    found: Floats = bump.height * np.exp(-(((xs - bump.centre) / bump.width) ** 2))
    return found
