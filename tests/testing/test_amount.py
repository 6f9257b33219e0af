"""Numbers beside each other look alike only where they are."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity.testing.amounts.amount import differences_apart, told_apart, told_beside, told_range

UNITS = st.sampled_from(["m", "s", "deg", "m/s", None, "1"])
NUMBERS = st.integers(-(10**9), 10**9).map(lambda number: number / 10**6)


@given(st.lists(NUMBERS, min_size=1, max_size=4), UNITS)
def test_values_are_told_alike_exactly_where_they_are_the_same(values, unit):
    assert len(set(told_apart(values, unit))) == len(set(values))
    sizes = {abs(value) for value in values}
    assert len(set(differences_apart(values, unit))) == len(sizes)


@given(NUMBERS, NUMBERS, NUMBERS, UNITS)
def test_a_value_outside_of_a_range_looks_like_neither_end(one, other, value, unit):
    low, high = sorted((one, other))
    if value in (low, high):
        value = high + 1e-6
    shown = told_range(low, high, unit, value)
    ends = re.fullmatch(r"exactly (.+)|from (.+) to (.+)", shown)
    assert ends
    assert told_beside(value, low, high, unit) not in ends.groups()
    assert shown.startswith("exactly") == (low == high)


@pytest.mark.parametrize(
    ("values", "shown"),
    [
        ((1.0, 2.0), ("1.000 m", "2.000 m")),
        ((1.091, 1.09097), ("1.09100 m", "1.09097 m")),
        ((-0.0001, 0.0), ("-0.0001 m", "0.0000 m")),
        ((2.0, 2.0), ("2.000 m", "2.000 m")),
    ],
)
def test_no_more_digits_are_told_than_it_takes(values, shown):
    assert told_apart(values, "m") == shown
