"""Factors by which the visits of a study differ, with their levels, and groups and rooms."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from comity.study.columns import FILE

if TYPE_CHECKING:
    from comity.study.report.episodes import StudyVisits
    from comity.study.report.resampling import Whole

MOST_LEVELS = 8
"""Maximum number of levels; a numeric factor with more, as in a Latin hypercube, is shown in quartiles."""


@dataclass(frozen=True, slots=True)
class StudyFactor:
    """A partition of the visits into levels."""

    name: str
    """Name of its column, or of all columns that always change together: `rulebook + seeds`."""
    columns: tuple[str, ...]
    levels: tuple[str, ...]
    level_of: Whole
    """Index of each visit's level; -1 without one."""
    is_paired: bool
    """Whether the same individual meets every level, so that differences are within individuals."""


def factors_of_visits(visits: StudyVisits) -> tuple[StudyFactor, ...]:
    """The study's factors with several levels, then groups and rooms; a single level if there are none."""
    found = [_factor(visits, group, is_paired=True) for group in _in_step(visits)]
    found += [_factor(visits, (column,), is_paired=False) for column in ("group", "scenario")]
    some = tuple(one for one in found if len(one.levels) > 1)
    return some or (StudyFactor("all visits", (), ("all",), np.zeros(len(visits.rows), np.intp), False),)


def _in_step(visits: StudyVisits) -> Iterator[tuple[str, ...]]:
    """Columns of the factors; those with the same partition of the visits are grouped."""
    told = visits.study.columns
    columns = [
        name
        for name, one in told.items()
        if one["source"] == FILE and one["definition"].startswith("Factor: ")
    ]
    alike: dict[bytes, list[str]] = {}
    for column in columns:
        alike.setdefault(_sorted_into(visits.words(column)).tobytes(), []).append(column)
    yield from map(tuple, alike.values())


def _sorted_into(words: NDArray[Any]) -> Whole:
    """Index of each visit's value in order of appearance: equal for equal partitions."""
    numbers: dict[str, int] = {}
    return np.array([numbers.setdefault(str(word), len(numbers)) for word in words], dtype=np.intp)


def _factor(visits: StudyVisits, columns: Sequence[str], *, is_paired: bool) -> StudyFactor:
    parts = [visits.words(column) for column in columns]
    if len(columns) == 1 and (fourths := _fourths(parts[0])) is not None:
        return StudyFactor(columns[0], tuple(columns), *fourths, is_paired=False)
    words = [", ".join(filter(None, row)) for row in zip(*parts, strict=True)]
    levels = tuple(dict.fromkeys(word for word in words if word))
    numbers = {level: i for i, level in enumerate(levels)}
    level_of = np.array([numbers.get(word, -1) for word in words], dtype=np.intp)
    return StudyFactor(" + ".join(columns), tuple(columns), levels, level_of, is_paired)


def _fourths(words: NDArray[Any]) -> tuple[tuple[str, ...], Whole] | None:
    """Names and indices of quartiles for a column with many numbers; None for few numbers, or for text."""
    if len(set(words.tolist()) - {""}) <= MOST_LEVELS:
        return None
    try:
        values = np.array([float(word) if word else np.nan for word in words])
    except ValueError:
        return None
    ends = np.nanquantile(values, [0, 0.25, 0.5, 0.75, 1])
    level_of = np.clip(np.searchsorted(ends, values, side="right") - 1, 0, 3)
    levels = tuple(f"{low:.3g} to {high:.3g}" for low, high in pairwise(ends))
    return levels, np.where(np.isnan(values), -1, level_of).astype(np.intp)
