"""`comity metrics`: the figures of runs, and what each of them means."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from comity.commands.options import AsJson, print_json


def metrics(
    runs: Annotated[list[Path], typer.Argument(metavar="RUN...", help="Run folders.")],
    *,
    out: Annotated[
        Path | None,
        typer.Option(metavar="FILE.csv", help="Write them one figure a line, for a statistics program."),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Show the metrics of runs: paths, speeds, gaps to people, stops against their targets.

    For example: comity metrics runs/johanna-1 runs/johanna-2 --out figures.csv
    """
    from comity.output.run_folder import open_run
    from comity.report.episodes.metrics import MARK, measured, metrics_answer, metrics_csv, metrics_text
    from comity.report.text import show, unbroken
    from comity.system.own_files import refuse_foreign, write_whole

    found = [measured(open_run(run)) for run in runs]
    answer = metrics_answer(found)
    if out is not None:
        refuse_foreign({out: MARK})
        write_whole(out, metrics_csv(answer).encode(), private=True)
    if as_json:
        print_json(answer)
    elif out is not None:
        show(unbroken(f"{len(answer.figures)} figures  {out}"))
    else:
        show(*metrics_text(found, answer))
