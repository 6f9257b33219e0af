"""Accuracy on (culture, parameter) tuples: what a rulebook says, held against what studies measured.

Studies measure in different ways, so that rows are only ever compared inside their study.
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
    """One measured number beside what the rulebook says, both in the parameter's unit and convention."""

    measured: float
    predicted: float
    score: float | None = None
    """Individualism, which the straight line goes by; None where the row has none."""

    @property
    def error(self) -> float:
        """Positive where the rulebook says more than was measured."""
        return self.predicted - self.measured


@dataclass(frozen=True, slots=True)
class StudyAccuracy(Record):
    """What the rows of one study say about a rulebook. Errors in the parameter's unit."""

    rows: int
    mean_absolute_error: float
    bias: float
    """Mean error, with its sign."""
    neutral: float
    """Mean absolute error of the parameter's neutral value: of knowing nothing of anybody."""
    constant: float | None
    """Mean absolute error of the mean of the study's other rows; None for a single row."""
    line: float | None
    """The same of a straight line over individualism through the other rows; None where they make none."""
    rank_correlation: RankCorrelation | None
    """Of predicted and measured; None where all are alike."""
    order: OrderCounts
    """Of the pairs of rows that were measured differently, or alike."""


def accuracy(
    studies: Mapping[str, Sequence[Compared]], *, band: float, neutral: float
) -> dict[str, StudyAccuracy]:
    """Each study by itself; the order of its rows does not matter.

    Args:
        studies: By name, its rows, at least one.
        band: The largest difference that counts as none, in the parameter's unit.
        neutral: What the rulebook says of a person of whom nothing is known.
    """
    return {name: study_accuracy(rows, band, neutral) for name, rows in studies.items()}


def study_accuracy(rows: Sequence[Compared], band: float, neutral: float) -> StudyAccuracy:
    """What the rows of one study say."""
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
    """Mean absolute error of saying, for each row, the mean of the others.

    It needs no correlation beside it: leaving a row out moves the mean away from that row, so that the order
    of these predictions is always the opposite of what was measured.
    """
    rows = len(measured)
    if rows < 2:
        return None
    return float(np.abs(measured - measured.mean()).mean() * rows / (rows - 1))


def line_error(scores: Floats, measured: Floats) -> float | None:
    """Mean absolute error of saying, for each row, what a line of least squares through the others says.

    A row's residual when it is left out is its residual over 1 - h, h being its leverage (Belsley, Kuh,
    Welsch 1980). None where a row has no score, or where the others of some row share one score: no line goes
    through them.
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
    """How the order of every pair of rows comes out, each pair once; what was measured equal has none."""
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
