"""More people than a search is exact for: a first plan whatever the time, then moves to cheaper orders."""

from __future__ import annotations

import random
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from comity_domain import kept_cost, make_plan
from comity_domain.choices.options import Options, options
from comity_domain.ordering import local_search
from comity_domain.ordering.insertion import Stops, cost_of_order, quick_order
from comity_domain.ordering.local_search import improved
from comity_domain.ordering.moves import all_moves, double_bridge, moved
from comity_domain.ordering.order_table import IMPOSSIBLE, OrderTable
from comity_domain.tours.tour import people_at

LAW = settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=15, deadline=None)
NO_TIME_S = 1e-9


@pytest.fixture(autouse=True)
def _a_small_budget(monkeypatch: pytest.MonkeyPatch) -> None:
    """A tenth of the orders: what holds does not depend on how many there are."""
    monkeypatch.setattr(local_search, "MOST_ORDERS", local_search.MOST_ORDERS // 10)


@pytest.fixture(params=["routes", "groups", "deadlines"])
def crowd(request, random_request, rich_request, hall) -> Callable[..., object]:
    """Requests for many people: any routes; groups, priorities and full hands; or deadlines."""
    return {
        "routes": random_request,
        "groups": lambda count, seed: rich_request(count, seed, deadlines=False),
        "deadlines": lambda count, seed: hall(count, seed, spare_s=150.0),
    }[request.param]


def everybody(stops: Stops, choices: Options) -> list[str]:
    return sorted(name for stop in stops for name in people_at(stop, choices))


def costs(orders: np.ndarray, choices: Options) -> list[int | None]:
    """By the table; None where an order cannot be."""
    return [None if cost >= IMPOSSIBLE else int(cost) for cost in OrderTable(choices).costs(orders)]


@pytest.mark.parametrize("seed", range(2))
def test_40_people_are_planned_however_little_time_there_is(crowd, seed: int):
    request = crowd(40, seed)
    plan = make_plan(request, time_limit_s=NO_TIME_S)
    greeted = [name for step in plan.steps if step.action.startswith("Greet") for name in step.people]
    assert sorted(greeted) == sorted(visitee.name for visitee in request.visitees)
    assert kept_cost(plan, request) == plan.cost
    assert 0 < plan.bound <= plan.cost
    assert not plan.reproducible


@pytest.mark.parametrize("seed", range(2))
def test_with_more_time_a_plan_is_never_more_expensive_than_the_first(crowd, seed: int):
    request = crowd(20, seed)
    first, plan = make_plan(request, time_limit_s=NO_TIME_S), make_plan(request)
    assert plan.cost <= first.cost
    assert kept_cost(plan, request) == plan.cost


def test_the_same_request_has_the_same_plan(crowd):
    once, again = make_plan(crowd(20, 3)), make_plan(crowd(20, 3))
    assert once.reproducible
    assert once.steps == again.steps


@LAW
@given(seed=st.integers(0, 200))
def test_an_improved_order_serves_the_same_people_for_no_more_and_keeps_all_deadlines(crowd, seed: int):
    choices = options(crowd(9, seed))
    first = quick_order(choices)
    if first is None:
        return
    better, ended = improved(first, choices)
    assert ended
    assert everybody(better, choices) == everybody(first, choices)
    before, after = cost_of_order(first, choices), cost_of_order(better, choices)
    assert before is not None
    assert after is not None, "every deadline is kept"
    assert after <= before


@LAW
@given(seed=st.integers(0, 200), shuffle=st.integers(0, 10**6))
def test_the_table_has_the_cost_of_every_order_that_can_be(crowd, seed: int, shuffle: int):
    choices, draw = options(crowd(8, seed)), random.Random(shuffle)
    table = OrderTable(choices)
    order = np.array(draw.sample(range(8), 8))
    for company in table.companies:
        if draw.random() < 0.5:
            order = table.regrouped(order, company)
    (cost,) = costs(order[None], choices)
    if cost is None:
        return
    stops = table.stops(order)
    assert cost_of_order(stops, choices) == cost
    assert everybody(stops, choices) == sorted(choices.people)
    assert table.order(stops).tolist() == order.tolist()


@pytest.mark.parametrize("seed", range(2))
def test_no_single_move_makes_an_order_cheaper_once_a_descent_has_ended(crowd, seed: int):
    """Held against every neighbour."""
    choices = options(crowd(12, seed))
    first = quick_order(choices)
    assert first is not None
    search = local_search._LocalSearch(choices, lambda _: None, float("inf"))
    order, cost = search._descended(search.numbers(first))
    neighbours = moved(order, all_moves(len(order)))
    assert all(other is None or other >= cost for other in costs(neighbours, choices))


@given(count=st.integers(1, 9))
def test_every_move_leads_to_an_order_of_the_same_visits(count: int):
    orders = moved(np.arange(count), all_moves(count))
    assert (np.sort(orders, axis=1) == np.arange(count)).all()
    assert not (orders == np.arange(count)).all(axis=1).any(), "and to another one"


@given(count=st.integers(2, 9), data=st.data())
def test_any_part_can_be_reversed_and_any_three_visits_can_be_moved_anywhere(count: int, data):
    reached = {tuple(order) for order in moved(np.arange(count), all_moves(count)).tolist()}
    a, b = sorted(data.draw(st.lists(st.integers(0, count), min_size=2, max_size=2, unique=True)))
    visits = list(range(count))
    if b - a > 1:
        assert (*visits[:a], *reversed(visits[a:b]), *visits[b:]) in reached
    part, rest = visits[a : min(b, a + 3)], [*visits[:a], *visits[min(b, a + 3) :]]
    place = data.draw(st.integers(0, len(rest)))
    for each in (part, part[::-1]):
        there = (*rest[:place], *each, *rest[place:])
        assert there == tuple(visits) or there in reached


@given(count=st.integers(4, 12), seed=st.integers(0, 1000))
def test_a_change_at_random_keeps_all_visits_and_the_first(count: int, seed: int):
    order = double_bridge(np.arange(count), random.Random(seed))
    assert order[0] == 0
    assert sorted(order) == list(range(count))
