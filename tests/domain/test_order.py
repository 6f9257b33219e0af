"""Priorities, deadlines, and the law that culture never decides who is served."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from comity_domain import START, PlanningFailed, Weights, make_plan, next_instead, visits_of
from comity_domain.choices.options import options
from comity_domain.explanation.stability import differences, flips
from comity_domain.labelling.search import cheapest
from comity_domain.labelling.skipping import left_out
from comity_domain.tours.tour import end_times_s, tour_cost

LAW = settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=25, deadline=None)


def order(plan):
    return [step.person for step in plan.steps if step.action == "Reach_user"]


def test_a_priority_is_worth_its_metres_for_everybody_who_comes_before(corridor):
    """Cem last: 9 m. Cem first: 9 m + 3 m + 3 m of way, or what two waits of his cost."""
    assert order(make_plan(corridor())) == ["ada", "bob", "cem"]
    low = make_plan(corridor(cem={"priority_m": 2.9}))
    assert order(low) == ["ada", "bob", "cem"]
    assert low.steps[-1].cost_parts["waiting"] == 580
    high = make_plan(corridor(cem={"priority_m": 3.1}))
    assert order(high)[0] == "cem"
    assert high.steps[1].cost_parts["waiting"] == 0


def test_a_deadline_is_kept_at_any_cost_in_way(corridor):
    """Bob is 12 s away, and a greeting takes 4: nobody can be greeted before him."""
    plan = make_plan(corridor(bob={"by_s": 16.0}))
    assert order(plan)[0] == "bob"
    with pytest.raises(PlanningFailed, match="keeps every deadline"):
        make_plan(corridor(bob={"by_s": 15.9}))


@pytest.mark.parametrize("seed", range(8))
def test_every_plan_keeps_its_deadlines(rich_request, seed):
    request = rich_request(5, seed)
    if cheapest(options(request)) is None:
        return
    choices, visits = options(request), visits_of(make_plan(request))
    by_s = {visitee.name: visitee.by_s for visitee in request.visitees}
    for visit, end_s in zip(visits, end_times_s(visits, choices), strict=True):
        members = choices.companies[visit.company].members if visit.company else (visit.spot.place,)
        assert all(by_s[name] is None or end_s <= by_s[name] + 1e-3 for name in members)


@LAW
@given(st.integers(0, 30), st.permutations(range(5)))
def test_culture_never_decides_whether_somebody_is_served(rich_request, seed, permutation):
    """The same people with their cultures exchanged: all are served in both plans, or in neither."""
    request = rich_request(5, seed)
    values = [visitee.values for visitee in request.visitees]
    exchanged = replace(
        request,
        visitees=tuple(
            replace(visitee, values=values[index])
            for visitee, index in zip(request.visitees, permutation, strict=True)
        ),
    )
    assert (cheapest(options(request)) is None) == (cheapest(options(exchanged)) is None)


def test_somebody_else_first_costs_what_a_plan_that_begins_so_costs(corridor):
    request = corridor()
    plan = make_plan(request)
    extra = {each.person: each.extra_cost for each in next_instead(request, plan, 0)}
    assert extra == {"bob": 600, "cem": 600}
    assert [each.person for each in next_instead(request, plan, 2)] == []


@pytest.mark.parametrize("seed", range(4))
def test_going_on_otherwise_is_never_cheaper_than_an_optimal_plan(rich_request, seed):
    request = rich_request(4, seed, deadlines=False)
    if cheapest(options(request)) is None:
        return
    plan = make_plan(request)
    for stop in range(len(plan.steps) // 2):
        costs = [each.extra_cost for each in next_instead(request, plan, stop)]
        assert all(cost is None or cost >= 0 for cost in costs)


def test_a_weight_that_flips_a_choice_is_found_where_it_lies(infer, request_for, travel_everywhere):
    """The left saves 1 m and costs 2.3 m per metre of weight: below 0.434 it is cheaper."""
    travel = travel_everywhere(["ada"]) | {(START, make_spot("ada", "left")): 4.0}
    request = request_for({"ada": infer()}, travel, weights=Weights(side_m=1.0))
    plan = make_plan(request)
    assert plan.steps[0].arguments[2] == "front"
    found = {flip.weight: flip for flip in flips(request, plan)}
    assert found.keys() == {"side", "both"}
    assert found["side"].factor == pytest.approx(1 / 2.303, rel=0.02)
    (change,) = differences(visits_of(plan), found["side"].visits)
    assert change == "reaches ada from the left, not the front"
    below = replace(request, weights=Weights(side_m=found["side"].factor * 0.98))
    assert make_plan(below).steps[0].arguments[2] == "left"


@pytest.mark.parametrize("seed", range(4))
def test_a_stable_plan_is_optimal_at_every_factor_that_was_looked_at(random_request, seed):
    request = random_request(3, seed)
    plan = make_plan(request)
    nearest = {flip.weight: flip.factor for flip in flips(request, plan)}
    for factor in (0.25, 0.5, 1.0, 2.0, 4.0):
        if all((f < 1) != (factor < 1) or abs(f - 1) > abs(factor - 1) for f in nearest.values()):
            scaled = replace(request, weights=request.weights.scaled(factor))
            assert tour_cost(visits_of(plan), options(scaled)) == make_plan(scaled).cost


def make_spot(name, side):
    from comity_domain import Spot

    return Spot(name, side)


def test_a_deadline_without_durations_is_refused(infer, request_for):
    request = request_for({"ada": infer()})
    visitees = tuple(replace(each, by_s=10.0) for each in request.visitees)
    with pytest.raises(ValueError, match="deadlines need a duration"):
        replace(request, visitees=visitees)


def test_pairs_of_stops_follow_each_other(rich_request):
    """A plan of companies is a chain, too: each way starts where the last one ended."""
    plan = make_plan(rich_request(5, 3, deadlines=False))
    reaches = plan.steps[::2]
    assert all(after.origin == before.arguments[1:3] for before, after in pairwise(reaches))


def skipped(plan):
    return [step.person for step in plan.steps if step.action == "Skip_visit"]


def test_somebody_is_left_out_where_that_costs_less_than_the_way(corridor, with_skips):
    """Cem stands 3 m behind Bob, at the end of the corridor."""
    request = corridor()
    assert skipped(make_plan(with_skips(request, {"cem": 3.1}))) == []
    plan = make_plan(with_skips(request, {"cem": 2.9}))
    assert skipped(plan) == ["cem"]
    assert order(plan) == ["ada", "bob"]
    assert plan.cost == 600 + 290 == plan.bound


def test_without_a_price_nobody_is_left_out(corridor, with_skips):
    assert skipped(make_plan(with_skips(corridor(), {}))) == []


def test_a_deadline_that_cannot_be_kept_leaves_out_whom_the_scenario_lets(corridor, with_skips):
    request = corridor(cem={"by_s": 5.0})
    assert skipped(make_plan(with_skips(request, {"cem": 50.0}))) == ["cem"]


@LAW
@given(st.integers(0, 30), st.permutations(range(5)))
def test_culture_never_decides_who_is_left_out(rich_request, with_skips, seed, permutation):
    """Real plans, before and after the cultures are exchanged: the same people are skipped."""
    plain = rich_request(5, seed, deadlines=False)
    prices = {visitee.name: 1.0 + 3.0 * index for index, visitee in enumerate(plain.visitees)}
    request = with_skips(plain, prices)
    values = [visitee.values for visitee in request.visitees]
    exchanged = replace(
        request,
        visitees=tuple(
            replace(visitee, values=values[index])
            for visitee, index in zip(request.visitees, permutation, strict=True)
        ),
    )
    assert left_out(request) == left_out(exchanged)
