"""`comity explain`: one value, from the facts over the rules to the number."""

from __future__ import annotations

from typing import Annotated

import typer

from comity.commands.options import AsJson, OptionalProfileName, RulebookName, Set, print_json


def explain(
    parameter: Annotated[str, typer.Argument(help="For example conversational_distance.")],
    profile: OptionalProfileName = None,
    set_: Set = [],  # noqa: B006  (Typer copies it)
    rulebook: RulebookName = "bruno2017",
    as_json: AsJson = False,
) -> None:
    """Explain one value: facts, rules, sources, result."""
    from comity.commands.facts import infer_from_words
    from comity.report.explanation import explain_answer, explain_text
    from comity.report.text import show
    from comity_fis import InputError, closest

    inference = infer_from_words(profile, set_, rulebook, "exact")
    if parameter not in inference.parameters:
        raise InputError(
            expected=f"a parameter of the rulebook {inference.rulebook}",
            got=repr(parameter),
            remedy=closest(parameter, inference.parameters),
        )
    answer = explain_answer(inference, parameter)
    if as_json:
        print_json(answer)
    else:
        show(*explain_text(answer))
