"""Accuracy on (culture, parameter) tuples: a rulebook's predictions compared with measured values.

Studies measure differently, so rows are compared only within their study.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import fsum, nan

import numpy as np
from numpy.typing import NDArray

from comity_fis.audit.order import OrderCounts, directions
from comity_fis.audit.rank_correlation import RankCorrelation, rank_correlation
from comity_fis.record import Record

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Compared:
    """A measured value and the rulebook's prediction, both in the parameter's unit and convention."""

    measured: float
    predicted: float
    score: float | None = None
    """Individualism score, the predictor of the straight line; None if the row has none."""

    @property
    def error(self) -> float:
        """Prediction error; positive if the rulebook's value is larger than measured."""
        return self.predicted - self.measured


@dataclass(frozen=True, slots=True)
class StudyAccuracy(Record):
    """Accuracy of a rulebook on the rows of one study. Errors are in the parameter's unit."""

    rows: int
    mean_absolute_error: float
    bias: float
    """Mean signed error."""
    neutral: float
    """Mean absolute error of always predicting the parameter's neutral value."""
    constant: float | None
    """Mean absolute error of predicting the mean of the study's other rows; None for a single row."""
    line: float | None
    """Mean absolute error of a regression line over individualism through the other rows; None if
    undefined."""
    rank_correlation: RankCorrelation | None
    """Rank correlation of predicted and measured values; None if all are equal."""
    order: OrderCounts
    """Order agreement over the pairs of rows."""


def accuracy(
    studies: Mapping[str, Sequence[Compared]], *, band: float, neutral: float
) -> dict[str, StudyAccuracy]:
    """Accuracy for each study separately; the order of its rows does not matter.

    Args:
        studies: Rows of each study, at least one, by name.
        band: Largest difference that counts as none, in the parameter's unit.
        neutral: The rulebook's value for a person about whom nothing is known.
    """
    return {name: study_accuracy(rows, band, neutral) for name, rows in studies.items()}


def study_accuracy(rows: Sequence[Compared], band: float, neutral: float) -> StudyAccuracy:
    """Accuracy on the rows of one study."""
    rows = sorted(rows, key=lambda row: (row.measured, row.predicted, _number(row.score)))
    measured, predicted = _column(row.measured for row in rows), _column(row.predicted for row in rows)
    errors = [row.error for row in rows]
    return StudyAccuracy(
        rows=len(rows),
        mean_absolute_error=fsum(map(abs, errors)) / len(rows),
        bias=fsum(errors) / len(rows),
        neutral=fsum(abs(neutral - row.measured) for row in rows) / len(rows),
        constant=constant_error(measured),
        line=line_error(_column(_number(row.score) for row in rows), measured),
        rank_correlation=rank_correlation(measured.tolist(), predicted.tolist()),
        order=order_of(measured, predicted, band),
    )


def constant_error(measured: Floats) -> float | None:
    """Mean absolute error of predicting, for each row, the mean of the others.

    There is no correlation for it: leaving a row out moves the mean away from that row, so these predictions
    always have the opposite order of the measurements.
    """
    rows = len(measured)
    if rows < 2:
        return None
    return float(np.abs(measured - measured.mean()).mean() * rows / (rows - 1))


def line_error(scores: Floats, measured: Floats) -> float | None:
    """Mean absolute error of predicting each row by a least-squares line through the others.

    The leave-one-out residual of a row is its residual divided by 1 - h, where h is its leverage (Belsley,
    Kuh, Welsch 1980). None if a row has no score, or if the others of some row share one score, so that no
    line is defined.
    """
    rows = len(scores)
    if rows < 3 or np.isnan(scores).any():
        return None
    off = scores - scores.mean()
    spread = float(off @ off)
    if spread == 0 or max(Counter(scores.tolist()).values()) >= rows - 1:
        return None
    leverage = 1 / rows + off**2 / spread
    residuals = measured - measured.mean() - off * (off @ measured) / spread
    return float(np.abs(residuals / (1 - leverage)).mean())


def order_of(measured: Floats, predicted: Floats, band: float) -> OrderCounts:
    """Agreement in order for every pair of rows, each pair once; pairs measured as equal are skipped."""
    counts = OrderCounts(0, 0, 0)
    for i in range(len(measured) - 1):
        found = directions(measured[i + 1 :] - measured[i], band)
        said = directions(predicted[i + 1 :] - predicted[i], band)
        said = said[found != 0]
        found = found[found != 0]
        agreeing, equal = int((said == found).sum()), int((said == 0).sum())
        counts += OrderCounts(agreeing, len(found) - agreeing - equal, equal)
    return counts


def _number(score: float | None) -> float:
    return nan if score is None else score


def _column(numbers: Iterable[float]) -> Floats:
    return np.fromiter(numbers, dtype=np.float64)
