"""`comity study`: the same visits for many people, rulebooks and settings, as one table."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from comity.commands.options import AsJson, print_json

if TYPE_CHECKING:
    from comity.study.carrying import EpisodeRunner

StudyName = Annotated[Path, typer.Argument(metavar="FILE", help="A study; `comity schema study`.")]
StudyJobs = Annotated[
    int | None, typer.Option("--jobs", min=1, max=1000, help="Processes; one on each core without it.")
]
StudyOut = Annotated[
    Path,
    typer.Option("--out", metavar="DIR", help="The study's folder; what it holds of the study is kept."),
]
PlannedOut = Annotated[
    Path | None,
    typer.Option("--out", metavar="DIR", help="The study's folder: says how much of it is there already."),
]
SchedulerAddress = Annotated[
    str | None,
    typer.Option("--scheduler", metavar="ADDRESS", help="A Dask cluster, such as tcp://127.0.0.1:8786."),
]


def plan(file: StudyName, *, out: PlannedOut = None, jobs: StudyJobs = None, as_json: AsJson = False) -> None:
    """Check a study, count its episodes, and say how long it takes, before anything is written.

    A few episodes are tried for that, which also shows where seeds change nothing.

    Example: comity study plan groups.study.yaml
    """
    from comity.report.text import show
    from comity.study.estimate import estimated
    from comity.study.folder import require_study_folder
    from comity.study.study_plan import load_study
    from comity.study.telling import plan_answer, plan_text

    study = load_study(file)
    if out is not None:
        require_study_folder(out, study.written.name)
    answer = plan_answer(study, estimated(study), jobs or os.cpu_count() or 1, out)
    if as_json:
        print_json(answer)
    else:
        show(*plan_text(answer))


def run(
    file: StudyName,
    *,
    out: StudyOut,
    jobs: StudyJobs = None,
    scheduler: SchedulerAddress = None,
    as_json: AsJson = False,
) -> None:
    """Carry out what is missing of a study, and write its table.

    What is in DIR already is not run again: a study that was stopped or killed goes on, and one with more
    seeds or individuals runs only these. An episode that raises is a row with its error. Ends with 1 where
    the table lacks an episode.

    Example: comity study run groups.study.yaml --out runs/groups
    """
    from contextlib import ExitStack

    from comity.commands.progress import rating
    from comity.report.text import show
    from comity.study.folder import require_study_folder
    from comity.study.running import Watch, run_study
    from comity.study.study_plan import load_study
    from comity.study.telling import run_text

    _refuse_both(jobs, scheduler)
    study = load_study(file)
    require_study_folder(out, study.written.name)
    for note in study.notes:
        typer.echo(f"note: {note}", err=True)
    with ExitStack() as shown:

        def start(missing: int, total: int) -> Watch:
            return shown.enter_context(rating(missing, total, quiet=as_json))

        answer = run_study(study, out, lambda: _carrier(jobs, scheduler), start)
    if as_json:
        print_json(answer)
    else:
        show(*run_text(answer))
    if answer.status != "done":
        raise typer.Exit(1)


def _refuse_both(jobs: int | None, scheduler: str | None) -> None:
    from comity_fis import InputError, Where

    if jobs is not None and scheduler is not None:
        raise InputError(
            expected="--jobs or --scheduler",
            got="both",
            remedy="A cluster has as many workers as it has: leave --jobs out.",
            where=Where("--jobs"),
        )


def _carrier(jobs: int | None, scheduler: str | None) -> EpisodeRunner:
    if scheduler is None:
        from comity.study.local_workers import local_carrier

        return local_carrier(jobs or os.cpu_count() or 1)
    from comity.study.cluster_workers import cluster_carrier

    return cluster_carrier(scheduler)
