"""The exact search is an engine of unified-planning: a problem in, a plan out, and so every plan is made."""

from __future__ import annotations

import math
import subprocess
import sys
from dataclasses import replace

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from unified_planning.engines import PlanGenerationResultStatus, SequentialPlanValidator
from unified_planning.environment import Environment
from unified_planning.io import PDDLReader
from unified_planning.shortcuts import OneshotPlanner, get_environment

from comity_domain import (
    NoPlan,
    PlanningFailed,
    Timing,
    make_plan,
    plan_pddl,
    problem_of,
    solve,
    timing_of,
    validate,
)
from comity_domain.choices.options import options
from comity_domain.classical.light_environment import LightEnvironment
from comity_domain.classical.order_of import order_of
from comity_domain.engine import register
from comity_domain.labelling.skipping import left_out
from comity_domain.ordering.best_order import best_order
from comity_fis import InputError

SEEDS = range(6)


def cost(problem, plan) -> int:
    """By unified-planning's validator, which knows nothing of the search."""
    result = SequentialPlanValidator().validate(problem, plan)
    assert result, result.reason
    (metric,) = problem.quality_metrics
    return int(result.metric_evaluations[metric])


def id_of(name: str) -> str:
    """The object that stands for a person of these requests."""
    return name.replace(" ", "_")


@st.composite
def requests(draw):
    """What `made` takes: of a request the name of its fixture, its arguments, and what it has besides."""
    kind = draw(st.sampled_from(("random_request", "rich_request", "agenda_request")))
    options_of_it = {"deadlines": draw(st.booleans())} if kind != "random_request" else {}
    prices = draw(st.lists(st.none() | st.integers(0, 9), min_size=4, max_size=4))
    seed, under_way = draw(st.integers(0, 10_000)), draw(st.booleans())
    return kind, draw(st.integers(1, 4)), seed, options_of_it, under_way, prices


@pytest.fixture
def made(request, with_skips):
    """A request from the arguments that `requests` draws."""

    def make(drawn):
        kind, people, seed, more, under_way, prices = drawn
        asked = request.getfixturevalue(kind)(people, seed, **more)
        asked = with_skips(asked, {each.name: m for each, m in zip(asked.visitees, prices, strict=False)})
        if not under_way:
            return asked
        first, *others = asked.visitees
        begun = replace(first, greeted=bool(first.agenda))
        return replace(asked, visitees=(begun, *others), companies=())

    return make


@settings(max_examples=20, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(drawn=requests())
def test_the_problem_and_its_timing_say_all_that_the_search_looks_at(made, drawn):
    """Ties, deadlines and proofs included: the choices themselves would give the same order."""
    asked = made(drawn)
    choices = options(asked.dropping(left_out(asked)))
    assert outcome(order_of, choices, 30.0) == outcome(best_order, choices, 30.0)


@settings(max_examples=20, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(drawn=requests())
def test_a_problem_is_solved_by_the_plan_that_is_made_at_its_cost(made, drawn):
    asked = made(drawn)
    plan = outcome(make_plan, asked)
    if plan is NoPlan:
        with pytest.raises(PlanningFailed):
            solve(problem_of(asked), timing_of(asked))
        return
    problem, actions = plan.to_unified_planning()
    assert solve(problem_of(asked), timing_of(asked)) == actions
    assert cost(problem, actions) == plan.cost
    dropped = [step.person for step in plan.steps if step.action == "Skip_visit"]
    assert [id_of(name) for name in dropped] == [
        str(one.actual_parameters[1]) for one in actions.actions if one.action.name == "Skip_visit"
    ]


def outcome(make, *arguments):
    """What is made, or that there is none."""
    try:
        return make(*arguments)
    except PlanningFailed:
        return NoPlan


def test_planning_visits_loads_no_engine():
    """Which would take a second of computing; the parts of an environment are there all the same."""
    light, whole = LightEnvironment(), Environment()
    parts = [name for name, part in vars(Environment).items() if isinstance(part, property)]
    assert {name: type(getattr(light, name)) for name in parts if name != "credits_stream"} == {
        name: type(getattr(whole, name)) for name in parts if name != "credits_stream"
    }
    code = """
import sys
from comity.preparation import prepare
from comity.scenario import load_scenario
prepare(load_scenario("johanna"))
sys.exit(("unified_planning.model" in sys.modules) + 2 * ("unified_planning.engines" in sys.modules))
"""
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 1


def test_a_deadline_is_kept_that_the_problem_cannot_say(rich_request):
    """Where it makes the plan more expensive, the timing alone makes the difference."""
    found = 0
    for seed in range(40):
        request = rich_request(3, seed)
        problem, timing = problem_of(request), timing_of(request)
        if not timing.by_s:
            continue
        with_it, without_it = (cost(problem, solve(problem, each)) for each in (timing, Timing()))
        assert with_it == make_plan(request).cost >= without_it
        found += with_it > without_it
    assert found


def test_an_order_is_kept_that_the_problem_states(rich_request):
    request = rich_request(3, 1)
    free = [replace(each, by_s=None) for each in request.visitees]
    last = free[-1].name
    turned = replace(request, companies=(), visitees=(replace(free[0], after=last), *free[1:]))
    plan = solve(problem_of(turned))
    reached = [str(one.actual_parameters[1]) for one in plan.actions if one.action.name == "Reach_user"]
    assert reached.index(id_of(last)) < reached.index(id_of(free[0].name))
    assert cost(problem_of(turned), plan) == make_plan(turned).cost


@pytest.mark.parametrize("seed", SEEDS)
def test_the_factory_has_it_as_comity(rich_request, seed):
    register()
    request = rich_request(2, seed)
    request = replace(request, visitees=tuple(replace(each, by_s=None) for each in request.visitees))
    problem = problem_of(request)
    with OneshotPlanner(name="comity") as planner:
        assert planner.supports(problem.kind)
        result = planner.solve(problem)
    assert result.status is PlanGenerationResultStatus.SOLVED_OPTIMALLY
    assert cost(problem, result.plan) == make_plan(request).cost


def test_a_problem_that_was_written_and_read_again_is_solved(rich_request):
    request = rich_request(2, 3)
    request = replace(request, visitees=tuple(replace(each, by_s=None) for each in request.visitees))
    domain, text = plan_pddl(request)
    problem = PDDLReader(get_environment()).parse_problem_string(domain, text)
    with pytest.raises(InputError, match="the visit domain"):
        solve(problem)  # PDDL knows no capitals and keeps total-cost: it is another domain


def test_nothing_that_is_stated_is_overlooked(rich_request):
    """A cost that depends on the turn otherwise, a goal or a fact of another kind: refused, and named."""
    request = rich_request(2, 3)
    problem = problem_of(request)
    user = problem.object(id_of(request.visitees[0].name))
    changed = problem.clone()
    changed.add_goal(problem.fluent("docked")(next(problem.objects(problem.user_type("robot"))), user))
    with pytest.raises(InputError, match=r"docked"):
        solve(changed)
    changed = problem.clone()
    changed.set_initial_value(problem.fluent("begun")(user), True)
    with pytest.raises(InputError, match=r"begun"):
        solve(changed)
    changed = problem.clone()
    changed.add_object("second", problem.user_type("robot"))
    changed.set_initial_value(problem.fluent("free")(changed.object("second")), True)
    with pytest.raises(InputError, match=r"free"):
        solve(changed)


@pytest.mark.parametrize(
    ("lack", "expected"),
    [
        (
            lambda problem: problem.clear_quality_metrics(),
            "the metric MinimizeActionCosts of",
        ),
        (lambda problem: problem.action("Greet_person").clear_preconditions(), "the action Greet_person as"),
        (lambda problem: problem.clear_actions(), "the action Reach_user of the visit domain"),
        (lambda problem: problem.clear_goals(), "greeted(b) = True as goal"),
    ],
)
def test_what_a_problem_lacks_is_named_as_what_was_expected(lack, expected, rich_request):
    request = rich_request(1, 3)
    problem = problem_of(request)
    user = id_of(request.visitees[0].name)
    lack(problem)
    with pytest.raises(InputError) as refused:
        solve(problem)
    assert refused.value.expected.startswith(expected.replace("(b)", f"({user})"))


def test_what_is_no_problem_is_refused():
    with pytest.raises(InputError) as refused:
        solve("visits")
    assert (refused.value.expected, refused.value.got) == ("a Problem of unified-planning", "'visits'")


def _called(value, user):
    """With the name of the one user in the place of USER."""
    if isinstance(value, dict):
        return {_called(key, user): one for key, one in value.items()}
    if isinstance(value, tuple):
        return tuple(_called(one, user) for one in value)
    return user if value == "USER" else value


@pytest.mark.parametrize(
    ("entries", "expected"),
    [
        ({"by_s": {"nobody": 60.0}}, "a user of the problem in by_s"),
        ({"announced": frozenset(["nobody"])}, "a user of the problem in announced"),
        ({"ties": {("nobody", "left"): 1}}, "a user or group of the problem in ties"),
        ({"details": {"nothing_to_do": "word"}}, "a task of the problem in details"),
        ({"durations_s": {(None, "moon"): 1.0}}, "a place of the problem in durations_s"),
        ({"by_s": {"USER": 0.0}}, "by_s of USER in seconds, > 0"),
        ({"by_s": {"USER": math.nan}}, "by_s of USER in seconds, > 0"),
        ({"by_s": {"USER": "60"}}, "by_s of USER in seconds, > 0"),
        ({"durations_s": {(None, "USER"): -1.0}}, "durations_s of (None, 'USER') in seconds, >= 0"),
        ({"by_s": {"USER": 60.0}}, "durations_s of (None, 'USER'), as there is a deadline"),
    ],
)
def test_a_timing_that_does_not_fit_its_problem_is_refused(entries, expected, rich_request):
    request = rich_request(1, 3)
    user = id_of(request.visitees[0].name)
    timing = Timing(**{field: _called(value, user) for field, value in entries.items()})
    with pytest.raises(InputError) as refused:
        solve(problem_of(request), timing)
    assert refused.value.expected == expected.replace("USER", user)


def test_the_engine_refuses_a_problem_without_a_metric_as_the_function_does(rich_request):
    register()
    problem = problem_of(rich_request(1, 3))
    problem.clear_quality_metrics()
    with OneshotPlanner(name="comity") as planner, pytest.raises(InputError, match="MinimizeActionCosts"):
        planner.solve(problem)


def test_without_a_timing_none_is_as_good(rich_request):
    problem = problem_of(rich_request(2, 1))
    assert str(solve(problem, None)) == str(solve(problem))


def test_a_problem_without_a_route_has_no_plan(rich_request):
    request = rich_request(2, 3)
    problem = problem_of(request)
    for atom, value in problem.explicit_initial_values.items():
        if atom.fluent().name == "route" and value.is_true():
            problem.set_initial_value(atom, False)
    with pytest.raises(NoPlan):
        solve(problem)


def test_a_visit_is_dropped_for_those_alone_who_are_named_at_their_price(corridor, with_skips):
    """Cem stands 3 m behind Bob: 2.90 m for not going there are in the plan, for any validator."""
    request = with_skips(corridor(), {"cem": 2.9})
    problem, plan = problem_of(request), solve(problem_of(request))
    assert [str(one) for one in plan.actions][-1] == "Skip_visit(robot_1, cem)"
    assert cost(problem, plan) == make_plan(request).cost == 600 + 290
    assert validate(make_plan(request), request).cost == 600 + 290
    assert sorted(map(str, problem.goals)) == ["greeted(ada)", "greeted(bob)", "skipped(cem)"]


def test_who_is_out_of_reach_costs_their_price_too(corridor, with_skips):
    request = replace(corridor(), dropped_m={"dora": 1.5})
    plan = make_plan(request)
    assert plan.cost == 900 + 150
    assert validate(plan, request).cost == plan.cost


@pytest.mark.parametrize("people", [1, 2, 3])
def test_where_every_visit_is_dropped_the_plan_costs_their_prices(rich_request, with_skips, people):
    request = rich_request(people, 5, deadlines=False)
    request = with_skips(request, dict.fromkeys((each.name for each in request.visitees), 0.0))
    plan = make_plan(request)
    assert {step.action for step in plan.steps} == {"Skip_visit"}
    assert (plan.cost, validate(plan, request).cost, validate(plan, request).valid) == (0, 0, True)
