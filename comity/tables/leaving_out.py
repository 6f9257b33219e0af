"""Judging by leaving out: who predicts best what was not seen, and whether that is more than chance."""

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
"""Beyond so many participants or studies several are left out at a time."""
RESAMPLES, LEAST_UNITS, SEED = 2000, 10, 0
"""Of the bootstrap; an interval of fewer units would promise too much (our choice)."""
ENDS = (2.5, 97.5)
"""Of the interval, in percent."""


@dataclass(frozen=True, slots=True)
class Judgement:
    """All contenders on the same rows, each of them left out once."""

    left_out: LeftOut
    units: int
    errors: Mapping[str, ErrorAnswer]
    """Of those that say something; of all rows that they do."""
    differences: Mapping[str, Mapping[str, ErrorDifferenceAnswer]]
    """By proposal, then by the contender that it is compared with."""


def judged(
    rows: Sequence[ExampleRow],
    learners: Mapping[str, Learner],
    left_out: LeftOut,
    *,
    proposals: Collection[str],
    file: str,
) -> Judgement:
    """Leave out one after the other, learn from the rest, and predict what was left out.

    Args:
        rows: At least one.
        learners: By name.
        left_out: What counts as one.
        proposals: Names of those that are compared with all others.
        file: Of the rows, for messages.

    Raises:
        InputError: if there is only one to leave out.
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
    """By contender, the absolute error of each row; NaN where it says nothing."""
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
    """What the person of each row had said when first asked; None of the first row itself."""
    first: dict[object, float] = {}
    for row in rows:
        yield first.get(row.person)
        first.setdefault(row.person, row.value)


def _per_unit(values: Floats, of_row: Floats, units: int) -> Floats:
    """The mean of each unit's rows, as far as they are numbers; NaN where none is."""
    there = ~np.isnan(values)
    counts = np.bincount(of_row[there], minlength=units)
    sums = np.bincount(of_row[there], weights=values[there], minlength=units)
    means: Floats = np.divide(sums, counts, out=np.full(units, np.nan), where=counts > 0)
    return means


def _difference(differences: Floats, of_row: Floats, units: int) -> ErrorDifferenceAnswer | None:
    """The mean over units with its interval; None where no row has both."""
    per_unit = _per_unit(differences, of_row, units)
    found = per_unit[~np.isnan(per_unit)]
    if not len(found):
        return None
    low = high = None
    if len(found) >= LEAST_UNITS:  # the paired bootstrap over units (Efron 1979)
        random = np.random.default_rng(SEED)
        means = [found[random.integers(0, len(found), len(found))].mean() for _ in range(RESAMPLES)]
        low, high = map(float, np.percentile(means, ENDS))
    return ErrorDifferenceAnswer(
        difference=float(found.mean()), low=low, high=high, units=len(found), verdict=_verdict(low, high)
    )


def _verdict(low: float | None, high: float | None) -> Literal["better", "worse", "not told apart"]:
    """What can be said beyond chance of the first of two errors, by the interval of their difference."""
    if high is not None and high < 0:
        return "better"
    return "worse" if low is not None and low > 0 else "not told apart"
