"""unified-planning's own validator accepts every plan on the exported PDDL, and counts the same cost."""

from __future__ import annotations

import pytest
from unified_planning.engines import SequentialPlanValidator, ValidationResultStatus
from unified_planning.environment import get_environment
from unified_planning.io import PDDLReader
from unified_planning.plans import ActionInstance, SequentialPlan

from comity_domain import PlanningFailed, make_plan, plan_pddl
from comity_domain.naming import Word
from comity_domain.options import options
from comity_domain.visit_problem import visit_names


def as_actions(plan, problem, names):
    """The steps as unified-planning has them, with the turns that people never see."""
    turns = [word for word in names.words.values() if word.kind == "turn"]
    greeted = 0
    for step in plan.steps:
        words = [Word("robot", step.arguments[0]), Word("user", step.person)]
        if step.action == "Reach_user":
            place, side = step.origin
            words += [Word("side", step.arguments[2])]
            words += [
                Word("place" if place == "start" and side == "here" else "user", place),
                Word("side", side),
            ]
        else:
            *_, modality, gesture = step.arguments
            if step.action == "Greet_company":
                spot_side = next(s.arguments[2] for s in plan.steps if s.person == step.person)
                words = [words[0], Word("company", step.arguments[2]), words[1], Word("side", spot_side)]
            now, greeted = greeted, greeted + len(step.people)
            turn = [turns[min(i, len(turns) - 1)] for i in (now, greeted)]
            words += [Word("modality", modality), Word("gesture", gesture), *turn]
        objects = [problem.object(names.ids[word]) for word in words]
        yield ActionInstance(
            problem.action(step.action.lower()),
            [problem.environment.expression_manager.ObjectExp(o) for o in objects],
        )


@pytest.mark.parametrize("seed", range(6))
def test_a_plan_is_valid_and_costs_what_it_says(rich_request, seed):
    request = rich_request(2 + seed % 4, seed)
    try:
        plan = make_plan(request)
    except PlanningFailed:
        pytest.skip("its deadlines allow no plan")
    # unified-planning 1.3 grounds actions in its global environment only
    problem = PDDLReader(get_environment()).parse_problem_string(*plan_pddl(request))
    written = SequentialPlan(list(as_actions(plan, problem, visit_names(options(request)))))
    validator = SequentialPlanValidator()
    validator.skip_checks = True  # costs of what nobody can do stay undefined, as PDDL allows
    result = validator.validate(problem, written)
    assert result.status is ValidationResultStatus.VALID, result
    (metric,) = problem.quality_metrics
    assert sum(price(action, metric, problem) for action in written.actions) == plan.cost


def price(step, metric, problem):
    """The cost fluent of an action, with the step's arguments for the action's parameters."""
    cost = metric.get_action_cost(step.action)
    given = dict(zip((p.name for p in step.action.parameters), step.actual_parameters, strict=True))
    arguments = [given[argument.parameter().name] for argument in cost.args]
    return problem.initial_value(cost.fluent()(*arguments)).constant_value()
