"""Failures and outliers of a study, each by its row, so that its episode can be replayed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from comity.answers.study_report import UnusualVisitAnswer
from comity.study.report.resampling import numbered

if TYPE_CHECKING:
    from comity.study.report.episodes import StudyVisits
    from comity.study.report.outcomes import StudyOutcome
    from comity.study.report.resampling import Floats, Whole
    from comity.study.results import Study

FENCE = 3.0
"""Distance of the fence from the quartiles in interquartile ranges: Tukey's outer fence ("Exploratory Data
Analysis", 1977)."""
LEAST = 0.5
"""Minimum width of the interquartile range, as a share of the overall standard deviation: if most visits are
equal, a smaller width is meaningless."""
FEWEST = 8
"""Minimum number of visits in one room under one condition for meaningful quartiles."""
NO_FAILURES = ("greeted", "declined")
"""Outcomes that are no failures: if a person declines, the robot ends the visit as asked."""


def failures(study: Study) -> Iterator[UnusualVisitAnswer]:
    """All failed visits, in the order of the table, including those of people who are no individuals."""
    for row in study.rows:
        if row["outcome"] not in NO_FAILURES:
            yield _unusual(row, row["outcome"], row.get("error") or row.get("reason") or "no reason given")


def outliers(visits: StudyVisits, outcomes: Sequence[StudyOutcome]) -> tuple[UnusualVisitAnswer, ...]:
    """Visits that differ from other seeds of the same individual, the farthest beyond the fence first.

    People differ from each other, which the figures show. So the fence is set around differences from the
    median of the same individual in the same room under the same condition, or around the values themselves
    if no visit was repeated with another seed. A visit with several such values is listed once, by the
    farthest one, and so are visits to one person with the same trace.
    """
    places, _ = numbered(np.char.add(np.char.add(visits.rooms, "\0"), visits.conditions))
    individuals, people = numbered(visits.individuals)
    repeats, _ = numbered(places * people + individuals)
    farthest: dict[int, tuple[float, StudyOutcome, float]] = {}
    for outcome in outcomes:
        if outcome.unit in ("1", ""):
            continue  # shares and counts have no fence
        usual = _usual(outcome.values, repeats)
        least = LEAST * float(np.nanstd(outcome.values))
        for place in np.unique(places):
            rows = np.flatnonzero((places == place) & ~np.isnan(outcome.values))
            for row, beyond, fence in _beyond(rows, outcome.values - usual, least):
                if beyond > farthest.get(row, (0.0,))[0]:
                    farthest[row] = (beyond, outcome, fence + float(usual[row]))
    ranked = sorted(farthest.items(), key=lambda one: (-one[1][0], one[0]))
    traces = _traces(visits)
    alike, first = Counter(traces), {traces[row]: row for row, _ in reversed(ranked)}
    return tuple(
        _outlier(visits.rows[row], row, outcome, fence, alike[traces[row]])
        for row, (_, outcome, fence) in ranked
        if first[traces[row]] == row
    )


def _traces(visits: StudyVisits) -> list[tuple[str, ...]]:
    """By visit, a key that equal traces share; a row without a digest is unique."""
    return [
        (row["trace_sha256"], row["person"]) if row.get("trace_sha256") else (row["row"],)
        for row in visits.rows
    ]


def _usual(values: Floats, repeats: Whole) -> Floats:
    """Median of each visit's repetitions; 0 without repetitions, so that values stay unchanged."""
    usual = np.zeros(len(values))
    there = np.flatnonzero(~np.isnan(values))
    rows = there[np.argsort(repeats[there], kind="stable")]
    groups = np.split(rows, np.flatnonzero(np.diff(repeats[rows])) + 1)
    if max(map(len, groups)) > 1:
        for group in groups:
            usual[group] = np.median(values[group])
    return usual


def _beyond(rows: Whole, values: Floats, least: float) -> Iterator[tuple[int, float, float]]:
    """Rows beyond a fence, their distance from it in widths, and the fence."""
    if len(rows) < FEWEST:
        return
    low, high = np.quantile(values[rows], [0.25, 0.75])
    if (width := max(high - low, least)) == 0:
        return
    for row in rows:
        value = values[row]
        fence = low - FENCE * width if value < low else high + FENCE * width
        beyond = abs(value - fence) / width
        if value < min(low, fence) or value > max(high, fence):
            yield int(row), float(beyond), float(fence)


def _outlier(
    cells: Mapping[str, str], row: int, outcome: StudyOutcome, fence: float, alike: int
) -> UnusualVisitAnswer:
    value = outcome.values[row]
    side = "below" if value < fence else "above"
    return replace(_unusual(cells, outcome.label, f"{value:.3g}, {side} {fence:.3g}"), alike=alike)


def _unusual(row: Mapping[str, str], what: str, why: str) -> UnusualVisitAnswer:
    return UnusualVisitAnswer(
        row=int(row["row"]),
        scenario=row["scenario"],
        condition=row["condition"],
        individual=row["individual"] or row["person"],
        seed=row["seed"],
        what=what,
        why=why,
        alike=1,
        page=None,
    )
