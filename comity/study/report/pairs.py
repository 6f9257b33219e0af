"""Paired differences between two levels of a factor, for the same individual, room, seed and setting."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from comity.answers.study_report import StudyDifferenceAnswer
from comity.study.report.resampling import averaged, estimate

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from comity.study.report.episodes import StudyVisits
    from comity.study.report.factors import StudyFactor
    from comity.study.report.outcomes import StudyOutcome
    from comity.study.report.resampling import Whole


@dataclass(frozen=True, slots=True)
class VisitPairs:
    """Pairs of visits that differ only in the level of one factor."""

    first: Whole
    """Row indices of the visits at the first level."""
    second: Whole
    """Row indices of their partners at the second level, in the same order."""


def pairs_of(visits: StudyVisits, factor: StudyFactor, first: int, second: int) -> VisitPairs:
    """The visits that two levels share: same individual, person, room, seed, and values of other factors."""
    sides: list[dict[tuple[str, ...], int]] = []
    keys = _keys(visits, factor)
    for level in (first, second):
        rows = np.flatnonzero(factor.level_of == level)
        sides.append({tuple(keys[row]): int(row) for row in rows})
    shared = [key for key in sides[0] if key in sides[1]]
    return VisitPairs(*(np.array([side[key] for key in shared], dtype=np.intp) for side in sides))


def _keys(visits: StudyVisits, factor: StudyFactor) -> NDArray[Any]:
    """By visit, a key that is the same within a pair."""
    return np.stack([visits.words(column) for column in (*_same(visits, factor), "seed")], axis=1)


def _same(visits: StudyVisits, factor: StudyFactor) -> Iterator[str]:
    yield from ("individual", "scenario", "person")
    for name, one in visits.study.columns.items():
        if one["definition"].startswith("Factor: ") and name not in factor.columns:
            yield name


def paired_difference(
    visits: StudyVisits, factor: StudyFactor, pairs: VisitPairs, outcome: StudyOutcome, group: str | None
) -> StudyDifferenceAnswer | None:
    """The paired difference of an outcome, for a group or for all; None if no pair has both values."""
    if group is not None:
        chosen = visits.words("group")[pairs.first] == group
        pairs = VisitPairs(pairs.first[chosen], pairs.second[chosen])
    before, after = outcome.values[pairs.first], outcome.values[pairs.second]
    individuals, rooms = visits.individuals[pairs.first], visits.rooms[pairs.first]
    others = [visits.words(column)[pairs.first] for column in _same(visits, factor)]
    settings = np.array(["\0".join(one) for one in zip(*others, strict=True)], dtype=str)
    found = estimate(after - before, individuals, rooms, settings, visits.seeds[pairs.first])
    if found is None:
        return None
    gap = np.where(np.isnan(before + after), np.nan, 0.0)
    first, second = (float(np.nanmean(averaged(side + gap, individuals, rooms))) for side in (before, after))
    return StudyDifferenceAnswer(
        outcome=outcome.name, unit=outcome.unit, group=group, first=first, second=second, difference=found
    )
