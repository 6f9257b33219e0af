"""`comity fit`: a linguistic variable from a column of data."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import typer

from comity.commands.options import AsJson, print_json

File = Annotated[Path, typer.Argument(metavar="FILE.csv", help="A table with a line of headings.")]
Column = Annotated[str, typer.Option(metavar="NAME", help="The heading of the column.")]
Radius = Annotated[float, typer.Option(help="Of a cluster's influence, as a fraction of the data's range.")]
Range = Annotated[
    tuple[float, float] | None,
    typer.Option("--range", metavar="LOW HIGH", help="Of the variable; that of the data without it."),
]
LevelName = Annotated[Literal["ordinal", "interval", "ratio"], typer.Option(help="Of measurement.")]
Coerced = Annotated[
    str | None, typer.Option(metavar="REASON", help="Why ordinal data are treated as interval data.")
]
Out = Annotated[Path | None, typer.Option(metavar="FILE.yaml", help="Write the variable there.")]
Picture = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE", help="Draw scores, memberships and curves there, as a .png, .svg or .pdf file."
    ),
]


def fit(
    file: File,
    *,
    column: Column,
    radius: Radius = 0.5,
    range_: Range = None,
    level: LevelName = "interval",
    coercion: Coerced = None,
    out: Out = None,
    picture: Picture = None,
    as_json: AsJson = False,
) -> None:
    """Make a linguistic variable from data: clusters, terms, YAML.

    Exit code 1: the data form one cluster at this radius, and so no terms.
    """
    from comity.report.drawing import check_picture, write_picture
    from comity.report.rulebooks.fit import MARK, fit_answer, fit_text, variable_yaml
    from comity.report.text import show, unbroken
    from comity.system.own_files import refuse_foreign, write_whole
    from comity.tables.column import read_column
    from comity.tables.fit import fit_column
    from comity_fis import Level

    check_picture(picture)
    if out is not None:
        refuse_foreign({out: MARK.encode()})
    found = fit_column(
        read_column(file, column), radius=radius, domain=range_, level=Level[level.upper()], coercion=coercion
    )
    written = []
    if found.variable is not None and out is not None:
        write_whole(out, variable_yaml(found).encode())
        written.append(str(out))
    if picture is not None:
        from comity.report.rulebooks.fit_picture import fit_picture

        write_picture(picture, lambda: fit_picture(found))
        written.append(str(picture))
    if as_json:
        print_json(fit_answer(found, tuple(written)))
    else:
        show(*fit_text(found), *(unbroken(f"\nWrote {path}") for path in written))
        if found.variable is not None and out is None:
            print(f"\n{variable_yaml(found).partition(chr(10))[2]}", end="")
    raise typer.Exit(0 if found.variable is not None else 1)
