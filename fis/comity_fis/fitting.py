"""Least-squares fit of the paper's membership functions to degrees at given places."""

from __future__ import annotations

from itertools import combinations_with_replacement
from typing import TYPE_CHECKING

import numpy as np

from comity_fis.membership import Bump, TwoTermGaussian

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

STARTS = 5
"""Places along the data's range where each bump's centre starts; every second start finds the paper's
optima."""


def fit_two_term_gaussian(places: Floats, degrees: Floats) -> tuple[TwoTermGaussian, float]:
    """The nearest two-term Gaussian with heights of at least 0, and its squared error over all points.

    Without that bound the optimum has a negative height and negative memberships. Repeated places count.
    """
    from scipy.optimize import least_squares

    def misses(p: Floats) -> Floats:
        first = p[0] * np.exp(-(((places - p[1]) / p[2]) ** 2))
        second = p[3] * np.exp(-(((places - p[4]) / p[5]) ** 2))
        return np.asarray(first + second - degrees)

    def slopes(p: Floats) -> Floats:
        return np.column_stack([*_slopes(places, p[:3]), *_slopes(places, p[3:])])

    low, high = float(places.min()), float(places.max())
    span = high - low
    lowest, highest = [0.0, low - 4 * span, span / 100], [3.0, high + 4 * span, 5 * span]
    fits = [
        least_squares(
            misses,
            np.array([0.7, left, width, 0.5, right, width]),
            jac=slopes,
            bounds=(lowest * 2, highest * 2),
            xtol=1e-15,
            ftol=1e-15,
            gtol=1e-15,
        )
        for left, right in combinations_with_replacement(np.linspace(low, high, STARTS), 2)
        for width in (span / 8, span / 3)
    ]
    best = min(fits, key=lambda fit: float(fit.cost))
    bumps = Bump(*best.x[:3].tolist()), Bump(*best.x[3:].tolist())
    return TwoTermGaussian(*sorted(bumps, key=lambda bump: bump.centre)), 2 * float(best.cost)


def _slopes(places: Floats, p: Floats) -> tuple[Floats, Floats, Floats]:
    """The derivatives of a bump by its height, centre and width."""
    height, centre, width = p
    off = (places - centre) / width
    unit = np.exp(-(off**2))
    return unit, 2 * height * unit * off / width, 2 * height * unit * off**2 / width
