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
        typer.Option(metavar="FILE", help="A .png, .svg or .pdf file; <name>.png without it."),
    ] = None,
    graph: Annotated[
        bool, typer.Option("--graph", help="Draw rooms, named places and doors as a graph instead.")
    ] = False,
    ros_map: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="Write a ROS map instead: <name>.yaml, .pgm and .places.yaml."),
    ] = None,
    seed: Annotated[int, typer.Option(min=0, help="For random places, where there are any.")] = 0,
    as_json: AsJson = False,
) -> None:
    """Draw a place from above: rooms, doors, furniture, named places.

    Of a scenario also the robot and the people, with the distances that they would like as dashed rings,
    the ways of those who walk, and passers-by where they start.

    Examples: `comity draw ward`, `comity draw kitchen.scenario.yaml --out kitchen.svg`,
    `comity draw ward --graph`, `comity draw ward --ros-map maps`.
    """
    from comity.answers.figures import DrawAnswer
    from comity.report.drawing import check_picture, form_of
    from comity.report.place_picture import drawing_of
    from comity.report.text import show, unbroken
    from comity.system.own_files import write_whole

    if ros_map is not None:
        _require_no_picture(out, graph=graph)
        _write_ros_map(drawing_of(place, seed), ros_map, as_json=as_json)
        return
    form = form_of(out, "--out")
    drawing: Drawing = drawing_of(place, seed)
    path = out or Path(f"{drawing.slug}{'-graph' if graph else ''}.png")
    check_picture(path, "--out")
    content = drawing.graph(form) if graph else drawing.picture(form)
    write_whole(path, content, private=drawing.kind == "scenario")
    if as_json:
        print_json(DrawAnswer(file=str(path), name=drawing.name, kind=drawing.kind))
    else:
        show(unbroken(f"Picture  {path}"))


def _require_no_picture(out: Path | None, *, graph: bool) -> None:
    from comity_fis import InputError, Where

    if out is not None or graph:
        raise InputError(
            expected="a picture or a ROS map",
            got=f"--ros-map with {'--graph' if graph else '--out'}",
            remedy="Run it twice.",
            where=Where("--ros-map"),
        )


def _write_ros_map(drawing: Drawing, folder: Path, *, as_json: bool) -> None:
    from comity.answers.figures import DrawAnswer
    from comity.report.place_picture import ROS_MARKS
    from comity.report.text import show, unbroken
    from comity.system.own_files import refuse_foreign, write_whole, writing

    files = {folder / name: content for name, content in drawing.ros_map().items()}
    with writing(folder):
        folder.mkdir(parents=True, exist_ok=True)
    refuse_foreign({path: ROS_MARKS[path.suffix] for path in files})
    for path, content in files.items():
        write_whole(path, content)
    if as_json:
        print_json(DrawAnswer(file=str(next(iter(files))), name=drawing.name, kind=drawing.kind))
    else:
        show(*(unbroken(f"ROS map  {path}") for path in files))
