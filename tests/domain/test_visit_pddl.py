"""The readable PDDL file is the domain that is planned with, and the code keeps to its words."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest
from downward import needs_fast_downward
from unified_planning.environment import get_environment
from unified_planning.io import PDDLReader
from unified_planning.shortcuts import OneshotPlanner

from comity_domain import make_plan, plan_pddl, steps
from comity_domain.choices.options import options
from comity_domain.classical.initial_state import goals, initial_state, visit_names
from comity_domain.classical.naming import RESERVED
from comity_domain.classical.pddl import domain_pddl, problem_pddl


@pytest.fixture(scope="module")
def domain():
    problem = """(define (problem any) (:domain visit-domain)
        (:init (= (total-cost) 0)) (:goal (and)) (:metric minimize (total-cost)))"""
    # unified-planning 1.3 reads costs in its global environment only
    return PDDLReader(get_environment()).parse_problem_string(domain_pddl(), problem)


def below(problem, name: str) -> set[str]:
    """A type with all types above it."""
    above = problem.user_type(name).father
    return {name} | (below(problem, above.name) if above else set())


def test_no_object_may_be_called_like_a_word_of_the_domain(domain):
    """Types, fluents and actions of the file are all reserved, and the list names no others of the kind."""
    words = {
        *(t.name for t in domain.user_types),
        *(f.name for f in domain.fluents),
        *(a.name.lower() for a in domain.actions),
    }
    syntax = set(re.findall(r"[a-z]+", "and or not imply exists forall when either object number visit"))
    syntax |= set(re.findall(r"[a-z]+", "define domain problem increase decrease assign minimize maximize"))
    assert words == RESERVED - syntax


@pytest.mark.parametrize("seed", range(4))
def test_every_fact_and_goal_fits_a_fluent_of_the_file(domain, agenda_request, seed):
    """Name, number and types of the arguments, and whether it is a number: integers, and never negative."""
    choices = options(agenda_request(4, seed))
    for fact in (*initial_state(choices), *goals(choices)):
        fluent = domain.fluent(fact.fluent)
        assert len(fluent.signature) == len(fact.arguments)
        for parameter, word in zip(fluent.signature, fact.arguments, strict=True):
            assert parameter.type.name in below(domain, word.kind)
        assert fluent.type.is_bool_type() == (fact.value is True)
        assert fact.value is True or (type(fact.value) is int and fact.value >= 0)


def test_every_action_of_the_file_is_a_step_that_plans_have(domain):
    """And the other way round; nobody is left out by an action, as that is decided before."""
    named = {value for name, value in vars(steps).items() if name.isupper() and isinstance(value, str)}
    assert {action.name for action in domain.actions} == {name.lower() for name in named}


@pytest.mark.parametrize("seed", range(3))
def test_unified_planning_reads_the_problem_as_it_is_meant(agenda_request, seed):
    choices = options(agenda_request(3, seed))
    text = problem_pddl(choices, visit_names(choices))
    problem = PDDLReader(get_environment()).parse_problem_string(domain_pddl(), text)
    assert len(problem.goals[0].args if problem.goals[0].is_and() else problem.goals) == len(
        list(goals(choices))
    )
    assert len(problem.explicit_initial_values) >= len(set(initial_state(choices)))


def forms(text: str) -> list:
    """Nested lists of words."""
    stack: list[list] = [[]]
    for word in re.findall(r"[()]|[^\s()]+", re.sub(r";.*", "", text)):
        if word == ")":
            done = stack.pop()
            stack[-1].append(done)
        else:
            stack.append([]) if word == "(" else stack[-1].append(word)
    return stack[0][0]


def inside(form, head: str):
    """The parts of a form that begin with a word, however deep."""
    for part in form:
        if isinstance(part, list):
            yield from ([part] if part[:1] == [head] else [])
            yield from inside(part, head)


def test_no_effect_on_a_condition_holds_another_or_one_for_all():
    """PDDL 2.1 has none inside, and unified-planning's reader forgets the outer condition of such."""
    effects = [effect for _, _, effect in inside(forms(domain_pddl()), "when")]
    literals = [part for one in effects for part in (one[1:] if one[0] == "and" else [one])]
    heads = {(part[1] if part[0] == "not" else part)[0] for part in literals}
    assert heads
    assert not heads & {"and", "when", "forall"}


def under_way(request):
    """The same with a greeting that is over wherever something else is to be done."""
    visitees = tuple(replace(each, greeted=bool(each.agenda)) for each in request.visitees)
    return replace(request, visitees=visitees, companies=())


def without_deadlines(request):
    """PDDL knows none."""
    return replace(request, visitees=tuple(replace(each, by_s=None) for each in request.visitees))


@needs_fast_downward
@pytest.mark.parametrize("kind", ["agendas", "agendas under way", "companies and priorities"])
@pytest.mark.parametrize("seed", [4, 5])
def test_another_reader_and_planner_find_the_same_cost_on_what_is_exported(
    agenda_request, rich_request, kind, seed
):
    request = (rich_request if kind.startswith("companies") else agenda_request)(2 + seed % 2, seed)
    request = without_deadlines(under_way(request) if kind.endswith("way") else request)
    plan = make_plan(request)
    assert plan.optimal
    get_environment().credits_stream = None
    problem = PDDLReader(get_environment()).parse_problem_string(*plan_pddl(request))
    with OneshotPlanner(name="fast-downward-opt") as planner:
        found = planner.solve(problem).plan
    (metric,) = problem.quality_metrics
    assert sum(price(action, metric, problem) for action in found.actions) == plan.cost


def price(step, metric, problem) -> int:
    """What an action costs, with the step's arguments for the action's parameters."""
    cost = metric.get_action_cost(step.action)
    if cost is None or cost.is_constant():
        return 0 if cost is None else cost.constant_value()
    given = dict(zip((one.name for one in step.action.parameters), step.actual_parameters, strict=True))
    arguments = [given[argument.parameter().name] for argument in cost.args]
    return problem.initial_value(cost.fluent()(*arguments)).constant_value()


def test_the_exported_problem_says_who_is_who(infer, request_for):
    _, problem = plan_pddl(request_for({"Zoë\n": infer()}))
    assert "; zoe: the user 'Zo\\xeb\\n'\n" in problem
    assert "(= (distance_mm zoe) 640)" in problem
    assert problem.isascii()
