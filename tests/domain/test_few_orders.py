"""An order that is cheaper than all others is what an optimal engine finds."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from comity_domain import make_plan
from comity_domain.choices.options import options
from comity_domain.classical.initial_state import order_key
from comity_domain.labelling.search import cheapest
from comity_domain.ordering.few_orders import EVERY_ORDER, only_cheapest

LAW = settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=60, deadline=None)


class Forgetful:
    """Remembers nothing."""

    def recall(self, key):
        return None

    def keep(self, key, order):
        pass


def in_no_hurry(request):
    """The same request where nobody minds who is visited before."""
    visitees = tuple(replace(visitee, priority_m=0.0) for visitee in request.visitees)
    return replace(request, visitees=visitees)


def require_exact(choices):
    """What is found, if anything, is what the exact search finds."""
    found = only_cheapest(choices)
    if found is not None:
        best = cheapest(choices)
        assert best is not None
        assert best.exact
        assert best.cost == found.bound
        at_once = [(stop.person, stop.company) for stop in best.stops]
        assert at_once == [(stop.person, stop.company) for stop in found.stops]
    return found


@LAW
@given(count=st.integers(1, 5), seed=st.integers(0, 10**6))
def test_it_costs_what_the_exact_search_finds(random_request, count, seed):
    require_exact(options(random_request(count, seed)))


@LAW
@given(count=st.integers(2, 4), seed=st.integers(0, 10**6))
def test_so_it_does_where_people_stand_together(rich_request, count, seed):
    require_exact(options(in_no_hurry(rich_request(count, seed, deadlines=False))))


def test_a_group_that_is_cheapest_greeted_at_once_is(rich_request):
    requests = (in_no_hurry(rich_request(3, seed, deadlines=False)) for seed in range(40))
    found = filter(None, map(require_exact, map(options, requests)))
    assert any(stop.company is not None for order in found for stop in order.stops)


@pytest.mark.parametrize("seed", range(4))
def test_the_plan_is_the_engines(random_request, seed):
    request = random_request(3, seed)
    quick, searched = make_plan(request, orders=Forgetful()), make_plan(request)
    if quick.engine == EVERY_ORDER:
        assert replace(quick, engine=searched.engine) == searched


@pytest.mark.parametrize("seed", range(4))
def test_so_it_is_where_people_stand_together(rich_request, seed):
    request = in_no_hurry(rich_request(3, seed, deadlines=False))
    quick, searched = make_plan(request, orders=Forgetful()), make_plan(request)
    assert replace(quick, engine=searched.engine) == searched


def test_a_tie_is_left_to_the_engine(infer, request_for):
    """Two people at the same distance from everything."""
    assert only_cheapest(options(request_for({"ann": infer(), "bob": infer()}))) is None


@LAW
@given(seed=st.integers(0, 10**6))
def test_another_price_is_another_key(random_request, seed):
    request = random_request(2, seed)
    longer = {leg: way + 0.5 for leg, way in request.travel.items()}
    assert order_key(options(request)) != order_key(options(replace(request, travel=longer)))
    assert order_key(options(request)) == order_key(options(request))
