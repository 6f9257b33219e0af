"""The reference engine: the same rulebook through scikit-fuzzy's plain functions.

Slow, and a second opinion on ours, which the tests compare with it. `skfuzzy.control` is not used: it keeps
answers from earlier calls and shares state between simulations.
"""

from __future__ import annotations

import numpy as np
import skfuzzy
from numpy.typing import NDArray

from comity_fis.defuzzification.output_set import OutputSet
from comity_fis.membership.arrays import degrees
from comity_fis.membership.function import (
    Complement,
    NumericMembership,
    Singleton,
    Trapezoid,
    TwoTermGaussian,
)

SAMPLES = 2001
"""Of the output's range; `skfuzzy.defuzz` integrates piecewise: more of them come nearer to the exact
answer."""


def degree(term: NumericMembership, x: float) -> float:
    """The membership of one value."""
    return float(_sampled(term, np.array([x], dtype=float))[0])


def value(curve: OutputSet) -> float | None:
    """The value of a set by its rulebook's method; scikit-fuzzy has all of MATLAB's."""
    if curve.all_singletons:  # scikit-fuzzy has no singletons
        return curve.value()
    xs = np.linspace(*curve.domain, SAMPLES)
    implied = np.fmin if curve.methods.implication == "min" else np.multiply
    united = np.zeros_like(xs)
    for term, strength in curve.layers:
        layer = implied(strength, _sampled(term, xs))
        match curve.methods.aggregation:
            case "max":
                united = np.fmax(united, layer)
            case "sum":
                united = united + layer
            case "probor":
                united = united + layer - united * layer
    if not united.any():
        return None
    return float(np.asarray(skfuzzy.defuzz(xs, united, curve.methods.defuzzification)))


def _sampled(term: NumericMembership, xs: NDArray[np.float64]) -> NDArray[np.float64]:
    match term:
        case Trapezoid():
            return np.asarray(skfuzzy.trapmf(xs, list(term.knots)))
        case Singleton(place):
            return np.asarray(xs == place, dtype=np.float64)
        case Complement(part):
            return 1.0 - _sampled(part, xs)
        case TwoTermGaussian(first, second):
            # skfuzzy's Gaussian has the factor 2 in its exponent that the paper's has not.
            bumps = [
                bump.height * skfuzzy.gaussmf(xs, bump.centre, bump.width / 2**0.5)
                for bump in (first, second)
            ]
            return np.asarray(np.fmin(1.0, sum(bumps)))
    return degrees(term, xs)
