"""`comity draw`: a map or a scenario from above."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from comity.commands.options import AsJson, print_json

if TYPE_CHECKING:
    from comity.report.place_picture import Drawing


def draw(
    place: Annotated[
        str,
        typer.Argument(metavar="MAP_OR_SCENARIO", help="A shipped map or scenario, or a file of either."),
    ],
    *,
    out: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="A .png or .svg file; <name>.png without it."),
    ] = None,
    graph: Annotated[
        bool, typer.Option("--graph", help="Draw rooms, named places and doors as a graph instead.")
    ] = False,
    seed: Annotated[int, typer.Option(min=0, help="For random places, where there are any.")] = 0,
    as_json: AsJson = False,
) -> None:
    """Draw a place from above: rooms, doors, furniture, named places.

    Of a scenario also the robot and the people, with the distances that they would like as dashed rings,
    the ways of those who walk, and passers-by where they start.

    Examples: `comity draw ward`, `comity draw kitchen.scenario.yaml --out kitchen.svg`,
    `comity draw ward --graph`.
    """
    from comity.answers import DrawAnswer
    from comity.report.place_picture import MARKS, drawing_of, format_of
    from comity.report.text import show, unbroken
    from comity.system.own_files import refuse_foreign, write_whole

    form = format_of(out)
    drawing: Drawing = drawing_of(place, seed)
    path = out or Path(f"{drawing.slug}{'-graph' if graph else ''}.png")
    refuse_foreign({path: MARKS[form]})
    content = drawing.graph(form) if graph else drawing.picture(form)
    write_whole(path, content, private=drawing.kind == "scenario")
    if as_json:
        print_json(DrawAnswer(file=str(path), name=drawing.name, kind=drawing.kind))
    else:
        show(unbroken(f"Picture  {path}"))
