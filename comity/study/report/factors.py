"""What visits of a study differ by: factors with their levels, groups and rooms."""

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
"""A factor of numbers with more of them, as a Latin hypercube has, is shown in fourths."""


@dataclass(frozen=True, slots=True)
class StudyFactor:
    """Something that sorts visits into levels."""

    name: str
    """Its column; of factors that always change together all of them: `rulebook + seeds`."""
    columns: tuple[str, ...]
    levels: tuple[str, ...]
    level_of: Whole
    """By visit, the number of its level; -1 where it has none."""
    is_paired: bool
    """Whether the same individual meets every level, so that differences are taken within one."""


def factors_of_visits(visits: StudyVisits) -> tuple[StudyFactor, ...]:
    """The study's factors with more than one level, then groups and rooms; one level of all where none is."""
    found = [_factor(visits, group, is_paired=True) for group in _in_step(visits)]
    found += [_factor(visits, (column,), is_paired=False) for column in ("group", "scenario")]
    some = tuple(one for one in found if len(one.levels) > 1)
    return some or (StudyFactor("all visits", (), ("all",), np.zeros(len(visits.rows), np.intp), False),)


def _in_step(visits: StudyVisits) -> Iterator[tuple[str, ...]]:
    """The factors' columns; those that sort the visits in the same way stand together."""
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
    """By visit, the number of its value, counted as values come up: the same for the same partition."""
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
    """Many numbers as four ranges with as many visits each; None for few of them, or for words."""
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
