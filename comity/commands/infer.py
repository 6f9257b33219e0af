"""`comity infer`: one person's parameters."""

from __future__ import annotations

from typing import Annotated, Literal

import typer

from comity.commands.options import AsJson, At, OptionalProfileName, PersonsRulebookName, Set, day, print_json


def infer(
    profile: OptionalProfileName = None,
    *,
    set_: Set = [],  # noqa: B006  (Typer copies it)
    rulebook: PersonsRulebookName = None,
    mode: Annotated[
        Literal["exact", "matlab", "skfuzzy"], typer.Option(help="How the centre of area is computed.")
    ] = "exact",
    at: At = None,
    as_json: AsJson = False,
) -> None:
    """Infer one person's parameters, and what decided each."""
    from comity.commands.facts import told_in_words
    from comity.report.text import show
    from comity.report.values.inference import infer_answer, infer_text

    told = told_in_words(profile, set_, rulebook, day(at))
    inference = told.infer(mode)
    if as_json:
        print_json(infer_answer(inference, told.day))
    else:
        units = {name: variable.unit for name, variable in told.rulebook.variables.items()}
        show(*infer_text(inference, units, told.day))
