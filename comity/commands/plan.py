"""`comity plan`: what the robot would do, and why, without doing it."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from comity.commands.options import As, AsJson, At, OptionalRulebookName, day, pairs, print_json
from comity.commands.own_plan import plan_own_domain, refuse_beside_domain
from comity_fis.errors import InputError, Where

OwnDomain = Annotated[
    Path | None, typer.Option(metavar="FILE", help="A PDDL domain of your own, instead of a scenario.")
]
OwnProblem = Annotated[Path | None, typer.Option(metavar="FILE", help="A PDDL problem for --domain.")]
Bind = Annotated[
    Path | None,
    typer.Option(
        "--bind", metavar="FILE", help="With --domain: which arguments and costs come from which person."
    ),
]
Limit = Annotated[float, typer.Option(metavar="SECONDS", help="With --domain: for the planner.")]


def plan(
    scenario: Annotated[str | None, typer.Argument(help="A shipped scenario or a file.")] = None,
    *,
    as_: As = [],  # noqa: B006  (Typer copies it)
    rulebook: OptionalRulebookName = None,
    at: At = None,
    pddl: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Write domain.pddl and problem.pddl there.")
    ] = None,
    domain: OwnDomain = None,
    problem: OwnProblem = None,
    bind: Bind = None,
    limit: Limit = 30.0,
    as_json: AsJson = False,
) -> None:
    """Plan a scenario, or PDDL of your own, and say why each step is so.

    For example: comity plan two-visits
    or: comity plan --domain waiter.pddl --problem evening.pddl --bind waiter.yaml
    """
    if domain or problem or bind:
        refuse_beside_domain({"SCENARIO": scenario, "--as": as_, "--rulebook": rulebook, "--at": at})
        plan_own_domain(domain, problem, bind, pddl=pddl, limit_s=limit, as_json=as_json)
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
