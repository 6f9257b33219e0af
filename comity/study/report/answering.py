"""What a study shows, as an answer: levels, differences, who is served worse, failures and outliers."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING

from comity.answers.study_report import (
    EstimateAnswer,
    IndividualServedAnswer,
    ServedWorseAnswer,
    ShortfallAnswer,
    StudyCompareAnswer,
    StudyDifferenceAnswer,
    StudyLevelAnswer,
    UnusualVisitAnswer,
)
from comity.study.columns import column_of
from comity.study.folder import ACCOUNT
from comity.study.report.pairs import VisitPairs, paired_difference, pairs_of
from comity.study.report.serving import (
    SHORTFALLS,
    IndividualServed,
    ServedWorse,
    Shortfall,
)
from comity.study.results import Study
from comity.study.statement import STATEMENT
from comity.system.own_files import read_regular
from comity_fis import InputError, Where, closest, unknown_word

if TYPE_CHECKING:
    from comity.study.report.episodes import StudyVisits
    from comity.study.report.factors import StudyFactor
    from comity.study.report.outcomes import StudyOutcome
    from comity.study.report.resampling import ClusterEstimate
    from comity.study.report.unusual import UnusualVisit


def study_name(study: Study) -> str:
    """What the study is called; its folder's name where its account is damaged."""
    try:
        return str(json.loads(read_regular(study.path / ACCOUNT))["study"])
    except (OSError, ValueError, TypeError, KeyError):
        return study.path.resolve().name


@dataclass(frozen=True, slots=True)
class LevelComparison:
    """Two levels of a factor, and the visits that they share."""

    factor: StudyFactor
    first: int
    second: int
    pairs: VisitPairs

    @property
    def names(self) -> tuple[str, str]:
        """Of the levels."""
        return self.factor.levels[self.first], self.factor.levels[self.second]


def comparisons_of(visits: StudyVisits, factors: Sequence[StudyFactor]) -> Iterator[LevelComparison]:
    """Each further level of a factor against its first, where the same individuals meet both."""
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
        visits: The study's.
        factors: Those of the study.
        factor: As a column or as a path of the study's file.
        first: The level that is taken away.
        second: The other one.

    Raises:
        InputError: for a factor or a level that the study has not, or levels that share no visits.
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
    """How outcomes differ between two levels: for all, then group by group."""
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
            if (one := _difference(visits, compared, outcome, name)) is not None
        ),
    )


def _difference(
    visits: StudyVisits, compared: LevelComparison, outcome: StudyOutcome, group: str | None
) -> StudyDifferenceAnswer | None:
    pairs = compared.pairs
    if group is not None:
        chosen = visits.words("group")[pairs.first] == group
        pairs = VisitPairs(pairs.first[chosen], pairs.second[chosen])
    found = paired_difference(visits, compared.factor, pairs, outcome)
    if found is None:
        return None
    return StudyDifferenceAnswer(
        outcome=outcome.name,
        unit=outcome.unit,
        group=group,
        first=found.first,
        second=found.second,
        difference=estimate_answer(found.difference),
    )


def estimate_answer(found: ClusterEstimate) -> EstimateAnswer:
    """The same as an answer."""
    return EstimateAnswer(**asdict(found))


def level_answers(
    outcome: StudyOutcome, estimates: Sequence[tuple[StudyFactor, Sequence[ClusterEstimate | None]]]
) -> Iterator[StudyLevelAnswer]:
    """An outcome at every level of every factor."""
    for factor, some in estimates:
        for level, one in zip(factor.levels, some, strict=True):
            yield StudyLevelAnswer(
                outcome=outcome.name,
                unit=outcome.unit,
                factor=factor.name,
                level=level,
                estimate=None if one is None else estimate_answer(one),
            )


def level_estimates(
    visits: StudyVisits, outcome: StudyOutcome, factors: Sequence[StudyFactor]
) -> list[tuple[StudyFactor, list[ClusterEstimate | None]]]:
    """By factor, the estimate of an outcome at each level."""
    return [
        (one, [visits.estimated(outcome.values, one.level_of == i) for i in range(len(one.levels))])
        for one in factors
    ]


def shortfall_answer(one: Shortfall) -> ShortfallAnswer:
    """The same as an answer."""
    return ShortfallAnswer(
        parameter=one.parameter,
        unit=SHORTFALLS[one.parameter][0],
        rulebook=one.rulebook,
        group=one.group,
        missed=estimate_answer(one.missed),
    )


def served_worse_answer(one: ServedWorse) -> ServedWorseAnswer:
    """The same as an answer."""
    return ServedWorseAnswer(
        parameter=one.worst.parameter,
        unit=SHORTFALLS[one.worst.parameter][0],
        rulebook=one.worst.rulebook,
        worst=one.worst.group,
        worst_missed=one.worst.missed.mean,
        best=one.best.group,
        best_missed=one.best.missed.mean,
        told_apart=one.is_told_apart,
    )


def individual_answer(one: IndividualServed) -> IndividualServedAnswer:
    """The same as an answer."""
    return IndividualServedAnswer(
        individual=one.individual, group=one.group, rulebook=one.rulebook, outside_comfort_m=one.excess_m
    )


def unusual_answers(
    found: Sequence[UnusualVisit], pages: Mapping[int, str]
) -> tuple[UnusualVisitAnswer, ...]:
    """The same as answers, each with its page.

    Args:
        found: All of them.
        pages: By row, the page of an episode that was played again.
    """
    return tuple(UnusualVisitAnswer(**asdict(one), page=pages.get(one.row)) for one in found)
