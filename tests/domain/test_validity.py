"""unified-planning's own validator accepts every plan on the exported PDDL, and counts the same cost."""

from __future__ import annotations

import pytest
from unified_planning.engines import SequentialPlanValidator, ValidationResultStatus
from unified_planning.environment import get_environment
from unified_planning.io import PDDLReader
from unified_planning.plans import ActionInstance, SequentialPlan

from comity_domain import PlanningFailed, make_plan, plan_pddl
from comity_domain.choices.options import options
from comity_domain.classical.initial_state import NOTHING, brought, tasks, visit_names
from comity_domain.classical.naming import Word


class Grounding:
    """The steps as unified-planning has them, with the turns, things and tasks that people never see."""

    def __init__(self, plan, problem, choices):
        self.plan, self.problem, self.choices, self.names = plan, problem, choices, visit_names(choices)
        self.turns = [word for word in self.names.words.values() if word.kind == "turn"]
        self.holds, self.greeted, self.side = NOTHING, 0, ""
        self.due = {person.name: list(tasks(person)) for person in choices.people.values()}
        self.things = {task: thing for person in choices.people.values() for task, thing in brought(person)}

    def actions(self):
        for step in self.plan.steps:
            words = [Word("robot", step.arguments[0]), *self.words(step)]
            objects = [self.problem.object(self.names.ids[word]) for word in words]
            expression = self.problem.environment.expression_manager.ObjectExp
            action = self.problem.action(step.action.lower())
            yield ActionInstance(action, [expression(each) for each in objects])

    def words(self, step):  # noqa: PLR0911  (one for each action)
        user = Word("user", step.person)
        match step.action:
            case "Reach_user":
                self.side = step.arguments[2]
                return [user, Word("side", self.side), *self.spot(*step.origin), self.holds]
            case "Return_to_user":
                task = self.due[step.person][0]
                return [user, Word("side", step.arguments[2]), task, self.holds, *self.spot(*step.origin)]
            case "Fetch":
                task = next(task for task in self.due[step.person] if task in self.things)
                self.holds = self.things[task]
                there = self.spot(step.arguments[3], "there")
                return [user, task, self.holds, *there, *self.spot(*step.origin), NOTHING]
            case "Greet_person":
                return [user, *self.way(step), *self.turn(1), self.holds]
            case "Greet_company":
                company = Word("company", step.arguments[2])
                return [company, user, Word("side", self.side), *self.way(step), *self.turn(len(step.people))]
        task = self.due[step.person].pop(0)
        held, self.holds = self.holds, NOTHING
        if step.action == "Offer":
            return [user, task, held, NOTHING]
        self.holds = held
        return [user, task, *([*self.way(step), held] if step.action == "Take_leave" else [])]

    def spot(self, place, side):
        kind = "place" if (place, side) == ("start", "here") else "location" if side == "there" else "user"
        return [Word(kind, place), Word("side", side)]

    def way(self, step):
        return [Word("modality", step.arguments[-2]), Word("gesture", step.arguments[-1])]

    def turn(self, people):
        now, self.greeted = self.greeted, self.greeted + people
        return [self.turns[min(i, len(self.turns) - 1)] for i in (now, self.greeted)]


def check(request):
    try:
        plan = make_plan(request)
    except PlanningFailed:
        pytest.skip("its deadlines allow no plan")
    # unified-planning 1.3 grounds actions in its global environment only
    problem = PDDLReader(get_environment()).parse_problem_string(*plan_pddl(request))
    written = SequentialPlan(list(Grounding(plan, problem, options(request)).actions()))
    validator = SequentialPlanValidator()
    validator.skip_checks = True  # costs of what nobody can do stay undefined, as PDDL allows
    result = validator.validate(problem, written)
    assert result.status is ValidationResultStatus.VALID, result
    (metric,) = problem.quality_metrics
    assert sum(price(action, metric, problem) for action in written.actions) == plan.cost


@pytest.mark.parametrize("seed", range(6))
def test_a_plan_is_valid_and_costs_what_it_says(rich_request, seed):
    check(rich_request(2 + seed % 4, seed))


@pytest.mark.parametrize("seed", range(6))
def test_so_is_a_plan_with_things_to_say_and_to_bring(agenda_request, seed):
    check(agenda_request(2 + seed % 3, seed, deadlines=seed % 2 == 1))


def price(step, metric, problem):
    """The cost fluent of an action, with the step's arguments for the action's parameters."""
    cost = metric.get_action_cost(step.action)
    if cost is None or cost.is_constant():
        return 0 if cost is None else cost.constant_value()
    given = dict(zip((p.name for p in step.action.parameters), step.actual_parameters, strict=True))
    arguments = [given[argument.parameter().name] for argument in cost.args]
    return problem.initial_value(cost.fluent()(*arguments)).constant_value()
