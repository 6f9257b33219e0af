"""Judging by leaving out: who predicts best what was not seen, and whether that is more than chance."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

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
class Error:
    """How far one contender is off."""

    mean: float
    """Mean absolute error: of each unit's rows, then of the units. In the parameter's unit."""
    units: int
    """Participants, studies or rows of which it says anything."""


@dataclass(frozen=True, slots=True)
class Difference:
    """One contender's error less another's, where both say something."""

    mean: float
    """Below 0 where the first is nearer to what people said."""
    low: float | None
    """Of the 95 % interval by the paired bootstrap over units (Efron 1979); None for too few units."""
    high: float | None
    units: int

    @property
    def verdict(self) -> Literal["better", "worse", "not told apart"]:
        """What can be said of the first, beyond chance."""
        if self.high is not None and self.high < 0:
            return "better"
        return "worse" if self.low is not None and self.low > 0 else "not told apart"


@dataclass(frozen=True, slots=True)
class Judgement:
    """All contenders on the same rows, each of them left out once."""

    left_out: LeftOut
    units: int
    errors: Mapping[str, Error]
    """Of those that say something; of all rows that they do."""
    differences: Mapping[str, Mapping[str, Difference]]
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
            name: Error(float(np.nanmean(values)), int((~np.isnan(values)).sum()))
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


def _difference(differences: Floats, of_row: Floats, units: int) -> Difference | None:
    """The mean over units with its interval; None where no row has both."""
    per_unit = _per_unit(differences, of_row, units)
    found = per_unit[~np.isnan(per_unit)]
    if not len(found):
        return None
    if len(found) < LEAST_UNITS:
        return Difference(float(found.mean()), None, None, len(found))
    random = np.random.default_rng(SEED)
    means = [found[random.integers(0, len(found), len(found))].mean() for _ in range(RESAMPLES)]
    low, high = np.percentile(means, ENDS)
    return Difference(float(found.mean()), float(low), float(high), len(found))
