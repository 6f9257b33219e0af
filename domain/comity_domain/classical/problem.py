"""A request as a unified-planning problem, and a plan as a unified-planning plan."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from comity_domain.choices.options import Options, options
from comity_domain.classical.grounding import grounded
from comity_domain.classical.initial_state import Fact, goals, initial_state, visit_names
from comity_domain.classical.naming import PddlNames
from comity_domain.explanation.what_if import visits_of
from comity_domain.labelling.skipping import dropped_by, left_out
from comity_domain.plans.plan import Plan
from comity_domain.problem.measuring import fully_measured
from comity_domain.problem.request import VisitRequest
from comity_domain.tours.tour import PlannedVisit

if TYPE_CHECKING:
    from unified_planning.environment import Environment
    from unified_planning.model import Problem
    from unified_planning.plans import SequentialPlan


def problem_of(request: VisitRequest, environment: Environment | None = None) -> Problem:
    """A request as a problem for unified-planning's engines, compilers and validator.

    Which visits are dropped was decided before: for those people the goal is `skipped`, at the cost of
    dropping. Deadlines are not part of the problem, so its optimum may cost less than the plan.

    Args:
        request: The planning request; its unmeasured routes are measured.
        environment: The environment of its parts. None takes unified-planning's global one, which loads all
            engines; it is the only one in which release 1.3 grounds actions, as its validator does. For
            `solve`, a `classical.light_environment.LightEnvironment()` suffices.

    Raises:
        ValueError: The request includes a person whom no plan can serve.
    """
    choices = _choices(request.dropping(left_out(request)))
    return problem_with(choices, visit_names(choices), environment)


def to_unified_planning(plan: Plan, request: VisitRequest) -> tuple[Problem, SequentialPlan]:
    """The problem and a unified-planning plan for it, as its validator takes them.

    Args:
        plan: A plan for the request.
        request: The planning request.
    """
    choices = _choices(request.dropping(dropped_by(plan)))
    names = visit_names(choices)
    problem = problem_with(choices, names)
    return problem, sequential_plan(problem, visits_of(plan), choices, names)


def sequential_plan(
    problem: Problem, visits: Sequence[PlannedVisit], choices: Options, names: PddlNames
) -> SequentialPlan:
    """A tour as a plan for the problem that states its options."""
    from unified_planning.plans import ActionInstance, SequentialPlan

    make = problem.environment.expression_manager.ObjectExp
    actions = [
        ActionInstance(problem.action(name), [make(problem.object(names.ids[word])) for word in words])
        for name, words in grounded(visits, choices)
    ]
    return SequentialPlan(actions, problem.environment)


def _choices(request: VisitRequest) -> Options:
    """All options of a request, with measured routes."""
    return options(fully_measured(request))


def problem_with(choices: Options, names: PddlNames, environment: Environment | None = None) -> Problem:
    """The problem that states the given options.

    Args:
        choices: The available options.
        names: Their PDDL names.
        environment: The environment of its parts; None: unified-planning's global one.
    """
    from unified_planning.model import Object

    from comity_domain.classical.visit_domain import empty_problem

    problem = empty_problem("visit", environment)
    for id_, word in names.words.items():
        problem.add_object(Object(id_, problem.user_type(word.kind), problem.environment))
    for fact in initial_state(choices):
        problem.set_initial_value(_atom(problem, fact, names), fact.value)
    for goal in goals(choices):
        problem.add_goal(_atom(problem, goal, names))
    return problem


def _atom(problem: Problem, fact: Fact, names: PddlNames) -> Any:
    return problem.fluent(fact.fluent)(*(problem.object(names.ids[word]) for word in fact.arguments))
