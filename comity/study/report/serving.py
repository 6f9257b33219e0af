"""Groups and individuals that are served worse under a study's assumptions, by parameter."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from itertools import groupby
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from comity.answers.study_report import (
    EstimateAnswer,
    IndividualServedAnswer,
    ServedWorseAnswer,
    ShortfallAnswer,
)
from comity.study.episode_rows import comfort_gap_m
from comity.study.report.outcomes import excess_m, served
from comity.study.report.resampling import averaged

if TYPE_CHECKING:
    from comity.study.report.episodes import StudyVisits
    from comity.study.report.factors import StudyFactor
    from comity.study.report.resampling import Floats

RULEBOOK = "rulebook_used"
SAME = 1e-6
"""Means that differ by less than this, in any unit, count as equal."""


def _target_excess_m(visits: StudyVisits) -> Floats:
    """Distance of the rulebook's target distance from the comfort interval [m]."""
    columns = (visits.numbers(name) for name in ("distance_target_m", "comfort_near_m", "comfort_far_m"))
    return np.array([abs(comfort_gap_m(*row)) for row in zip(*columns, strict=True)])


def _execution_excess_m(visits: StudyVisits) -> Floats:
    return excess_m(visits) - _target_excess_m(visits)


def _speed_excess_m_s(visits: StudyVisits) -> Floats:
    gap = visits.numbers("approach_speed_actual_m_s") - visits.numbers("approach_speed_target_m_s")
    return np.maximum(gap, 0)


def _bearing_error_deg(visits: StudyVisits) -> Floats:
    gap = visits.numbers("bearing_actual_deg") - visits.numbers("bearing_target_deg")
    return np.abs((gap + 180) % 360 - 180)


def _late_s(visits: StudyVisits) -> Floats:
    return np.maximum(visits.numbers("late_s"), 0)


def _not_served(visits: StudyVisits) -> Floats:
    return 1 - served(visits)


SHORTFALLS: Mapping[str, tuple[str, str, Callable[[StudyVisits], Floats]]] = MappingProxyType(
    {
        "not_served": ("1", "Share of the visits without a greeting.", _not_served),
        "conversational_distance": (
            "m",
            "How far outside the comfort interval the distance lies that was aimed at.",
            _target_excess_m,
        ),
        "distance_in_execution": (
            "m",
            "What reaching and holding that distance adds to it; negative where it helps.",
            _execution_excess_m,
        ),
        "approach_direction": ("deg", "Between the bearings aimed at and reached.", _bearing_error_deg),
        "approach_speed": ("m/s", "Faster than aimed at, within 1.5 m.", _speed_excess_m_s),
        "by_s": ("s", "Later than the goal's time.", _late_s),
    }
)
"""Shortfalls by parameter, with unit and meaning: 0 is best."""


def shortfalls(visits: StudyVisits, group: StudyFactor) -> Iterator[ShortfallAnswer]:
    """Every shortfall, parameter by parameter and rulebook by rulebook, the worst served group first."""
    books = visits.words(RULEBOOK)
    for parameter, (unit, _, derive) in SHORTFALLS.items():
        values = derive(visits)
        for book in dict.fromkeys(books.tolist()):
            found = []
            for i, name in enumerate(group.levels):
                one = visits.estimated(values, (group.level_of == i) & (books == book))
                if one is not None:
                    answer = ShortfallAnswer(
                        parameter=parameter, unit=unit, rulebook=book, group=name, missed=one
                    )
                    found.append(answer)
            yield from sorted(found, key=lambda one: -one.missed.mean)


def served_worse(found: Iterable[ShortfallAnswer]) -> Iterator[ServedWorseAnswer]:
    """By parameter and rulebook, the worst served group; nothing if all groups are served equally.

    Args:
        found: Shortfalls, as returned by `shortfalls`.
    """
    for (parameter, rulebook), some in groupby(found, key=lambda one: (one.parameter, one.rulebook)):
        ranked = list(some)
        worst, best = ranked[0], ranked[-1]
        if worst.missed.mean - best.missed.mean > SAME:
            yield ServedWorseAnswer(
                parameter=parameter,
                unit=worst.unit,
                rulebook=rulebook,
                worst=worst.group,
                worst_missed=worst.missed.mean,
                best=best.group,
                best_missed=best.missed.mean,
                told_apart=_are_apart(worst.missed, best.missed),
            )


def _are_apart(worst: EstimateAnswer, best: EstimateAnswer) -> bool:
    """Whether two intervals are disjoint, by more than twice the Monte Carlo error."""
    if worst.low is None or best.high is None or worst.low <= best.high:
        return False
    seeds = math.hypot(worst.monte_carlo_error or 0, best.monte_carlo_error or 0)
    return worst.mean - best.mean > 2 * seeds


def worst_served(visits: StudyVisits, most: int) -> tuple[IndividualServedAnswer, ...]:
    """Individuals met farthest outside their comfort interval on average; none of those met inside it.

    Args:
        visits: The study's.
        most: Maximum number of individuals.
    """
    values, books, groups = excess_m(visits), visits.words(RULEBOOK), visits.words("group")
    found = []
    for book in dict.fromkeys(books.tolist()):
        chosen = (books == book) & ~np.isnan(values)
        means = np.nanmean(averaged(values[chosen], visits.individuals[chosen], visits.rooms[chosen]), axis=1)
        of = dict(zip(visits.individuals[chosen].tolist(), groups[chosen].tolist(), strict=True))
        found += [
            IndividualServedAnswer(
                individual=name, group=of[name], rulebook=book, outside_comfort_m=float(mean)
            )
            for name, mean in zip(sorted(of), means, strict=True)
        ]
    worst = sorted(found, key=lambda one: (-one.outside_comfort_m, one.individual, one.rulebook))
    return tuple(one for one in worst[:most] if one.outside_comfort_m > SAME)
