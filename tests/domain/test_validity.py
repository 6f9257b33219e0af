"""unified-planning's own validator accepts every plan, on our problem and on the file, at the same cost."""

from __future__ import annotations

import pytest
from unified_planning.engines import SequentialPlanValidator, ValidationResultStatus
from unified_planning.environment import get_environment
from unified_planning.io import PDDLReader
from unified_planning.plans import ActionInstance, SequentialPlan

from comity_domain import PlanningFailed, make_plan, plan_pddl


def price(step, problem):
    """What an action costs, with the step's arguments for the action's parameters."""
    (metric,) = problem.quality_metrics
    cost = metric.get_action_cost(step.action)
    if cost is None or cost.is_constant():
        return 0 if cost is None else cost.constant_value()
    given = dict(zip((p.name for p in step.action.parameters), step.actual_parameters, strict=True))
    arguments = [given[argument.parameter().name] for argument in cost.args]
    return problem.initial_value(cost.fluent()(*arguments)).constant_value()


def read_again(plan, request):
    """The same plan for the problem that unified-planning reads from the exported PDDL."""
    problem = PDDLReader(get_environment()).parse_problem_string(*plan_pddl(request))
    make = problem.environment.expression_manager.ObjectExp
    return problem, SequentialPlan(
        [
            ActionInstance(
                problem.action(one.action.name.lower()),
                [make(problem.object(argument.object().name)) for argument in one.actual_parameters],
            )
            for one in plan.actions
        ]
    )


def check(request):
    try:
        plan = make_plan(request)
    except PlanningFailed:
        pytest.skip("its deadlines allow no plan")
    problem, actions = plan.to_unified_planning()
    for stated, written in ((problem, actions), read_again(actions, request)):
        validator = SequentialPlanValidator()
        validator.skip_checks = True  # costs of what nobody can do stay undefined in the file
        result = validator.validate(stated, written)
        assert result.status is ValidationResultStatus.VALID, result
        assert sum(price(action, stated) for action in written.actions) == plan.cost


@pytest.mark.parametrize("seed", range(6))
def test_a_plan_is_valid_and_costs_what_it_says(rich_request, seed):
    check(rich_request(2 + seed % 4, seed))


@pytest.mark.parametrize("seed", range(6))
def test_so_is_a_plan_with_things_to_say_and_to_bring(agenda_request, seed):
    check(agenda_request(2 + seed % 3, seed, deadlines=seed % 2 == 1))
