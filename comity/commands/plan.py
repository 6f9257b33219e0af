"""`comity plan`: what the robot would do, and why, without doing it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from comity.commands.options import As, AsJson, OptionalRulebookName, ScenarioName, pairs, print_json
from comity_fis.errors import InputError, Where

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rich.console import RenderableType

    from comity.answers import PlanAnswer


def plan(
    scenario: ScenarioName,
    *,
    as_: As = [],  # noqa: B006  (Typer copies it)
    rulebook: OptionalRulebookName = None,
    why: Annotated[
        str | None,
        typer.Option(
            metavar="STEP", help="Only one step, by number or as `Greet_person(johanna)`: all about it."
        ),
    ] = None,
    diff: Annotated[
        bool, typer.Option("--diff", help="Also what --as or --rulebook changes, and why.")
    ] = False,
    stability: Annotated[
        bool, typer.Option("--stability", help="Also how far the weights can change before the plan does.")
    ] = False,
    pddl: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Write domain.pddl and problem.pddl there.")
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Plan a scenario and say why each step is so.

    Exit code 1: a goal cannot be met; the answer says which, and what stands in its way. Examples:
    `comity plan two-visits --why 2`, `comity plan two-visits --as guest=german_man --diff`.
    """
    from comity.diagnosis import GoalsUnmet
    from comity.preparation import prepare
    from comity.report.plan import no_plan_answer, plan_answer
    from comity.report.plan_diff import plan_diff
    from comity.report.plan_stability import stability as stability_of
    from comity.report.plan_why import step_why
    from comity.report.text import show
    from comity.scenario import load_scenario

    file, profiles = load_scenario(scenario), pairs(as_, "--as", "guest=german_man")
    _require_change(diff=diff, changed=bool(profiles or rulebook))
    try:
        prepared = prepare(file, profiles=profiles, rulebook=rulebook)
        answer = plan_answer(prepared)
        written = prepare(file) if diff else None
    except GoalsUnmet as failed:
        if not as_json:
            raise
        print_json(no_plan_answer(file, failed))
        raise typer.Exit(1) from None
    more = {
        "why": step_why(answer, prepared, why) if why is not None else None,
        "diff": plan_diff(written, prepared) if written else None,
        "stability": stability_of(prepared) if stability else None,
    }
    answer = answer.model_copy(update=more)
    if pddl is not None:
        from comity.pddl_files import write_pddl

        write_pddl(prepared, pddl)
    if as_json:
        print_json(answer)
    else:
        show(*_text(answer, stability=stability))
    raise typer.Exit(1 if answer.unmet else 0)


def _require_change(*, diff: bool, changed: bool) -> None:
    if diff and not changed:
        raise InputError(
            expected="--diff with something that differs",
            got="the scenario as it is written",
            remedy="Add --as PERSON=PROFILE or --rulebook R.",
            where=Where("--diff"),
        )


def _text(answer: PlanAnswer, *, stability: bool) -> Iterator[RenderableType]:
    from comity.report.plan import plan_text
    from comity.report.plan_diff import diff_text
    from comity.report.plan_stability import stability_text
    from comity.report.plan_why import why_text

    yield from why_text(answer.why) if answer.why else plan_text(answer)
    if answer.diff:
        yield from diff_text(answer.diff)
    if stability:
        yield from stability_text(answer.stability)
