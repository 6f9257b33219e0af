"""`comity study report`, `compare` and `show`: what a study that was run shows."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from comity.commands.options import AsJson, open_page, print_json

if TYPE_CHECKING:
    from comity.study import Study

StudyFolder = Annotated[Path, typer.Argument(metavar="DIR", help="What `comity study run` wrote.")]
StudySource = Annotated[
    Path | None,
    typer.Option("--study", metavar="FILE", help="The study's file, where it is not where it was run from."),
]
ReportOut = Annotated[
    Path | None, typer.Option("--out", metavar="FOLDER", help="Of the report; `report` in DIR without it.")
]
Outcomes = Annotated[
    list[str],
    typer.Option("--outcome", metavar="COLUMN", help="To draw and compare; the main ones without it."),
]
OpenPage = Annotated[bool, typer.Option("--open", help="Open the page in the browser.")]


def report(
    directory: StudyFolder,
    *,
    out: ReportOut = None,
    outcome: Outcomes = [],  # noqa: B006  (Typer copies it)
    play: Annotated[
        int, typer.Option("--play", metavar="N", min=0, help="Failures and outliers to play again and link.")
    ] = 0,
    study: StudySource = None,
    open_: OpenPage = False,
    as_json: AsJson = False,
) -> None:
    """Write one page about a study, with its figures as SVG and PDF; it needs no network.

    Each outcome by factor, differences, who is served worse, failures and outliers.

    Example: comity study report runs/groups --play 5
    """
    from comity.report.text import show as say
    from comity.study.report.replaying import file_of, played_first
    from comity.study.report.reporting import write_report
    from comity.study.report.telling import report_text

    found = loaded_study(directory)
    folder = out or directory / REPORT
    answer = write_report(
        found,
        folder,
        outcome,
        lambda rows: played_first(found, study or file_of(found), rows, play, folder),
    )
    if as_json:
        print_json(answer)
    else:
        say(*report_text(answer))
    if open_:
        open_page(Path(answer.page))


REPORT = "report"
"""Folder inside the study's."""


def loaded_study(directory: Path) -> Study:
    """The study, with a note where it was begun again and is not done."""
    from comity.study import Study

    found = Study.load(directory)
    if (progress := found.progress) is not None:
        told = f"the study is {progress.state}, and its table may lack some. {progress.remedy}"
        typer.echo(f"note: {told}", err=True)
    return found


def compare(
    directory: StudyFolder,
    *,
    factor: Annotated[
        tuple[str, str, str],
        typer.Option("--factor", metavar="FACTOR A B", help="Such as: rulebook bruno2017 evidence."),
    ],
    outcome: Outcomes = [],  # noqa: B006  (Typer copies it)
    as_json: AsJson = False,
) -> None:
    """Compare two levels of a factor within the same individual, room and seed.

    Example: comity study compare runs/groups --factor rulebook bruno2017 evidence
    """
    from comity.report.text import show as say
    from comity.study.report.answering import comparison_answer, comparison_named, study_name
    from comity.study.report.episodes import StudyVisits
    from comity.study.report.factors import factors_of_visits
    from comity.study.report.outcomes import outcomes_of, pictured
    from comity.study.report.telling import compare_text

    found = loaded_study(directory)
    visits = StudyVisits.of(found)
    compared = comparison_named(visits, factors_of_visits(visits), *factor)
    drawn = pictured(outcomes_of(visits), outcome)
    answer = comparison_answer(visits, compared, drawn, study_name(found))
    if as_json:
        print_json(answer)
    else:
        say(*compare_text(answer))


def show(
    directory: StudyFolder,
    *,
    row: Annotated[int, typer.Option("--row", metavar="N", help="Row of results.csv.")],
    study: StudySource = None,
    out: Annotated[
        Path | None,
        typer.Option("--out", metavar="RUN", help="The run folder; in the report's folder without it."),
    ] = None,
    open_: OpenPage = False,
    as_json: AsJson = False,
) -> None:
    """Play the episode of a row again, to the same digest, and write its page.

    Ends with 1 where the digest is another one, as after a change of the code.

    Example: comity study show runs/groups --row 17 --open
    """
    from comity.report.text import show as say
    from comity.study.report.replaying import EPISODES, RowReplayer, file_of
    from comity.study.report.telling import show_text
    from comity.system.own_files import make_folder

    found = loaded_study(directory)
    replayer = RowReplayer.of(found, study or file_of(found))
    folder = out
    if folder is None:
        make_folder(directory / REPORT / EPISODES, private=True)
        folder = directory / REPORT / EPISODES / f"row-{row}"
    answer = replayer.play(row, folder)
    if as_json:
        print_json(answer)
    else:
        say(*show_text(answer))
    if open_:
        open_page(Path(answer.page))
    if not answer.same:
        raise typer.Exit(1)
