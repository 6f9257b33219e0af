"""The reference engine: the same rulebook through scikit-fuzzy's plain functions.

Slow and independent of our own engine, which the tests hold against it. `skfuzzy.control` is not used: it
keeps answers from earlier calls and shares state between simulations.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import skfuzzy
from numpy.typing import NDArray

from comity_fis.centroid import Cut
from comity_fis.membership import NumericMembership, Trapezoid

SAMPLES = 2001
"""Of the output's range; `skfuzzy.defuzz` integrates piecewise: more of them come nearer to the exact
answer."""


def degree(term: NumericMembership, x: float) -> float:
    """The membership of one value."""
    return float(_sampled(term, np.array([x], dtype=float))[0])


def defuzzified(cuts: Sequence[Cut], low: float, high: float) -> float | None:
    """The centre of area of cut terms; None where there is no area."""
    xs = np.linspace(low, high, SAMPLES)
    aggregated = np.zeros_like(xs)
    for cut in cuts:
        aggregated = np.fmax(aggregated, np.fmin(cut.strength, _sampled(cut.term, xs)))
    return float(np.asarray(skfuzzy.defuzz(xs, aggregated, "centroid"))) if aggregated.any() else None


def _sampled(term: NumericMembership, xs: NDArray[np.float64]) -> NDArray[np.float64]:
    if isinstance(term, Trapezoid):
        return np.asarray(skfuzzy.trapmf(xs, list(term.knots)))
    bumps = (term.first, term.second)
    # skfuzzy's Gaussian has the factor 2 in its exponent that the paper's has not.
    total = sum(bump.height * skfuzzy.gaussmf(xs, bump.centre, bump.width / 2**0.5) for bump in bumps)
    return np.asarray(np.fmin(1.0, total))
