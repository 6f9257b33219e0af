"""`comity profile show`: what a person declared, and what follows from it, on a day or over the years."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from comity.commands.options import AsJson, At, PersonsRulebookName, day, print_json

if TYPE_CHECKING:
    from comity.people.profile import Declared


def show(
    name: Annotated[str, typer.Argument(help="A shipped or stored profile, or a file.")],
    *,
    at: At = None,
    rulebook: PersonsRulebookName = None,
    years: Annotated[
        str | None, typer.Option(metavar="FROM..TO", help="A life: the parameters year by year.")
    ] = None,
    picture: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="With --years: draw them, as a .png, .svg or .pdf file."),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Show what a person declared, and every value with what it is made of.

    For example: comity profile show one_life --years 2005..2025 --picture life.png
    """
    from comity.people.profile import load_profile

    declared = load_profile(name)
    if years is None and picture is None:
        _show_day(declared, at, rulebook, as_json)
    else:
        _show_life(declared, years or "", rulebook, picture, as_json)


def _show_day(declared: Declared, at: str | None, rulebook: str | None, as_json: bool) -> None:
    from comity.parameters.acquaintance import learnt_about, usual_situation
    from comity.parameters.values import infer_for
    from comity.parameters.which_rulebook import which_rulebook
    from comity.people.consents import consents_of
    from comity.people.profile import day_for
    from comity.people.remembered import remembered
    from comity.people.store import Store
    from comity.report.people.profile import ShownProfile, profile_answer, profile_text
    from comity.report.text import show as show_text
    from comity.system.library import shipped
    from comity_fis import load_rulebook

    on = day_for(day(at), declared.profile)
    book = load_rulebook(rulebook or which_rulebook([declared]).name)
    about = learnt_about(declared, book, usual_situation(declared, on), on)
    inference = infer_for(declared, book, at=on, learnt=about)
    is_shipped = declared.file is not None and declared.file.path in shipped("profile").values()
    place: Literal["shipped", "kept", "file"] = (
        "kept" if declared.kept_as else "shipped" if is_shipped else "file"
    )
    known = remembered(declared.kept_as) if declared.kept_as else None
    learnt = Store().learnt(declared.kept_as) if declared.kept_as and known else None
    note = str(declared.file.data.get("about", "")) if declared.file else ""
    agreed = consents_of(declared.kept_as) if declared.kept_as else None
    shown = ShownProfile(declared, place, on, inference, learnt, note, agreed)
    if as_json:
        print_json(profile_answer(shown))
    else:
        show_text(*profile_text(shown))


def _show_life(
    declared: Declared, years: str, rulebook: str | None, picture: Path | None, as_json: bool
) -> None:
    from comity.adaptation.life import life, years_in_words
    from comity.parameters.which_rulebook import which_rulebook
    from comity.report.drawing import check_picture, write_picture
    from comity.report.people.life import life_answer, life_text
    from comity.report.people.life_picture import life_picture
    from comity.report.text import show as show_text
    from comity.report.text import unbroken
    from comity_fis import load_rulebook

    check_picture(picture)
    lived = life(declared, load_rulebook(rulebook or which_rulebook([declared]).name), *years_in_words(years))
    called = declared.profile.name
    if picture is not None:
        write_picture(picture, lambda: life_picture(called, lived), private=True)
    if as_json:
        print_json(life_answer(called, lived, str(picture) if picture else None))
    else:
        show_text(*life_text(called, lived))
        if picture is not None:
            show_text(unbroken(f"\nPicture  {picture}"))
