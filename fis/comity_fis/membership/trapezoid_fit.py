"""Fits a trapezoid to a curved membership function, for formats without other shapes."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from comity_fis.membership.function import NumericMembership, Trapezoid

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

SAMPLES = 2001
"""Number of sample points over the range; the error is the maximum over them."""


@lru_cache(maxsize=64)
def nearest_trapezoid(term: NumericMembership, low: float, high: float) -> tuple[Trapezoid, float]:
    """A trapezoid with a small maximum error over [low, high], and that error.

    A local search (Nelder and Mead 1965) from several fixed starts. Corners may lie outside the range, where
    the function is never evaluated.
    """
    from scipy.optimize import minimize

    xs = np.linspace(low, high, SAMPLES)
    wanted = np.array([term(x) for x in xs.tolist()])
    span = high - low

    def error(corners: Floats) -> float:
        return float(np.abs(_sampled(np.sort(corners), xs) - wanted).max())

    starts = [_start(xs, wanted, foot, shoulder) for foot in (0.02, 0.1, 0.3) for shoulder in (0.7, 0.9)]
    fits = [
        minimize(
            error,
            start,
            method="Nelder-Mead",
            options={"xatol": 1e-6 * span, "fatol": 1e-7, "maxiter": 4000},
        )
        for start in starts
    ]
    best = min(fits, key=lambda fit: float(fit.fun))
    corners = [float(f"{corner:.6g}") for corner in np.sort(best.x)]
    return Trapezoid(*corners), error(np.array(corners))


def _start(xs: Floats, wanted: Floats, foot: float, shoulder: float) -> Floats:
    """Corners where the term crosses two levels; outside the range if it does not fall within it."""
    span, top = xs[-1] - xs[0], wanted.max()
    above_foot, above_shoulder = xs[wanted >= foot * top], xs[wanted >= shoulder * top]
    a, d = above_foot[0], above_foot[-1]
    return np.array(
        [
            a - span / 2 if a == xs[0] else a,
            above_shoulder[0],
            above_shoulder[-1],
            d + span / 2 if d == xs[-1] else d,
        ]
    )


def _sampled(corners: Floats, xs: Floats) -> Floats:
    a, b, c, d = corners
    tiny = 1e-12 * (xs[-1] - xs[0])
    rise = (xs - a) / max(b - a, tiny)
    fall = (d - xs) / max(d - c, tiny)
    return np.asarray(np.clip(np.minimum(rise, fall), 0.0, 1.0))
