"""What a scenario asks of a plan: somebody before somebody else, nobody from some side; and no more."""

from __future__ import annotations

from dataclasses import replace

import pytest

from comity_domain import NoPlan, in_order, make_plan, next_instead
from comity_domain.steps import REACH


def reached(plan):
    return [step.person for step in plan.steps if step.action == REACH]


def alone(request):
    """The same without deadlines and groups: an order is then always possible."""
    visitees = tuple(replace(one, by_s=None, skip_m=None) for one in request.visitees)
    return replace(request, visitees=visitees, companies=())


def asking(request, **after):
    visitees = tuple(replace(one, after=after.get(one.name)) for one in request.visitees)
    return replace(request, visitees=visitees)


@pytest.mark.parametrize("seed", range(10))
def test_an_order_is_kept_at_the_least_cost(rich_request, seed):
    request = alone(rich_request(2 + seed % 4, seed))
    free = make_plan(request)
    first, *_, last = reached(free)
    asked = make_plan(asking(request, **{first: last}))
    order = reached(asked)
    assert order.index(last) < order.index(first)
    assert asked.optimal
    other = in_order(request, free, (last, first))
    assert asked.cost == free.cost + other.extra_cost


@pytest.mark.parametrize("seed", range(6))
def test_an_order_that_the_plan_has_anyway_changes_nothing(rich_request, seed):
    request = alone(rich_request(2 + seed % 4, seed))
    free = make_plan(request)
    first, *_, last = reached(free)
    asked = make_plan(asking(request, **{last: first}))
    assert [(one.action, one.arguments) for one in asked.steps] == [
        (one.action, one.arguments) for one in free.steps
    ]
    assert asked.cost == free.cost


def test_an_order_that_no_deadline_allows_has_no_plan(infer, request_for):
    request = request_for({"ada": infer(), "bo": infer()})
    places = [None, "ada", "bo"]
    durations = {(start, end): 30.0 for start in places for end in places if end and start != end}
    visitees = (replace(request.visitees[0], by_s=40.0), replace(request.visitees[1], by_s=80.0))
    hurried = replace(request, visitees=visitees, durations_s=durations)
    assert reached(make_plan(hurried)) == ["ada", "bo"]
    with pytest.raises(NoPlan):
        make_plan(asking(hurried, ada="bo"))


def test_whoever_is_asked_for_first_may_be_somebody_who_is_not_visited(infer, request_for):
    request = request_for({"ada": infer(), "bo": infer()})
    assert make_plan(asking(request, ada="nobody")).cost == make_plan(request).cost


def test_what_else_might_come_first_says_where_the_order_rules_it_out(infer, request_for):
    request = asking(request_for({"ada": infer(), "bo": infer()}), bo="ada")
    (instead,) = next_instead(request, make_plan(request), 0)
    assert (instead.person, instead.extra_cost) == ("bo", None)


@pytest.mark.parametrize("side", ["front", "left", "right"])
def test_nobody_is_reached_from_a_side_that_is_ruled_out(infer, request_for, side):
    request = request_for({"ada": infer(direction=90.0 if side != "front" else 0.0)})
    (ada,) = request.visitees
    plan = make_plan(replace(request, visitees=(replace(ada, not_from=frozenset([side])),)))
    step = next(step for step in plan.steps if step.action == REACH)
    assert step.arguments[2] != side
    assert (side, "the scenario rules it out") in [
        (one.arguments[-1], one.reason) for one in step.why.ruled_out
    ]
