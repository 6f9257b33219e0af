"""What is left of a plan once some people were served."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

import pytest

from comity_domain import kept_cost, make_plan, rebind, renumbered, rest_of


@pytest.fixture
def case(random_request):
    request = random_request(3, 5)
    return make_plan(request), request


def test_whoever_was_served_is_gone_and_everything_else_is_as_it_was(case):
    plan, request = case
    names = [visitee.name for visitee in request.visitees]
    for count in range(len(names) + 1):
        for done in combinations(names, count):
            rest = rest_of(plan, done)
            assert rest.steps == tuple(step for step in plan.steps if step.person not in done)
            assert rest.cost == sum(step.cost for step in rest.steps)


def test_a_company_is_left_until_all_of_it_was_served(case):
    plan, _ = case
    first, second = plan.steps[0].person, plan.steps[2].person
    together = replace(plan.steps[1], companions=(second,))
    shared = replace(plan, steps=(plan.steps[0], together))
    assert rest_of(shared, (first,)).steps == shared.steps
    assert rest_of(shared, (first, second)).steps == ()


def test_new_numbers_leave_every_choice_and_price(case, infer):
    plan, request = case
    values = {visitee.name: infer() for visitee in request.visitees}
    new = renumbered(plan, values)
    assert [step.arguments for step in new.steps] == [step.arguments for step in plan.steps]
    assert new.cost == plan.cost
    for step in new.steps:
        if step.action == "Reach_user":
            assert step.parameters["approach_speed"] == values[step.person]["approach_speed"].number


def test_what_the_choices_cost_now_is_never_less_than_the_optimum_and_equal_where_they_are_kept(
    random_request,
):
    """The old choices' price under new circumstances, against planning anew and against rebinding."""
    kept = 0
    for seed in (1, 2, 4, 5):
        before = random_request(3, seed)
        plan = make_plan(before)
        for factor in (1.0, 0.5):
            legs = list(before.travel)
            travel = {leg: before.travel[leg] * (factor if i % 2 else 1.0) for i, leg in enumerate(legs)}
            request = replace(before, travel=travel)
            cost, best = kept_cost(plan, request), make_plan(request).cost
            assert cost is not None
            assert cost >= best
            if rebind(plan, request) is not None:
                kept += 1
                assert cost == best
    assert kept


def test_choices_for_people_who_are_not_asked_for_cost_nothing_known(case):
    plan, request = case
    assert kept_cost(plan, replace(request, visitees=request.visitees[1:])) is None
