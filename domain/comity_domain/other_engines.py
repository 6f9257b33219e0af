"""Visits planned by another engine of unified-planning: the same steps, parameters and reasons.

The engine gets the problem of `problem_of`, in a process of its own that is ended at the limit.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING

from comity_domain.choices.options import Options, options
from comity_domain.classical.initial_state import visit_names
from comity_domain.classical.naming import PddlNames
from comity_domain.classical.problem import problem_with
from comity_domain.classical.tour_of import tour_of
from comity_domain.errors import NoPlan, PlanningFailed
from comity_domain.labelling.skipping import left_out, skip_steps
from comity_domain.ordering.best_order import best_order
from comity_domain.planner import ENGINE, make_plan
from comity_domain.problem.measuring import fully_measured
from comity_domain.problem.request import VisitRequest
from comity_domain.steps import steps_of
from comity_domain.tours.bound import lower_bound
from comity_domain.tours.tour import PlannedVisit, best_tour, tour_cost
from comity_domain.visit_plan import VisitPlan
from comity_fis.errors import InputError, Where

if TYPE_CHECKING:
    from comity_domain.custom.solving.solution import Solution


def plan_with(engine: str, request: VisitRequest, *, time_limit_s: float = 30.0) -> VisitPlan:
    """A plan by any engine that is installed.

    Args:
        engine: `comity`, or its name in unified-planning, such as `fast-downward-opt`. Engines that do not
            look at costs find some plan; `gap` says how much a better one could save.
        request: As for `make_plan`; who is left out at a price is decided as there.
        time_limit_s: Wall-clock seconds for the engine, > 0.

    Raises:
        InputError: The engine is not installed, or a person has a deadline: no classical engine keeps one.
        NoPlan: There is none.
        PlanningFailed: None was found within the limit, or the engine broke.
    """
    if engine == ENGINE:
        return make_plan(request, time_limit_s=time_limit_s)
    from comity_domain.custom.solving.choosing import require_installed

    require_installed(engine)
    _require_all_said(engine, request)
    left = left_out(request)
    choices = options(fully_measured(request.dropping(left)))
    names = visit_names(choices)
    found = _found(engine, choices, names, time_limit_s)
    visits = _tied(tour_of(((one.name, one.arguments) for one in found.actions), choices, names), choices)
    skipped = skip_steps(request, left)
    steps = (*steps_of(visits, choices, choices), *skipped)
    cost = sum(step.cost for step in steps)
    least = lower_bound(choices) + sum(step.cost for step in skipped)
    bound = cost if found.finished else min(cost, least)
    return VisitPlan(
        engine,
        optimal=bound == cost,
        reproducible=found.finished,
        cost=cost,
        bound=bound,
        steps=steps,
        request=request,
    )


def _found(engine: str, choices: Options, names: PddlNames, time_limit_s: float) -> Solution:
    from comity_domain.custom.process import in_one_process

    try:
        return in_one_process(partial(_solved, engine, choices, names, time_limit_s), limit_s=time_limit_s)
    except NoPlan:
        best_order(choices, time_limit_s)  # raises where there is none
        raise PlanningFailed(
            f"{engine} says that there is no plan, and there is one: it does not read the visit domain right",
            remedy=f"Plan with another engine, such as {ENGINE} or fast-downward-opt.",
        ) from None


def _solved(engine: str, choices: Options, names: PddlNames, time_limit_s: float) -> Solution:
    from comity_domain.custom.solving.engines import solve

    return solve(problem_with(choices, names), engine=engine, time_limit_s=time_limit_s)


def _tied(visits: Sequence[PlannedVisit], choices: Options) -> Sequence[PlannedVisit]:
    """Where the engine took one of several choices that cost the same, the one that ties go to."""
    ours = best_tour([visit.stop for visit in visits], choices)
    return ours if tour_cost(ours, choices) == tour_cost(visits, choices) else visits


def _require_all_said(engine: str, request: VisitRequest) -> None:
    for visitee in request.visitees:
        if visitee.by_s is not None:
            raise InputError(
                expected=f"a scenario without deadlines for {engine}: the problem has none",
                got=f"by_s: {visitee.by_s} of {visitee.name}",
                remedy=f"Leave it out, or plan with {ENGINE}.",
                where=Where("--engine"),
            )
