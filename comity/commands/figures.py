"""`comity figures`: the paper's figures, drawn from what this package computes."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from comity.commands.options import AsJson, print_json


def figures(
    out: Annotated[Path, typer.Option(metavar="DIR", help="The folder for the pictures.")],
    as_json: AsJson = False,
) -> None:
    """Draw the paper's variables, scores, fits, outputs and mappings."""
    from comity.report.drawing import MARK
    from comity.report.text import show, table
    from comity.report.values.figures import FIGURES
    from comity.system.own_files import make_folder, refuse_foreign, write_whole

    make_folder(out)
    paths = {name: out / f"{name}.png" for name in FIGURES}
    refuse_foreign(dict.fromkeys(paths.values(), MARK))
    for name, figure in FIGURES.items():
        write_whole(paths[name], figure.draw())
    if as_json:
        listed = [{"file": str(paths[name]), "shows": figure.shows} for name, figure in FIGURES.items()]
        print_json({"figures": listed})
    else:
        show(table([(str(paths[name]), figure.shows) for name, figure in FIGURES.items()]))
