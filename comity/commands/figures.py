"""`comity figures`: the responses of a rulebook's parameters to their inputs; or the paper's figures."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from comity.commands.options import AsJson, Set, print_json

if TYPE_CHECKING:
    from collections.abc import Sequence

    from comity.report.rulebooks.response import Responses


@dataclass(frozen=True, slots=True)
class _Picture:
    """One file that is to be written."""

    shows: str
    draw: Callable[[], bytes]


def figures(
    rulebook: Annotated[
        str | None, typer.Argument(help="A shipped rulebook or a file; without it, the paper's figures.")
    ] = None,
    *,
    out: Annotated[
        Path,
        typer.Option(
            metavar="DIR",
            help="The folder for the pictures; with one --parameter a .png, .svg or .pdf file, too.",
        ),
    ],
    parameter: Annotated[
        list[str], typer.Option(metavar="NAME", help="Of the rulebook; all of them without it.")
    ] = [],  # noqa: B006  (Typer copies it)
    set_: Set = [],  # noqa: B006  (Typer copies it)
    format_: Annotated[
        Literal["png", "svg", "pdf"] | None,
        typer.Option("--format", help="Of the pictures in a folder; png without it."),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Draw response curves and surfaces of a rulebook, or the paper's figures.

    Examples: `comity figures bruno2017 --out figures`, `comity figures --format pdf --out figures`,
    `comity figures tip.fis --out tip.svg`.
    """
    from comity.report.text import show, table
    from comity.system.own_files import make_folder, refuse_foreign, write_whole

    form = _form(out, format_)
    if rulebook is None:
        _refuse_without_rulebook({"--parameter": parameter, "--set": set_})
        idle: Sequence[str] = ()
        pictures: Mapping[Path, _Picture] = _of_the_paper(out, form)
    else:
        pictures, idle = _of_rulebook(rulebook, out, form, parameter, set_)
    if not _is_file(out):
        make_folder(out)
    refuse_foreign({path: _mark(path) for path in pictures})
    for path, picture in pictures.items():
        write_whole(path, picture.draw())
    if as_json:
        listed = [{"file": str(path), "shows": picture.shows} for path, picture in pictures.items()]
        print_json({"figures": listed, **({} if rulebook is None else {"without_inputs": idle})})
    else:
        show(table([(str(path), picture.shows) for path, picture in pictures.items()]))
        if idle:
            show(f"Nothing changes {', '.join(idle)}: no picture.")


def _is_file(out: Path) -> bool:
    """Whether a picture is named, and not a folder for several.

    Raises:
        InputError: for a picture in another format.
    """
    from comity_fis import InputError, Where

    if out.suffix.lower() in {".eps", ".ps", ".jpg", ".jpeg", ".gif", ".webp"}:
        raise InputError(
            expected="a folder, or a file that ends with .png, .svg or .pdf",
            got=repr(str(out)),
            remedy="Name it so, and convert it afterwards.",
            where=Where("--out"),
        )
    return out.suffix.lower() in {".png", ".svg", ".pdf"} and not out.is_dir()


def _form(out: Path, asked: str | None) -> str:
    """The form of the pictures: of a file by its ending, of those in a folder the one asked for.

    Raises:
        InputError: for a file that ends otherwise than asked for.
    """
    from comity_fis import InputError, Where

    if not _is_file(out):
        return asked or "png"
    form = out.suffix.lower().removeprefix(".")
    if asked not in (None, form):
        raise InputError(
            expected=f"a file that ends with .{asked}, or a folder",
            got=repr(str(out)),
            remedy=f"Leave out --format, or name it {out.with_suffix(f'.{asked}')}.",
            where=Where("--out"),
        )
    return form


def _mark(path: Path) -> bytes:
    from comity.report.drawing import MARKS

    return MARKS[path.suffix.lower().removeprefix(".")]


def _refuse_without_rulebook(given: Mapping[str, Sequence[str]]) -> None:
    from comity_fis import InputError, Where

    for option, words in given.items():
        if words:
            raise InputError(
                expected=f"a rulebook for {option}",
                got="none",
                remedy=f"Name it: comity figures bruno2017 {option} {words[0]} --out figures.",
                where=Where(option),
            )


def _of_the_paper(out: Path, form: str) -> Mapping[Path, _Picture]:
    from comity.report.values.figures import FIGURES
    from comity_fis import InputError, Where

    if _is_file(out):
        raise InputError(
            expected="a folder for the paper's figures",
            got=repr(str(out)),
            remedy="Name a folder: they are several.",
            where=Where("--out"),
        )
    return {
        out / f"{name}.{form}": _Picture(figure.shows, partial(figure.draw, form))
        for name, figure in FIGURES.items()
    }


def _of_rulebook(
    name: str, out: Path, form: str, asked: Sequence[str], words: Sequence[str]
) -> tuple[Mapping[Path, _Picture], Sequence[str]]:
    """A picture for every parameter that something changes, and the names of the others."""
    from comity.commands.facts import precise_facts_in_words
    from comity.report.rulebooks.response import responses
    from comity_fis import InputError, Where, load_rulebook, unknown_word

    book = load_rulebook(name)
    for one in asked:
        if one not in book.parameters:
            raise unknown_word(
                f"a parameter of the rulebook {book.name}", one, book.parameters, where=Where("--parameter")
            )
    held = precise_facts_in_words(words, book)
    found = {one: responses(book, one, held) for one in asked or book.parameters}
    drawn = {one: shown for one, shown in found.items() if shown.curves}
    if not drawn:
        raise InputError(
            expected="a parameter that some input changes",
            got=", ".join(found),
            remedy="Name another parameter, or hold fewer facts with --set.",
            where=Where(book.name),
        )
    if _is_file(out) and len(drawn) > 1:
        raise InputError(
            expected="a folder, or one --parameter for one file",
            got=f"{len(drawn)} parameters and {str(out)!r}",
            remedy=f"Name a folder, or add --parameter {next(iter(drawn))}.",
            where=Where("--out"),
        )
    pictures = {
        out if _is_file(out) else out / f"{slug}.{form}": _response(shown, book.name, form)
        for slug, shown in zip(_slugs(list(drawn)), drawn.values(), strict=True)
    }
    return pictures, [one for one in found if one not in drawn]


def _response(shown: Responses, rulebook: str, form: str) -> _Picture:
    from comity.report.rulebooks.response_picture import response_picture
    from comity.report.text import words, words_of

    over = words_of(curve.variable.name for curve in shown.curves)
    surfaces = len(shown.surfaces)
    more = f", and {surfaces} surface{'s' if surfaces > 1 else ''}" if surfaces else ""
    return _Picture(
        f"{words(shown.parameter.name)} over {over}{more}", lambda: response_picture(shown, rulebook, form)
    )


def _slugs(names: Sequence[str]) -> list[str]:
    """Names of files for names of parameters, which may hold anything; no two alike."""
    found: list[str] = []
    for name in names:
        slug = re.sub(r"[^\w.-]+", "-", name).strip("-.") or "parameter"
        taken = {other.lower() for other in found}
        number = 2
        unique = slug
        while unique.lower() in taken:
            unique, number = f"{slug}-{number}", number + 1
        found.append(unique)
    return found
