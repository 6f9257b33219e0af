"""The report of a study: its figures and its page in one folder."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from comity.answers.study_report import StudyCompareAnswer, StudyLevelAnswer, StudyReportAnswer
from comity.report.drawing import picture
from comity.study.episode_rows import ERROR, NO_PLAN
from comity.study.report.answering import (
    comparison_answer,
    comparisons_of,
    level_answers,
    level_estimates,
    study_name,
)
from comity.study.report.episodes import StudyVisits
from comity.study.report.factors import factors_of_visits
from comity.study.report.group_differences import groups_figure
from comity.study.report.outcomes import outcomes_of, pictured
from comity.study.report.page import MARK, MOST_LISTED, page_of_study
from comity.study.report.pictures import outcome_figure, sides_figure
from comity.study.report.replaying import EPISODES
from comity.study.report.serving import SHORTFALLS, served_worse, shortfalls, worst_served
from comity.study.report.unusual import failures, outliers
from comity.study.statement import STATEMENT
from comity.system.own_files import (
    ASIDE,
    folder_written_whole,
    make_folder,
    refuse_foreign,
    write_whole,
    writing,
)
from comity_fis import InputError, Where

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from comity.answers.study_report import UnusualVisitAnswer
    from comity.study.report.answering import LevelComparison
    from comity.study.report.factors import StudyFactor
    from comity.study.report.outcomes import StudyOutcome
    from comity.study.results import Study

PAGE, FIGURES = "index.html", "figures"
MOST_INDIVIDUALS = 10

Draw = Callable[[], "Figure"]
Replay = Callable[[Sequence[int]], Mapping[int, str]]
"""Replays rows, and returns the page of each, relative to the report's folder."""


@dataclass(frozen=True, slots=True)
class _Found:
    """Content of the report, before it is written."""

    meanings: Mapping[str, str]
    levels: tuple[StudyLevelAnswer, ...]
    compared: tuple[StudyCompareAnswer, ...]
    drawings: Mapping[str, Draw]
    failed: tuple[UnusualVisitAnswer, ...]
    far: tuple[UnusualVisitAnswer, ...]


def write_report(study: Study, out: Path, asked: Sequence[str], replay: Replay) -> StudyReportAnswer:
    """Write the page of a study with its figures, atomically.

    Args:
        study: The study.
        out: The folder; an older report is replaced.
        asked: Outcomes to draw; the main ones if empty.
        replay: Called with the rows that the page lists.

    Raises:
        InputError: for an unknown outcome, a study without visits, or a folder with other content.
    """
    visits = StudyVisits.of(study)
    every = outcomes_of(visits)
    drawn = pictured(every, asked)
    factors = factors_of_visits(visits)
    _refuse_other(out)
    name = study_name(study)
    with folder_written_whole(out) as new:
        found = _found(visits, factors, every, drawn, name)
        _draw(new / FIGURES, found.drawings)
        listed = [*found.failed[:MOST_LISTED], *found.far[:MOST_LISTED]]
        pages = replay(list(dict.fromkeys(one.row for one in listed if one.what not in (ERROR, NO_PLAN))))
        answer = _answer(visits, factors, found, pages, name=name, page=out / PAGE)
        page = page_of_study(answer, study, {one: new / FIGURES / f"{one}.svg" for one in found.drawings})
        write_whole(new / PAGE, page.encode(), private=True)
    _remove_older(out / FIGURES, found.drawings)
    return answer


def _refuse_other(out: Path) -> None:
    """Refuse a folder that contains something other than a report."""
    with writing(out):
        names = (
            {one.name for one in out.iterdir() if not one.name.startswith(ASIDE)} if out.is_dir() else set()
        )
        if not names <= {EPISODES} and PAGE not in names:
            raise InputError(
                expected="a folder for the report",
                got="a folder with other things in it",
                remedy="Name a new or an empty folder: nothing is overwritten.",
                where=Where(str(out)),
            )
    if out.is_dir():
        refuse_foreign({out / PAGE: MARK})


def _found(
    visits: StudyVisits,
    factors: Sequence[StudyFactor],
    every: Mapping[str, StudyOutcome],
    drawn: Sequence[StudyOutcome],
    name: str,
) -> _Found:
    levels: list[StudyLevelAnswer] = []
    drawings: dict[str, Draw] = {}
    pictures = {one.name for one in drawn}
    for outcome in every.values():
        estimates = level_estimates(visits, outcome, factors)
        levels += level_answers(outcome, estimates)
        if outcome.name in pictures and factors:
            drawings[outcome.name] = partial(outcome_figure, visits, outcome, estimates)
    compared = []
    for i, one in enumerate(comparisons_of(visits, factors), start=1):
        compared.append(comparison_answer(visits, one, drawn, name))
        drawings[f"side_by_side_{i}"] = _sides(visits, one, drawn)
        if any(difference.group for difference in compared[-1].differences):
            drawings[f"by_group_{i}"] = partial(groups_figure, compared[-1])
    return _Found(
        meanings={outcome.name: outcome.means for outcome in every.values()},
        levels=tuple(levels),
        compared=tuple(compared),
        drawings=drawings,
        failed=tuple(failures(visits.study)),
        far=outliers(visits, drawn),
    )


def _sides(visits: StudyVisits, one: LevelComparison, drawn: Sequence[StudyOutcome]) -> Draw:
    return partial(sides_figure, visits, one.pairs, one.names, drawn)


def _draw(folder: Path, drawings: Mapping[str, Draw]) -> None:
    """Write each figure as SVG and PDF."""
    make_folder(folder, private=True)
    for name, draw in drawings.items():
        write_whole(folder / f"{name}.svg", picture(draw, "svg"), private=True)
        write_whole(folder / f"{name}.pdf", picture(draw, "pdf"), private=True)


def _remove_older(folder: Path, drawings: Container[str]) -> None:
    """Remove figures of an older report that are not in the new one."""
    for old in (*folder.glob("*.svg"), *folder.glob("*.pdf")):
        if old.stem not in drawings:
            old.unlink()


def _answer(
    visits: StudyVisits,
    factors: Sequence[StudyFactor],
    found: _Found,
    pages: Mapping[int, str],
    *,
    name: str,
    page: Path,
) -> StudyReportAnswer:
    group = next((one for one in factors if one.name == "group"), None)
    missed = tuple(shortfalls(visits, group)) if group else ()
    columns = {one: len(set(visits.words(one).tolist())) for one in ("seed", "condition", "scenario")}
    return StudyReportAnswer(
        study=name,
        statement=STATEMENT,
        page=str(page),
        figures=tuple(f"{FIGURES}/{one}.{form}" for one in found.drawings for form in ("svg", "pdf")),
        visits=len(visits.rows),
        left_out=visits.left_out,
        individuals=len(set(visits.individuals.tolist()) - {""}),
        rooms=columns["scenario"],
        seeds=columns["seed"],
        conditions=columns["condition"],
        meanings=dict(found.meanings) | {one: means for one, (_, means, _) in SHORTFALLS.items()},
        levels=found.levels,
        comparisons=found.compared,
        shortfalls=missed,
        served_worse=tuple(served_worse(missed)),
        individuals_served_worst=worst_served(visits, MOST_INDIVIDUALS),
        failures=len(found.failed),
        first_failures=_with_pages(found.failed, pages),
        outliers=len(found.far),
        farthest_outliers=_with_pages(found.far, pages),
    )


def _with_pages(
    found: Iterable[UnusualVisitAnswer], pages: Mapping[int, str]
) -> tuple[UnusualVisitAnswer, ...]:
    """The visits, each with the page of its episode (by row) if it was replayed."""
    return tuple(replace(one, page=pages.get(one.row)) for one in found)
