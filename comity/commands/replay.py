"""`comity replay`: one page that shows an episode, or two side by side; or a picture, or a GIF."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from comity_fis.errors import InputError, Where

if TYPE_CHECKING:
    from comity.output.run_folder import RunFolder


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
    picture: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="Draw RUN as a .png, .svg or .pdf file there, and no page."),
    ] = None,
    gif: Annotated[
        Path | None, typer.Option("--gif", metavar="FILE", help="Write a GIF of RUN there, and no page.")
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
    if gif is not None or picture is not None:
        if other is not None or out is not None or None not in (gif, picture):
            raise _one_file(
                "a second run" if other is not None else "--out" if out else "--picture and --gif"
            )
        if picture is not None:
            _draw(folder, picture)
        if gif is not None:
            _film(folder, gif)
        return
    beside = open_run(other) if other is not None else None
    target = out or folder / (COMPARISON if beside else REPLAY)
    refuse_foreign({target: MARK})
    write_whole(target, replay_page(folder, beside).encode(), private=True)
    for one in (folder, beside):
        if one and not (one / READINGS).is_file():
            show(unbroken(f"Note  {one.path} has no {READINGS}; the page does not need it"))
    show(unbroken(f"Page  {target}"))


def _draw(folder: RunFolder, path: Path) -> None:
    from comity.replay.pictures import write_picture
    from comity.report.drawing import check_picture
    from comity.report.text import show, unbroken

    check_picture(path)
    write_picture(folder, path)
    show(unbroken(f"Picture  {path}"))


def _film(folder: RunFolder, path: Path) -> None:
    from comity.output.run_folder import ANIMATION
    from comity.replay.pictures import GIF_MARK, film_run
    from comity.replay.saved_run import read_run
    from comity.report.text import show, unbroken
    from comity.system.own_files import refuse_foreign, writing, written_whole

    if path.suffix.lower() != ".gif":
        raise InputError(
            expected="a GIF file to write",
            got=repr(path.name),
            remedy=f"Name it {path.with_suffix('.gif').name}, and convert it afterwards.",
            where=Where("--gif"),
        )
    if path.resolve() != (folder / ANIMATION).resolve():  # there it is ours, also one without the mark
        refuse_foreign({path: GIF_MARK})
    with writing(path), written_whole(path, private=True) as part:
        film_run(read_run(folder), part)
    show(unbroken(f"GIF  {path}"))


def _one_file(besides: str) -> InputError:
    return InputError(
        expected="one run and no page, where a picture or a GIF is written",
        got=besides,
        remedy="Write each with a command of its own.",
        where=Where("--gif"),
    )
