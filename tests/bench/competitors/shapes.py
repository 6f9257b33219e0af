"""Membership functions by formula, and sampled universes."""

from __future__ import annotations

from typing import Any

import numpy as np


def universe(of: dict[str, Any], points: int) -> Any:
    """Evenly spaced points; ten per category, so that each category has points of its own."""
    return np.linspace(*of["range"], 10 * of["categories"] + 1 if of["categories"] else points)


def degrees(shape: dict[str, Any], xs: Any) -> Any:
    """The degrees of many numbers."""
    if "two_term_gaussian" in shape:
        bumps = shape["two_term_gaussian"]
        return np.minimum(1.0, sum(a * np.exp(-(((xs - b) / c) ** 2)) for a, b, c in bumps))
    a, b, c, d = shape["trapezoid"]
    rising = (xs - a) / (b - a) if b > a else np.where(xs >= a, 1.0, 0.0)
    falling = (d - xs) / (d - c) if d > c else np.where(xs <= d, 1.0, 0.0)
    return np.clip(np.minimum(rising, falling), 0.0, 1.0)
