"""Cross-validation: which predictor has the smallest error on unseen rows, and whether beyond chance."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from comity.answers.learning import ErrorAnswer, ErrorDifferenceAnswer
from comity.tables.contenders import Learner
from comity.tables.examples import ExampleRow, LeftOut, unit_of
from comity_fis import InputError, Where
from comity_fis.inference.column import Floats

MOST_FOLDS = 100
"""Maximum number of folds; with more participants or studies, several are held out at a time."""
RESAMPLES, LEAST_UNITS, SEED = 2000, 10, 0
"""Number of resamples, minimum number of units, and seed of the bootstrap; fewer units give no interval, as
it would be too narrow (our choice)."""
ENDS = (2.5, 97.5)
"""Ends of the interval [%]."""


@dataclass(frozen=True, slots=True)
class Judgement:
    """Cross-validated errors of all contenders on the same rows."""

    left_out: LeftOut
    units: int
    errors: Mapping[str, ErrorAnswer]
    """Errors of contenders with predictions, over the rows that they predict."""
    differences: Mapping[str, Mapping[str, ErrorDifferenceAnswer]]
    """Error differences by proposal, then by the contender it is compared with."""


def judged(
    rows: Sequence[ExampleRow],
    learners: Mapping[str, Learner],
    left_out: LeftOut,
    *,
    proposals: Collection[str],
    file: str,
) -> Judgement:
    """Hold out each unit in turn, learn from the rest, and predict the held-out rows.

    Args:
        rows: The rows, at least one.
        learners: Learners by name.
        left_out: Unit of cross-validation.
        proposals: Names of the learners that are compared with all others.
        file: File of the rows, for messages.

    Raises:
        InputError: if there is only one unit.
    """
    units = list(dict.fromkeys(unit_of(row, left_out) for row in rows))
    if len(units) < 2:
        what = {"participant": "participants", "study": "studies", "row": "rows"}[left_out]
        raise InputError(
            expected=f"at least 2 {what}, one of which can be left out",
            got="1",
            remedy="Add rows, or leave out something else with --leave-out.",
            where=Where(file, rows[0].line),
        )
    place = {unit: i for i, unit in enumerate(units)}
    of_row = np.array([place[unit_of(row, left_out)] for row in rows])
    errors = _errors(rows, of_row, learners)
    per_unit = {name: _per_unit(error, of_row, len(units)) for name, error in errors.items()}
    differences = {
        name: {
            other: found
            for other in errors
            if other != name and (found := _difference(errors[name] - errors[other], of_row, len(units)))
        }
        for name in proposals
    }
    return Judgement(
        left_out=left_out,
        units=len(units),
        errors={
            name: ErrorAnswer(
                mean_absolute_error=float(np.nanmean(values)), units=int((~np.isnan(values)).sum())
            )
            for name, values in per_unit.items()
            if not np.isnan(values).all()
        },
        differences=differences,
    )


def _errors(rows: Sequence[ExampleRow], of_row: Floats, learners: Mapping[str, Learner]) -> dict[str, Floats]:
    """By contender, the absolute error of each row; NaN without a prediction."""
    answers = list(_answers(rows))
    folds = of_row % MOST_FOLDS
    errors = {name: np.full(len(rows), np.nan) for name in learners}
    for fold in np.unique(folds):
        seen = [row for row, i in zip(rows, folds, strict=True) if i != fold]
        for name, learner in learners.items():
            predict = learner(seen)
            for i in np.flatnonzero(folds == fold).tolist():
                said = predict(rows[i], answers[i])
                errors[name][i] = np.nan if said is None else abs(said - rows[i].value)
    return errors


def _answers(rows: Sequence[ExampleRow]) -> Iterator[float | None]:
    """The first answer of each row's person; None for that first row itself."""
    first: dict[object, float] = {}
    for row in rows:
        yield first.get(row.person)
        first.setdefault(row.person, row.value)


def _per_unit(values: Floats, of_row: Floats, units: int) -> Floats:
    """Mean of each unit's rows, ignoring NaN; NaN without numbers."""
    there = ~np.isnan(values)
    counts = np.bincount(of_row[there], minlength=units)
    sums = np.bincount(of_row[there], weights=values[there], minlength=units)
    means: Floats = np.divide(sums, counts, out=np.full(units, np.nan), where=counts > 0)
    return means


def _difference(differences: Floats, of_row: Floats, units: int) -> ErrorDifferenceAnswer | None:
    """Mean difference over units with its interval; None if no row has both errors."""
    per_unit = _per_unit(differences, of_row, units)
    found = per_unit[~np.isnan(per_unit)]
    if not len(found):
        return None
    low = high = None
    if len(found) >= LEAST_UNITS:  # paired bootstrap over units (Efron 1979)
        random = np.random.default_rng(SEED)
        means = [found[random.integers(0, len(found), len(found))].mean() for _ in range(RESAMPLES)]
        low, high = map(float, np.percentile(means, ENDS))
    return ErrorDifferenceAnswer(
        difference=float(found.mean()), low=low, high=high, units=len(found), verdict=_verdict(low, high)
    )


def _verdict(low: float | None, high: float | None) -> Literal["better", "worse", "not told apart"]:
    """Comparison of the first error with the second, from the interval of their difference."""
    if high is not None and high < 0:
        return "better"
    return "worse" if low is not None and low > 0 else "not told apart"
