"""Results of a study as JSON output: levels, differences, who is served worse, failures and outliers."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity.answers.study_report import (
    EstimateAnswer,
    StudyCompareAnswer,
    StudyLevelAnswer,
)
from comity.study.columns import column_of
from comity.study.folder import ACCOUNT
from comity.study.report.pairs import VisitPairs, paired_difference, pairs_of
from comity.study.results import Study
from comity.study.statement import STATEMENT
from comity.system.own_files import read_regular
from comity_fis import InputError, Where, closest, unknown_word

if TYPE_CHECKING:
    from comity.study.report.episodes import StudyVisits
    from comity.study.report.factors import StudyFactor
    from comity.study.report.outcomes import StudyOutcome


def study_name(study: Study) -> str:
    """Name of the study; its folder's name if its account is damaged."""
    try:
        return str(json.loads(read_regular(study.path / ACCOUNT))["study"])
    except (OSError, ValueError, TypeError, KeyError):
        return study.path.resolve().name


@dataclass(frozen=True, slots=True)
class LevelComparison:
    """Two levels of a factor, and the visits that they share, as pairs."""

    factor: StudyFactor
    first: int
    second: int
    pairs: VisitPairs

    @property
    def names(self) -> tuple[str, str]:
        """Names of the levels."""
        return self.factor.levels[self.first], self.factor.levels[self.second]


def comparisons_of(visits: StudyVisits, factors: Sequence[StudyFactor]) -> Iterator[LevelComparison]:
    """Each other level of a factor compared with its first, if the same individuals meet both."""
    for factor in factors:
        for second in range(1, len(factor.levels)) if factor.is_paired else ():
            pairs = pairs_of(visits, factor, 0, second)
            if len(pairs.first):
                yield LevelComparison(factor, 0, second, pairs)


def comparison_named(
    visits: StudyVisits, factors: Sequence[StudyFactor], factor: str, first: str, second: str
) -> LevelComparison:
    """Two levels of a factor by their names.

    Args:
        visits: The study's visits.
        factors: The study's factors.
        factor: The factor, by its column or its path in the study's file.
        first: The level to subtract.
        second: The level to subtract from.

    Raises:
        InputError: for an unknown factor or level, or levels that share no visits.
    """
    paired = {one.name: one for one in factors if one.is_paired}
    names = (factor, column_of(factor))
    found = next((one for one in paired.values() if {*names} & {one.name, *one.columns}), None)
    if found is None:
        raise InputError(
            expected="a factor of the study that every individual meets at each level",
            got=repr(factor),
            remedy=closest(factor, paired) if paired else "This study has none: nothing can be compared.",
            where=Where("--factor"),
        )
    for level in (first, second):
        if level not in found.levels:
            raise unknown_word(f"a level of {found.name}", level, found.levels, where=Where("--factor"))
    numbers = found.levels.index(first), found.levels.index(second)
    pairs = pairs_of(visits, found, *numbers)
    if first == second or not len(pairs.first):
        raise InputError(
            expected="two levels that the same individual, room and seed meet, with other factors equal",
            got=f"{first} and {second}",
            remedy="Name two other levels, or cross the factors in the study (`design: full`).",
            where=Where("--factor"),
        )
    return LevelComparison(found, *numbers, pairs)


def comparison_answer(
    visits: StudyVisits, compared: LevelComparison, outcomes: Sequence[StudyOutcome], study: str
) -> StudyCompareAnswer:
    """Differences of outcomes between two levels: overall, then by group."""
    groups = visits.words("group")[compared.pairs.first]
    names = [name for name in dict.fromkeys(groups.tolist()) if name]
    return StudyCompareAnswer(
        study=study,
        statement=STATEMENT,
        factor=compared.factor.name,
        first=compared.names[0],
        second=compared.names[1],
        pairs=len(compared.pairs.first),
        differences=tuple(
            one
            for outcome in outcomes
            for name in (None, *(names if len(names) > 1 else ()))
            if (one := paired_difference(visits, compared.factor, compared.pairs, outcome, name))
        ),
    )


def level_answers(
    outcome: StudyOutcome, estimates: Sequence[tuple[StudyFactor, Sequence[EstimateAnswer | None]]]
) -> Iterator[StudyLevelAnswer]:
    """An outcome at every level of every factor."""
    for factor, some in estimates:
        for level, one in zip(factor.levels, some, strict=True):
            yield StudyLevelAnswer(
                outcome=outcome.name,
                unit=outcome.unit,
                factor=factor.name,
                level=level,
                estimate=one,
            )


def level_estimates(
    visits: StudyVisits, outcome: StudyOutcome, factors: Sequence[StudyFactor]
) -> list[tuple[StudyFactor, list[EstimateAnswer | None]]]:
    """By factor, the estimates of an outcome at each level."""
    return [
        (one, [visits.estimated(outcome.values, one.level_of == i) for i in range(len(one.levels))])
        for one in factors
    ]
