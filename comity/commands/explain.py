"""`comity explain`: one value, from the facts over the rules to the number."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from comity.commands.options import AsJson, OptionalProfileName, RulebookName, Set, print_json


def explain(
    parameter: Annotated[str, typer.Argument(help="For example conversational_distance.")],
    profile: OptionalProfileName = None,
    *,
    set_: Set = [],  # noqa: B006  (Typer copies it)
    rulebook: RulebookName = "bruno2017",
    picture: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Draw it as a PNG; a PNG that is there is replaced.")
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Explain one value: facts, rules, what each contributed, and what would change it."""
    from comity.commands.facts import explain_from_words
    from comity.report.explanation import explain_text
    from comity.report.explanation_answer import explain_answer
    from comity.report.text import show

    explanation = explain_from_words(parameter, profile, set_, rulebook)
    if picture is not None:
        from comity.report.explanation_picture import write_explanation

        write_explanation(explanation, picture)
    if as_json:
        print_json(explain_answer(explanation))
    else:
        show(*explain_text(explanation))
        if picture is not None:
            show(f"\nPicture  {picture}")
