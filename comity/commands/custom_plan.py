"""`comity plan --domain`: the plan for a domain of the user's own, and what is asked about it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from comity.commands.options import print_json
from comity_fis.errors import InputError, Where

if TYPE_CHECKING:
    from collections.abc import Iterator
    from datetime import date

    from rich.console import RenderableType

    from comity.answers.plan import PlanAnswer
    from comity.custom_domain import Others
    from comity_domain import PlanningFailed
    from comity_domain.custom import Bound, CustomPlan, PlanningClock

LEAST_S, MOST_S = 0.1, 86_400.0


@dataclass(frozen=True, slots=True, kw_only=True)
class CustomQuestion:
    """What is planned, and what is asked about it."""

    domain: Path | None
    problem: Path | None
    binding: Path | None
    profiles: Mapping[str, str]
    rulebook: str | None
    at: date | None
    why: str | None
    diff: bool
    stability: bool
    pddl: Path | None
    limit_s: float
    engine: str
    as_json: bool

    @property
    def others(self) -> Others:
        """What is other than the binding has it."""
        from comity.custom_domain import Others

        return Others(self.profiles, self.rulebook, self.at)


def refuse_beside_domain(option: str, scenario: str | None, seed: int, *, validates: bool) -> None:
    """Refuse what means nothing for a domain of the user's own.

    Args:
        option: The one that says that it is about such a domain.
        scenario: What is named beside it.
        seed: Likewise.
        validates: Whether `--validate` is asked for.

    Raises:
        InputError: for the first option that was given.
    """
    if scenario is not None:
        remedy = "Leave one of them out: the PDDL problem says what a scenario says."
        raise _refused("SCENARIO", f"either a scenario or {option}", "both", remedy)
    if seed:
        remedy = "Leave it out: nothing in PDDL is left to chance."
        raise _refused("--seed", "a seed only with a scenario", f"one beside {option}", remedy)
    if validates:
        remedy = "Leave it out: only the plan of a scenario is validated."
        raise _refused("--validate", "--validate only with a scenario", f"it beside {option}", remedy)


def plan_custom_domain(ask: CustomQuestion) -> None:
    """Plan PDDL files, bound to people where there is a binding.

    Raises:
        InputError: if anything given cannot be used.
        PlanningFailed: if no plan is found, and no JSON is asked for.
        typer.Exit: with 1, where JSON is.
    """
    from comity.commands.progress import waiting
    from comity.report.custom_domain.plan import no_custom_plan_answer
    from comity.report.text import show
    from comity_domain import PlanningFailed
    from comity_domain.custom import PlanningClock, in_one_process

    _files(ask)
    plans = 1 + (ask.why is not None) + ask.diff + ask.stability
    try:
        with waiting(f"searching for a plan, {ask.limit_s:g} s at most", quiet=ask.as_json):
            call = partial(answered, ask, PlanningClock(ask.limit_s))
            answer = in_one_process(call, limit_s=ask.limit_s, plans=plans)
    except PlanningFailed as ended:
        answer = no_custom_plan_answer(None, _with_limit(ended, ask.limit_s), renamed={}, files=())
    if ask.as_json:
        print_json(answer)
    if answer.failure is not None:
        if ask.as_json:
            raise typer.Exit(1)
        raise PlanningFailed(
            answer.failure.reason, remedy=answer.failure.remedy, cut_off=not answer.reproducible
        )
    if not ask.as_json:
        show(*_text(ask, answer))


def answered(ask: CustomQuestion, clock: PlanningClock) -> PlanAnswer:
    """All that is asked, in this process: for `in_one_process`.

    Args:
        ask: It.
        clock: Of the first plan; it goes since before this process began.

    Raises:
        InputError: if anything given cannot be used.
    """
    from comity.custom_domain import AS_WRITTEN, bound_domain
    from comity.report.custom_domain.plan import custom_plan_answer, no_custom_plan_answer
    from comity_domain import PlanningFailed
    from comity_domain.custom import PlanningClock, planned

    domain, problem = _files(ask)
    bound = _by_engine(ask, bound_domain(domain, problem, ask.binding, ask.others))
    _refuse_unanswerable(ask, bound)
    renamed, files = _exported(ask, bound)
    try:
        found = planned(bound, clock)
        written = before = None
        if ask.diff:
            again = PlanningClock(ask.limit_s)
            written = _by_engine(ask, bound_domain(domain, problem, ask.binding, AS_WRITTEN))
            before = planned(written, again)
        answer = custom_plan_answer(bound, found, renamed=renamed, files=files)
        return replace(answer, **_more(ask, answer, (bound, found), (written, before)))
    except PlanningFailed as failed:
        return no_custom_plan_answer(bound, _with_limit(failed, ask.limit_s), renamed=renamed, files=files)


def _by_engine(ask: CustomQuestion, bound: Bound) -> Bound:
    """To be planned by the engine that is asked for; `comity` means that one that fits is taken."""
    from comity_domain import ENGINE

    return bound if ask.engine == ENGINE else replace(bound, engine=ask.engine)


def _with_limit(failed: PlanningFailed, limit_s: float) -> PlanningFailed:
    """The same with the option that gives more time, where a limit ended the search."""
    from comity_domain import PlanningFailed

    if not failed.cut_off:
        return failed
    more = f"For more time, add `--limit {min(4 * limit_s, MOST_S):g}`: it is {limit_s:g} now, in seconds."
    return PlanningFailed(failed.reason, remedy=f"{failed.remedy} {more}", cut_off=True)


def _files(ask: CustomQuestion) -> tuple[Path, Path]:
    if ask.domain is None or ask.problem is None:
        missing = "--domain" if ask.domain is None else "--problem"
        raise _refused(missing, "a PDDL file", "nothing", f"Add {missing} FILE.pddl.")
    if not LEAST_S <= ask.limit_s <= MOST_S:
        seconds = f"from {LEAST_S:g} to {MOST_S:g} seconds"
        raise _refused("--limit", seconds, f"{ask.limit_s:g}", "Give a number of seconds in this range.")
    others = {"--as": ask.others.profiles, "--rulebook": ask.others.rulebook, "--at": ask.others.at}
    for option, given in others.items():
        if given and ask.binding is None:
            _refuse_unbound(option, "nobody in PDDL has a profile")
    if ask.diff and not any(others.values()):
        remedy = "Add --as OBJECT=PROFILE, --rulebook R or --at DATE."
        raise _refused("--diff", "something that differs", "the binding as it is written", remedy)
    if ask.stability and ask.binding is None:
        _refuse_unbound("--stability", "costs of PDDL have no weights")
    return ask.domain, ask.problem


def _refuse_unbound(option: str, reason: str) -> None:
    remedy = f"Add --bind FILE.yaml: without a binding, {reason}."
    raise _refused(option, "a binding", "none", remedy)


def _refuse_unanswerable(ask: CustomQuestion, bound: Bound) -> None:
    """Weights are followed through costs, which engines beyond classical planning do not add up."""
    if ask.stability and not bound.classical:
        remedy = "Leave it out: options, and so weights, work in classical domains only."
        raise _refused("--stability", "a classical domain", "a numeric or durative one", remedy)
    if ask.stability and not any(one.options for one in bound.binding.actions.values()):
        remedy = "Leave it out, or bind an option: only its weight could be followed."
        raise _refused("--stability", "a binding with options", "none", remedy)


def _exported(ask: CustomQuestion, bound: Bound) -> tuple[Mapping[str, str], tuple[str, ...]]:
    """The names that could not stay, and the files that were written."""
    from comity.output.pddl_files import DOMAIN, PROBLEM, write_texts
    from comity_domain.custom import custom_pddl

    if ask.pddl is None:
        return {}, ()
    texts = custom_pddl(bound)
    write_texts(texts.domain, texts.problem, ask.pddl)
    return texts.renamed, (str(ask.pddl / DOMAIN), str(ask.pddl / PROBLEM))


def _more(
    ask: CustomQuestion,
    answer: PlanAnswer,
    now: tuple[Bound, CustomPlan],
    before: tuple[Bound | None, CustomPlan | None],
) -> dict[str, Any]:
    """What else was asked about a plan."""
    from comity.report.custom_domain.plan_diff import custom_diff
    from comity.report.custom_domain.plan_stability import custom_stability
    from comity.report.custom_domain.plan_why import custom_step_why

    bound, found = now
    written, was = before
    return {
        "why": custom_step_why(answer, bound, found, ask.why, ask.limit_s) if ask.why is not None else None,
        "diff": custom_diff((written, was), now) if written and was else None,
        "stability": custom_stability(bound, found, ask.limit_s) if ask.stability else None,
    }


def _text(ask: CustomQuestion, answer: PlanAnswer) -> Iterator[RenderableType]:
    from comity.report.custom_domain.plan import custom_plan_text
    from comity.report.custom_domain.plan_stability import custom_stability_text
    from comity.report.custom_domain.plan_why import custom_why_text
    from comity.report.plans.plan_diff import diff_text

    yield from custom_why_text(answer.why) if answer.why else custom_plan_text(answer)
    if answer.diff:
        yield from diff_text(answer.diff, against="the binding as it is written", plain=True)
    if ask.stability and answer.stability:
        yield from custom_stability_text(answer.stability)


def _refused(option: str, expected: str, got: str, remedy: str) -> InputError:
    return InputError(expected=expected, got=got, remedy=remedy, where=Where(option))
