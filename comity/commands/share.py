"""`comity share`: a run that can be passed on, of one that happened."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from comity.commands.options import AsJson, With, print_json


def share(
    run: Annotated[Path, typer.Argument(metavar="RUN", help="A run folder; it stays as it is.")],
    *,
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="The new folder; runs/shared-<n> without it.")
    ] = None,
    with_: With = [],  # noqa: B006  (Typer copies it)
    as_json: AsJson = False,
) -> None:
    """Write a run that can be passed on: pseudonyms, age bands, times from its start, and no free text.

    Tracks, numbers, the tree and the plan stay. Names of people, places and things, the day, what was said,
    rules, facts and reasons do not; culture and gender only where --with asks for them. What stays is
    personal data still: whoever knows who was there, or how a person moves, can tell who it is.

    For example: comity share runs/johanna-1 --out for-the-archive
    """
    from comity.output.run_folder import open_run
    from comity.report.text import show, unbroken
    from comity.sharing.run import share as share_run

    shared = share_run(open_run(run), out, with_)
    if as_json:
        print_json(shared.answer)
        return
    people = len(shared.answer.profiles)
    called = "people are" if people > 1 else "person is"
    show(
        unbroken(f"Folder   {shared.folder.path}"),
        f"{people} {called} called person_1 and so on, in the order of the scenario. "
        "What stays is personal data still.",
    )
