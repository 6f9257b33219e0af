"""`comity plan`: what the robot would do, and why, without doing it."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from comity.commands.options import As, AsJson, At, OptionalRulebookName, ScenarioName, day, pairs, print_json


def plan(
    scenario: ScenarioName,
    as_: As = [],  # noqa: B006  (Typer copies it)
    *,
    rulebook: OptionalRulebookName = None,
    at: At = None,
    pddl: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Write domain.pddl and problem.pddl there.")
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Plan a scenario and say why each step is so."""
    from comity.pddl_files import write_pddl
    from comity.preparation import prepare
    from comity.report.plan import plan_answer, plan_text
    from comity.report.text import show
    from comity.scenario import load_scenario

    people = pairs(as_, "--as", "guest=german_man")
    prepared = prepare(load_scenario(scenario), profiles=people, rulebook=rulebook, at=day(at))
    answer = plan_answer(prepared)
    if pddl is not None:
        write_pddl(prepared, pddl)
    if as_json:
        print_json(answer)
    else:
        show(*plan_text(answer))
    raise typer.Exit(1 if answer.unreachable else 0)
