"""Intervals resample individuals and rooms: more episodes of the same ones say nothing more."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from comity.study.report.resampling import averaged, estimate, interval

VALUES = st.floats(-100, 100).map(lambda value: round(value, 3))


@st.composite
def tables(draw):
    """Individuals x rooms x seeds."""
    shape = tuple(draw(st.integers(1, most)) for most in (6, 3, 3))
    return draw(arrays(float, shape, elements=VALUES))


def episodes(table):
    """The values with the labels of each."""
    person, room, seed = (index.ravel() for index in np.indices(table.shape))
    return table.ravel(), person, room, np.zeros(table.size), seed


@given(VALUES, st.integers(1, 6), st.integers(1, 4))
def test_the_interval_of_constant_values_is_that_value(value, persons, rooms):
    found = estimate(*episodes(np.full((persons, rooms, 2), value)))
    assert found.mean == pytest.approx(value)
    assert found.monte_carlo_error == pytest.approx(0)
    ends = [end for end in (found.low, found.high) if end is not None]
    assert ends == pytest.approx([value] * (0 if persons * rooms == 1 else 2))


@given(tables())
def test_the_difference_of_equal_columns_is_zero(table):
    values, *labels = episodes(table)
    found = estimate(values - values, *labels)
    assert (found.mean, found.monte_carlo_error or 0) == (0, 0)
    assert {found.low, found.high} <= {0, None}


@given(tables(), st.data())
def test_more_episodes_of_an_individual_do_not_narrow_the_interval(table, data):
    one = data.draw(st.integers(0, table.shape[0] - 1))
    values, person, room, condition, seed = episodes(table)
    again = np.concatenate([np.arange(len(values)), *[np.flatnonzero(person == one)] * 5])
    before = estimate(values, person, room, condition, seed)
    after = estimate(values[again], person[again], room[again], condition[again], seed[again])
    assert (after.mean, after.low, after.high) == pytest.approx(
        (before.mean, before.low, before.high), abs=1e-9
    )
    assert after.episodes > before.episodes


@given(tables(), st.floats(0.1, 10), VALUES)
def test_an_interval_follows_a_change_of_unit(table, scale, offset):
    means = table.mean(axis=2)
    ends = interval(means)
    moved = interval(scale * means + offset)
    if ends is None:
        assert moved is None
    else:
        assert moved == pytest.approx([scale * end + offset for end in ends], abs=1e-6)


@given(tables())
def test_the_mean_counts_each_individual_in_each_room_once(table):
    values, *labels = episodes(table)
    assert estimate(values, *labels).mean == pytest.approx(table.mean(axis=2).mean(), abs=1e-9)


@given(tables(), st.randoms())
def test_the_order_of_episodes_changes_nothing_but_rounding(table, random):
    columns = episodes(table)
    order = list(range(table.size))
    random.shuffle(order)
    one, other = estimate(*columns), estimate(*(column[order] for column in columns))
    for name in ("mean", "low", "high", "monte_carlo_error"):
        assert getattr(other, name) == pytest.approx(getattr(one, name), abs=1e-9)


def test_an_interval_of_many_individuals_is_that_of_the_normal_approximation():
    values = np.random.default_rng(3).normal(size=(400, 1))
    low, high = interval(values)
    half = 1.96 * values.std() / math.sqrt(400)
    assert (low, high) == pytest.approx((values.mean() - half, values.mean() + half), abs=0.02)


def test_rooms_that_differ_widen_the_interval_whatever_the_number_of_individuals():
    rooms = np.tile([0.0, 1.0, 2.0], (1000, 1))
    low, high = interval(rooms)
    assert high - low > 1


def test_the_monte_carlo_error_is_that_of_the_means_of_seeds():
    """All individuals meet the same seeds: a hundred of them do not make the noise of two seeds smaller."""
    table = np.tile([0.0, 1.0], (100, 1, 1))
    found = estimate(*episodes(table))
    assert found.monte_carlo_error == pytest.approx(np.std([0, 1], ddof=1) / math.sqrt(2))
    assert (found.low, found.high) == (0.5, 0.5)


def test_what_was_not_measured_leaves_no_mark():
    table = np.array([[[1.0, math.nan]], [[3.0, 5.0]], [[math.nan, math.nan]]])
    found = estimate(*episodes(table))
    assert (found.mean, found.episodes, found.individuals) == (2.5, 3, 2)
    assert estimate(*episodes(np.full((2, 2, 2), math.nan))) is None
    values, person, room, *_ = episodes(table)
    assert averaged(values, person, room).tolist() == [[1.0], [4.0]]


def test_one_individual_in_one_room_has_no_interval_and_one_seed_no_monte_carlo_error():
    found = estimate(*episodes(np.array([[[1.0]]])))
    assert (found.mean, found.low, found.high, found.monte_carlo_error) == (1.0, None, None, None)
