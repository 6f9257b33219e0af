"""Spearman's rank correlation with a confidence interval that is valid for few rows."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import atanh, sqrt, tanh

from comity_fis.record import Record

Z = 1.959963984540054
"""Quantile of the standard normal distribution for a 95 % interval."""
DIGITS = 12
"""Decimals kept: later digits are rounding errors, which would make 1 slightly less."""
FEWEST = 4
"""Minimum number of rows for an interval: its standard error divides by n - 3."""


@dataclass(frozen=True, slots=True)
class RankCorrelation(Record):
    """Agreement in order of two series of numbers."""

    value: float
    """From -1 (opposite) to 1 (the same order)."""
    rows: int
    low: float | None
    """Lower end of the 95 % interval; None for fewer than four rows."""
    high: float | None


def rank_correlation(first: Sequence[float], second: Sequence[float]) -> RankCorrelation | None:
    """Spearman's coefficient, ties at their mean rank; None where either row has fewer than two values.

    The interval is Fisher's, with the standard error of Bonett and Wright (2000), "Sample size requirements
    for estimating Pearson, Kendall and Spearman correlations", Psychometrika 65, pp. 23-28. A perfect
    order of n rows would give an interval of no width: it is taken half a step lower, the step being what one
    swap of neighbours changes (our choice), which leaves little certainty to few rows.
    """
    rows = len(first)
    if len(set(first)) < 2 or len(set(second)) < 2:
        return None
    from scipy.stats import spearmanr

    value = round(float(spearmanr(first, second).statistic), DIGITS)
    if rows < FEWEST:
        return RankCorrelation(value, rows, None, None)
    most = 1 - 6 / (rows * (rows**2 - 1))
    centre = min(most, max(-most, value))
    reach = Z * sqrt((1 + centre**2 / 2) / (rows - 3))
    low, high = tanh(atanh(centre) - reach), tanh(atanh(centre) + reach)
    return RankCorrelation(value, rows, min(low, value), max(high, value))
