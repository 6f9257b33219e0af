"""`comity convert`: rulebooks to and from MATLAB's `.fis` files."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from comity.commands.options import AsJson, print_json


def convert(
    source: Annotated[
        str, typer.Argument(metavar="IN", help="A .fis file, a rulebook file or a shipped one.")
    ],
    out: Annotated[Path, typer.Argument(metavar="OUT", help="A .fis or .yaml file to write.")],
    piecewise_linear: Annotated[
        float | None,
        typer.Option(
            metavar="ERROR",
            min=0,
            max=1,
            help="Write curves that MATLAB does not have as trapezoids, off by this much at most.",
        ),
    ] = None,
    parameter: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME", help="Only this parameter, with what its rules read; may be given several times."
        ),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Convert a rulebook to or from MATLAB's .fis, and say what that changes."""
    from comity.output.conversion import converted
    from comity.report.rulebooks.conversion import convert_text
    from comity.report.text import show

    answer = converted(source, out, tolerance=piecewise_linear, parameters=parameter or ())
    if as_json:
        print_json(answer)
    else:
        show(*convert_text(answer))
