"""`comity explain`: one value, from the facts over the rules to the number."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from comity.commands.options import AsJson, At, OptionalProfileName, PersonsRulebookName, Set, day, print_json
from comity_fis.listing import listed

if TYPE_CHECKING:
    from comity.report.values.explained import Explained


def explain(
    parameter: Annotated[str, typer.Argument(help="For example conversational_distance.")],
    profile: OptionalProfileName = None,
    *,
    set_: Set = [],  # noqa: B006  (Typer copies it)
    rulebook: PersonsRulebookName = None,
    at: At = None,
    picture: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Draw it, as a .png, .svg or .pdf file.")
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Explain one value: facts, rules, what each contributed, and what would change it."""
    from comity.commands.facts import told_in_words
    from comity.report.text import show, unbroken
    from comity.report.values.explained import explained_answer, explained_text

    explained = told_in_words(profile, set_, rulebook, day(at)).explain(parameter)
    if picture is not None:
        _draw(explained, picture)
    if as_json:
        print_json(explained_answer(explained))
    else:
        show(*explained_text(explained))
        if picture is not None:
            show(unbroken(f"\nPicture  {picture}"))


def _draw(explained: Explained, picture: Path) -> None:
    from comity.report.values.explanation_picture import write_explanation
    from comity_fis import InputError, Where

    if explained.alone is None:
        raise InputError(
            expected="one culture to draw",
            got=listed(name for name, _, _ in explained.parts),
            remedy="Leave --picture out, or take one of them with --set culture=...",
            where=Where("--picture"),
        )
    write_explanation(explained.alone, picture)
