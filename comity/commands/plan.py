"""`comity plan`: what the robot would do, and why, without doing it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from comity.commands.custom_plan import CustomQuestion, plan_custom_domain, refuse_beside_domain
from comity.commands.options import (
    As,
    AsJson,
    At,
    EngineName,
    OptionalRulebookName,
    OptionalScenarioName,
    Seed,
    day,
    pairs,
    print_json,
)
from comity_fis.errors import InputError, Where

CustomDomain = Annotated[
    Path | None, typer.Option(metavar="FILE", help="A custom PDDL domain, instead of a scenario.")
]
CustomProblem = Annotated[Path | None, typer.Option(metavar="FILE", help="A PDDL problem for --domain.")]
Bind = Annotated[
    Path | None,
    typer.Option(
        "--bind", metavar="FILE", help="With --domain: which arguments and costs come from which person."
    ),
]
Limit = Annotated[
    float | None, typer.Option(metavar="SECONDS", help="With --domain: for the planner; 30 without it.")
]
Why = Annotated[
    str | None,
    typer.Option(
        metavar="STEP", help="Only one step, by number or as `Greet_person(johanna)`: all about it."
    ),
]
Diff = Annotated[bool, typer.Option("--diff", help="Also what --as or --rulebook changes, and why.")]
Stability = Annotated[
    bool, typer.Option("--stability", help="Also how far the weights can change before the plan does.")
]
Pddl = Annotated[Path | None, typer.Option(metavar="DIR", help="Write domain.pddl and problem.pddl there.")]
Validate = Annotated[
    bool, typer.Option("--validate", help="Also have the plan checked by unified-planning's validator.")
]
LIMIT_S = 30.0

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from rich.console import RenderableType

    from comity.answers.plan import PlanAnswer
    from comity.preparation import PlannedEpisode
    from comity.scenario import Scenario


def plan(
    scenario: OptionalScenarioName = None,
    *,
    as_: As = [],  # noqa: B006  (Typer copies it)
    rulebook: OptionalRulebookName = None,
    at: At = None,
    seed: Seed = 0,
    why: Why = None,
    diff: Diff = False,
    stability: Stability = False,
    pddl: Pddl = None,
    engine: EngineName = "comity",
    validate: Validate = False,
    domain: CustomDomain = None,
    problem: CustomProblem = None,
    bind: Bind = None,
    limit: Limit = None,
    as_json: AsJson = False,
) -> None:
    """Plan a scenario, or custom PDDL, and say why each step is so.

    Exit code 1: a goal cannot be met; the answer says which, and what stands in its way. Examples:
    `comity plan two-visits --why 2`, `comity plan two-visits --as guest=german_man --diff`,
    `comity plan --domain waiter.pddl --problem evening.pddl --bind waiter.yaml`.
    """
    own = {"--domain": domain, "--problem": problem, "--bind": bind}
    if any(own.values()):
        option = next(option for option, file in own.items() if file)
        refuse_beside_domain(option, scenario, seed, validates=validate)
        custom_question = CustomQuestion(
            domain=domain,
            problem=problem,
            binding=bind,
            profiles=pairs(as_, "--as", "guest=german_man"),
            rulebook=rulebook,
            at=day(at),
            why=why,
            diff=diff,
            stability=stability,
            pddl=pddl,
            limit_s=LIMIT_S if limit is None else limit,
            engine=engine,
            as_json=as_json,
        )
        plan_custom_domain(custom_question)
        return
    scenario = _scenario_alone(scenario, limit)
    ask = PlanOptions(scenario, pairs(as_, "--as", "guest=german_man"), rulebook, at, seed, engine)
    _require_change(diff=diff, changed=bool(ask.profiles or rulebook))
    answer = _answered(
        ask, why=why, diff=diff, stability=stability, validates=validate, pddl=pddl, as_json=as_json
    )
    _tell(answer, stability=stability, as_json=as_json)
    invalid = answer.validation is not None and not answer.validation.valid
    raise typer.Exit(1 if answer.unmet or invalid else 0)


@dataclass(frozen=True, slots=True)
class PlanOptions:
    """Which scenario is planned, and what is other than written."""

    scenario: str
    profiles: Mapping[str, str]
    rulebook: str | None
    at: str | None
    seed: int
    engine: str


def _answered(
    ask: PlanOptions,
    *,
    why: str | None,
    diff: bool,
    stability: bool,
    validates: bool,
    pddl: Path | None,
    as_json: bool,
) -> PlanAnswer:
    """The plan, with all that was asked about it; where there is none, the end."""
    from comity.commands.progress import waiting
    from comity.planning.diagnosis import GoalsUnmet
    from comity.preparation import prepare
    from comity.report.plans.plan import no_plan_answer, plan_answer
    from comity.scenario import load_scenario

    file = load_scenario(ask.scenario)
    try:
        with waiting(_what_takes_time(file.scenario), quiet=as_json):
            prepared = prepare(
                file,
                profiles=ask.profiles,
                rulebook=ask.rulebook,
                at=day(ask.at),
                seed=ask.seed,
                engine=ask.engine,
            )
            written = prepare(file, at=day(ask.at), seed=ask.seed, engine=ask.engine) if diff else None
    except GoalsUnmet as failed:
        if not as_json:
            raise
        print_json(no_plan_answer(file, failed))
        raise typer.Exit(1) from None
    answer = plan_answer(prepared)
    answer = replace(answer, **_more(answer, prepared, why=why, written=written, stability=stability))
    if validates:
        from comity_domain import validate

        answer = replace(answer, validation=validate(prepared.plan, prepared.asked.request))
    if pddl is not None:
        from comity.output.pddl_files import write_pddl

        write_pddl(prepared, pddl)
    return answer


def _what_takes_time(scenario: Scenario) -> str:
    people, seconds = len(scenario.visited()), scenario.limits.planning_s
    return f"planning for {people} people, for {seconds:g} s at most"


def _more(
    answer: PlanAnswer,
    prepared: PlannedEpisode,
    *,
    why: str | None,
    written: PlannedEpisode | None,
    stability: bool,
) -> dict[str, Any]:
    """What else was asked about a plan."""
    from comity.report.plans.plan_diff import plan_diff
    from comity.report.plans.plan_stability import stability as stability_of
    from comity.report.plans.plan_why import step_why

    return {
        "why": step_why(answer, prepared, why) if why is not None else None,
        "diff": plan_diff(written, prepared) if written else None,
        "stability": stability_of(prepared.asked.request, prepared.plan) if stability else None,
    }


def _scenario_alone(scenario: str | None, limit: float | None) -> str:
    """Refuse that there is none, and what means nothing beside one."""
    if scenario is None:
        raise InputError(
            expected="a scenario",
            got="nothing",
            remedy="Name one, such as two-visits, or PDDL with --domain and --problem.",
            where=Where("SCENARIO"),
        )
    if limit is not None:
        raise InputError(
            expected="a limit with --domain only",
            got="one beside a scenario",
            remedy="Write it into the scenario, for example `limits: {planning_s: 10}`.",
            where=Where("--limit"),
        )
    return scenario


def _require_change(*, diff: bool, changed: bool) -> None:
    if diff and not changed:
        raise InputError(
            expected="--diff with something that differs",
            got="the scenario as it is written",
            remedy="Add --as PERSON=PROFILE or --rulebook R.",
            where=Where("--diff"),
        )


def _tell(answer: PlanAnswer, *, stability: bool, as_json: bool) -> None:
    from comity.report.text import show

    if as_json:
        print_json(answer)
    else:
        show(*_text(answer, stability=stability))


def _text(answer: PlanAnswer, *, stability: bool) -> Iterator[RenderableType]:
    from comity.report.plans.plan import plan_text
    from comity.report.plans.plan_diff import diff_text
    from comity.report.plans.plan_stability import stability_text
    from comity.report.plans.plan_why import why_text

    yield from why_text(answer.why) if answer.why else plan_text(answer)
    if answer.diff:
        yield from diff_text(answer.diff)
    if stability:
        yield from stability_text(answer.stability)
