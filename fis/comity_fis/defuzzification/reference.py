"""The reference engine: the same rulebook through scikit-fuzzy's plain functions.

Slow and independent of our own engine, which the tests hold against it. `skfuzzy.control` is not used: it
keeps answers from earlier calls and shares state between simulations.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import skfuzzy
from numpy.typing import NDArray

from comity_fis.defuzzification.centroid import Cut
from comity_fis.defuzzification.output_set import OutputSet
from comity_fis.membership.curved import Complement, Curved
from comity_fis.membership.function import NumericMembership, Trapezoid, TwoTermGaussian

SAMPLES = 2001
"""Of the output's range; `skfuzzy.defuzz` integrates piecewise: more of them come nearer to the exact
answer."""

OTHER_ORDER = {
    "gaussmf": (1, 0),
    "gauss2mf": (1, 0, 3, 2),
    "sigmf": (1, 0),
    "dsigmf": (1, 0, 3, 2),
    "psigmf": (1, 0, 3, 2),
}
"""Where scikit-fuzzy wants which of MATLAB's parameters."""


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


def defuzzified_by_method(curve: OutputSet) -> float | None:
    """The value of a set by its rulebook's method; scikit-fuzzy has all of MATLAB's."""
    xs = np.linspace(*curve.domain, SAMPLES)
    degrees = np.array([curve.degree(x) for x in xs.tolist()])
    if not degrees.any():
        return None
    return float(np.asarray(skfuzzy.defuzz(xs, degrees, curve.methods.defuzzification)))


def _sampled(term: NumericMembership, xs: NDArray[np.float64]) -> NDArray[np.float64]:
    if isinstance(term, Trapezoid):
        return np.asarray(skfuzzy.trapmf(xs, list(term.knots)))
    if isinstance(term, Complement):
        return 1.0 - _sampled(term.part, xs)
    if not isinstance(term, TwoTermGaussian):
        return _sampled_curve(term, xs)
    bumps = (term.first, term.second)
    # skfuzzy's Gaussian has the factor 2 in its exponent that the paper's has not.
    total = sum(bump.height * skfuzzy.gaussmf(xs, bump.centre, bump.width / 2**0.5) for bump in bumps)
    return np.asarray(np.fmin(1.0, total))


def _sampled_curve(term: Curved, xs: NDArray[np.float64]) -> NDArray[np.float64]:
    """MATLAB's curves; scikit-fuzzy has them all, some with their parameters in another order."""
    numbers: tuple[float, ...] = term.parameters
    if term.matlab in OTHER_ORDER:
        numbers = tuple(numbers[i] for i in OTHER_ORDER[term.matlab])
    return np.asarray(np.abs(getattr(skfuzzy, term.matlab)(xs, *numbers)))
