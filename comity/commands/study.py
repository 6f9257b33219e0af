"""`comity study`: the same visits for many people, rulebooks and settings, as one table."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import typer

from comity.commands.options import AsJson, print_json

StudyName = Annotated[Path, typer.Argument(metavar="FILE", help="A study; `comity schema study`.")]
StudyJobs = Annotated[
    int | None, typer.Option("--jobs", min=1, max=1000, help="Processes; one on each core without it.")
]


def plan(file: StudyName, *, jobs: StudyJobs = None, as_json: AsJson = False) -> None:
    """Check a study, count its episodes, and say how long it takes, before anything is written.

    A few episodes are tried for that, which also shows where seeds change nothing.

    Example: comity study plan groups.study.yaml
    """
    from comity.report.text import show
    from comity.study.estimate import estimated
    from comity.study.study_plan import load_study
    from comity.study.telling import plan_answer, plan_text

    study = load_study(file)
    answer = plan_answer(study, estimated(study), jobs or os.cpu_count() or 1)
    if as_json:
        print_json(answer)
    else:
        show(*plan_text(answer))
