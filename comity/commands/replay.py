"""`comity replay`: one page that shows an episode, or two side by side."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def replay(
    run: Annotated[Path, typer.Argument(metavar="RUN", help="A run folder.")],
    other: Annotated[
        Path | None, typer.Argument(metavar="OTHER", help="Another run to show side by side with it.")
    ] = None,
    *,
    out: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="The page; replay.html in RUN without it, of two comparison.html."),
    ] = None,
) -> None:
    """Write one HTML page that shows an episode; it needs no network and no other file.

    For example: comity replay runs/johanna-1 --out visit.html
    """
    from comity.output.run_folder import COMPARISON, READINGS, REPLAY, open_run
    from comity.replay import MARK, replay_page
    from comity.report.text import show, unbroken
    from comity.system.own_files import refuse_foreign, write_whole

    folder = open_run(run)
    beside = open_run(other) if other is not None else None
    target = out or folder / (COMPARISON if beside else REPLAY)
    refuse_foreign({target: MARK})
    write_whole(target, replay_page(folder, beside).encode())
    for one in (folder, beside):
        if one and not (one / READINGS).is_file():
            show(unbroken(f"Note  {one.path} has no {READINGS}; the page does not need it"))
    show(unbroken(f"Page  {target}"))
