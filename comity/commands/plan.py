"""`comity plan`: what the robot would do, and why, without doing it."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from comity.commands.options import As, AsJson, OptionalRulebookName, pairs, print_json
from comity.commands.own_plan import plan_own_domain
from comity_fis.errors import InputError, Where

OwnFile = Annotated[Path | None, typer.Option(metavar="FILE", help="PDDL of your own; needs both.")]
Bind = Annotated[
    Path | None,
    typer.Option("--bind", metavar="FILE", help="Which arguments and costs come from which person."),
]
Limit = Annotated[float, typer.Option(min=0.1, max=86_400, help="Seconds for the planner, with --domain.")]


def plan(
    scenario: Annotated[str | None, typer.Argument(help="A shipped scenario or a file.")] = None,
    *,
    as_: As = [],  # noqa: B006  (Typer copies it)
    rulebook: OptionalRulebookName = None,
    pddl: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Write domain.pddl and problem.pddl there.")
    ] = None,
    domain: OwnFile = None,
    problem: OwnFile = None,
    bind: Bind = None,
    limit: Limit = 30.0,
    as_json: AsJson = False,
) -> None:
    """Plan a scenario, or PDDL of your own, and say why each step is so."""
    if domain or problem or bind:
        plan_own_domain(domain, problem, bind, scenario=scenario, pddl=pddl, limit_s=limit, as_json=as_json)
        return
    if scenario is None:
        raise InputError(
            expected="a scenario",
            got="nothing",
            remedy="Name one, such as two-visits, or PDDL with --domain and --problem.",
            where=Where("SCENARIO"),
        )
    from comity.pddl_files import write_pddl
    from comity.preparation import prepare
    from comity.report.plan import plan_answer, plan_text
    from comity.report.text import show
    from comity.scenario import load_scenario

    prepared = prepare(
        load_scenario(scenario), profiles=pairs(as_, "--as", "guest=german_man"), rulebook=rulebook
    )
    answer = plan_answer(prepared)
    if pddl is not None:
        write_pddl(prepared, pddl)
    if as_json:
        print_json(answer)
    else:
        show(*plan_text(answer))
    raise typer.Exit(1 if answer.unreachable else 0)
