"""Results of a simulation study, as lines of a report."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from comity.study.report.answering import comparison_answer, comparisons_of, study_name
from comity.study.report.factors import factors_of_visits
from comity.study.report.outcomes import label_of, outcomes_of, pictured
from comity.study.report.telling import few_of, few_text, interval_text, number_text, value_text

if TYPE_CHECKING:
    from comity.answers.study_report import StudyDifferenceAnswer
    from comity.study.report.episodes import StudyVisits


def outcomes_told(visits: StudyVisits) -> str:
    """The main outcomes in which visits differ, a line each, with unit and definition."""
    shown = pictured(outcomes_of(visits), ())
    return "\n".join(["the main ones:", "", *(f"- {one.label}: {one.means}" for one in shown)])


def results_told(visits: StudyVisits) -> str:
    """The paired differences between levels of factors, over all individuals, a line each."""
    found = [*_differences(visits)]
    if not found:
        return "no factor has levels that the same individuals met: `comity study report` has the means"
    told = "second minus first, within the same individual, room and seed, with the 95 % interval and the"
    few = few_of(one.difference for _, one in found)
    lines = [f"- {line}" for line in (*(_line(levels, one) for levels, one in found), *_few(few))]
    return "\n".join([f"{told} Monte Carlo error of the seeds:", "", *lines])


def _few(few: Mapping[str, int]) -> Iterator[str]:
    if few:
        yield few_text(few)


def _differences(visits: StudyVisits) -> Iterator[tuple[str, StudyDifferenceAnswer]]:
    """The factor with its two levels, and how an outcome differs between them."""
    outcomes = pictured(outcomes_of(visits), ())
    for one in comparisons_of(visits, factors_of_visits(visits)):
        answer = comparison_answer(visits, one, outcomes, study_name(visits.study))
        for each in answer.differences:
            if each.group is None:
                yield f"{answer.factor} {answer.first} and {answer.second}", each


def _line(levels: str, one: StudyDifferenceAnswer) -> str:
    values = f"{number_text(one.first)} and {value_text(one.second, one.unit)}"
    by = f"{number_text(one.difference.mean, signed=True)} [{interval_text(one.difference)}]"
    error = f"error {number_text(one.difference.monte_carlo_error)}, {one.difference.episodes} pairs"
    return f"{label_of(one.outcome, one.unit)}, {levels}: {values}, difference {by}, {error}"
