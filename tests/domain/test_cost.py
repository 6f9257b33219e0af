from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_domain.choices.cost import dislike, dislike_cost, travel_cost

desirabilities = st.floats(0.0, 1.0)
weights_m = st.floats(0.0, 10.0)


@given(desirabilities, desirabilities, weights_m)
def test_what_is_more_desirable_never_costs_more(one, other, weight_m):
    assert dislike_cost(max(one, other), weight_m) <= dislike_cost(min(one, other), weight_m)


@given(desirabilities, desirabilities)
def test_no_two_desirabilities_cost_the_same_by_a_cap(one, other):
    low, high = sorted((one, other))
    if high - low > 1e-12:
        assert dislike(low) > dislike(high)


@given(desirabilities, weights_m)
def test_costs_are_whole_and_bounded_so_that_nothing_is_impossible(desirability, weight_m):
    cost = dislike_cost(desirability, weight_m)
    assert isinstance(cost, int)
    assert 0 <= cost <= math.ceil(561 * weight_m)


@pytest.mark.parametrize(
    ("desirability", "cost"), [(1.0, 0), (0.5, 69), (0.1, 230), (0.01, 461), (0.005, 511), (0.0, 561)]
)
def test_one_metre_of_weight_is_one_metre_per_unit_of_minus_ln(desirability, cost):
    assert dislike_cost(desirability, 1.0) == cost


def test_travel_is_counted_in_centimetres():
    assert travel_cost(6.1234) == 612
