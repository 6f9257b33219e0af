"""Plans a bound problem; the steps carry people's parameters, costs and reasons."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from comity_domain.custom.binding.binding import ActionBinding
from comity_domain.custom.solving.bound import Bound
from comity_domain.custom.solving.choosing import FAST_DOWNWARD, require_able
from comity_domain.custom.solving.engines import solve
from comity_domain.custom.solving.hindrances import ALL_S, no_plan
from comity_domain.custom.solving.reason import why
from comity_domain.custom.solving.solution import GroundAction, Solution
from comity_domain.custom.solving.swap import argument_of, row_of
from comity_domain.errors import NoEngine, NoPlan, PlanningFailed, require_time_limit
from comity_domain.plans.plan import Plan, PlanStep, StepExplanation


@dataclass(frozen=True, slots=True)
class CustomPlan:
    """A plan in a custom domain."""

    plan: Plan
    """The plan; costs are in planner units: divide by `Bound.cost_scale`."""
    tells_costs: bool
    """Whether costs are known; if not, the engine did not add them up and the plan's costs are 0."""
    metric_ignored: bool
    """Whether the engine ignored the problem's metric; another plan may then be better."""
    actions: tuple[GroundAction, ...]
    """The steps as ground actions of the planning problem, with their times."""
    whose: tuple[str | None, ...]
    """The person whose preferences are bound to each step, or None."""

    def changes(self, other: CustomPlan) -> tuple[tuple[str, ...], tuple[str, ...]]:
        """Steps only in this plan, and steps only in the other one."""
        were, are = (
            Counter(f"{step.action}({', '.join(step.arguments)})" for step in one.plan.steps)
            for one in (self, other)
        )
        return tuple((were - are).elements()), tuple((are - were).elements())


def plan_custom(bound: Bound, *, time_limit_s: float = 30.0, diagnose: bool = True) -> CustomPlan:
    """The cheapest plan for a classical domain; otherwise the plan that an installed engine finds.

    Args:
        bound: The problem.
        time_limit_s: Wall-clock time for the engine [s], > 0.
        diagnose: Whether to diagnose why there is no plan; not done if the engine is given by name.

    Raises:
        NoPlan: There is no plan; a diagnosis names the failing goal and the condition that prevents it.
        PlanningFailed: None was found within the limits, or no installed engine supports the problem.
    """
    require_time_limit(time_limit_s)
    try:
        solution = _solved(bound, time_limit_s)
    except NoPlan as failed:
        if not diagnose:
            raise
        raise diagnosed(bound, failed) from None
    steps = tuple(_steps(solution.actions, bound))
    cost = sum(step.cost for step in steps)
    proven = solution.finished or (bound.classical and cost <= solution.bound)
    plan = Plan(
        solution.engine,
        optimal=proven,
        reproducible=solution.finished or not steps,
        cost=cost,
        bound=cost if proven else min(cost, solution.bound),
        steps=steps,
        killed=solution.killed,
    )
    return CustomPlan(
        plan,
        bound.classical,
        solution.metric_ignored,
        solution.actions,
        tuple(_whose(action, bound) for action in solution.actions),
    )


def diagnosed(bound: Bound, failed: PlanningFailed, *, patience_s: float = ALL_S) -> PlanningFailed:
    """The failure with a diagnosis added, if it is proven that there is no plan.

    Args:
        bound: The problem; if its engine is given by name, no other one is used.
        failed: The failure.
        patience_s: Wall-clock time for the diagnosis [s], > 0.
    """
    if bound.engine is not None or not isinstance(failed, NoPlan):
        return failed
    return no_plan(bound, patience_s=patience_s)


def _solved(bound: Bound, time_limit_s: float) -> Solution:
    engine = bound.engine or (FAST_DOWNWARD if bound.classical else None)
    try:
        if bound.engine is not None:
            require_able(bound.engine, bound.problem, classical=bound.classical)
        return solve(bound.problem, engine=engine, time_limit_s=time_limit_s)
    except NoEngine as refusal:
        where = f" ({bound.own.places.of(bound.beyond.part)})" if bound.beyond else ""
        raise NoEngine(f"{refusal.reason}{where}", remedy=refusal.remedy) from None


def _steps(actions: Sequence[GroundAction], bound: Bound) -> Iterator[PlanStep]:
    for index, action in enumerate(actions):
        row = row_of(action, bound) if bound.classical else None
        binding = bound.binding.of(action.name)
        yield PlanStep(
            action=bound.own.as_written(action.name),
            arguments=tuple(map(bound.own.as_written, action.arguments)),
            origin=None,
            parameters=_parameters(action, binding, bound) if binding else {},
            cost=row.cost if row else 0,
            why=why(index, actions, binding, bound) if binding else NOT_BOUND,
            cost_parts=row.parts() if row else {},
        )


NOT_BOUND = StepExplanation("no preference of anybody is bound to this action", ())


def _parameters(action: GroundAction, binding: ActionBinding, bound: Bound) -> dict[str, float | str]:
    """Parameters that the step carries: inferred values, and for a category the chosen one."""
    assert bound.people is not None
    person = bound.people[_person(action, binding, bound)]
    row = row_of(action, bound) if bound.classical else None
    found = {name: person[name].value for name in binding.parameters}
    for argument, option in binding.options.items():
        chosen = row.preferences[argument.lower()].value if row else None
        if isinstance(chosen, str):
            found[option.parameter] = chosen
    return found


def _person(action: GroundAction, binding: ActionBinding, bound: Bound) -> str:
    return bound.own.as_written(argument_of(action, binding.person.lower(), bound))


def _whose(action: GroundAction, bound: Bound) -> str | None:
    binding = bound.binding.of(action.name)
    return _person(action, binding, bound) if binding else None
