"""The paper's automatic partition, run again on the shipped scores."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from comity_fis import (
    InputError,
    from_data,
    individualism_scores,
    load_rulebook,
    partition,
    shipped_rulebooks,
)
from comity_fis.variables.clustering import c_means, subtractive_centres

SCORES = [row.value for row in individualism_scores()]


@pytest.fixture(scope="module")
def default():
    return partition(SCORES)


@pytest.mark.parametrize("radius", [0.35, 0.4, 0.5, 0.6, 0.7, 0.75])
def test_there_are_exactly_two_clusters(radius):
    assert len(subtractive_centres(np.array(SCORES, dtype=float), radius)) == 2


@pytest.mark.parametrize("radius", [0.35, 0.5, 0.75])
def test_their_centres_do_not_depend_on_the_radius(radius):
    data = np.array(SCORES, dtype=float)
    centres, memberships = c_means(data, subtractive_centres(data, radius))
    assert centres == pytest.approx((24.344, 68.616), abs=1e-3)
    assert memberships.sum(axis=0) == pytest.approx(np.ones(78))


def test_the_partition_has_these_centres(default):
    assert default.centres == pytest.approx((24.344, 68.616), abs=1e-3)
    assert list(default.terms) == ["LC1", "LC2"]


def test_the_clusters_start_from_two_scores(default):
    assert default.starts == (30, 70)


def test_the_fit_is_the_known_optimum(default):
    assert default.squared_errors == pytest.approx((0.04136, 0.03098), abs=5e-6)
    low, high = default.terms["LC1"], default.terms["LC2"]
    assert (low(38), high(38)) == pytest.approx((0.839, 0.172), abs=1e-3)
    assert (low(67), high(67)) == pytest.approx((0.016, 0.995), abs=1e-3)
    assert all(bump.height >= 0 for term in default.terms.values() for bump in (term.first, term.second))


@pytest.mark.parametrize("name", [name for name in shipped_rulebooks() if name.startswith("bruno2017")])
def test_the_rulebooks_hold_what_the_partition_gives(default, name):
    variable = load_rulebook(name).variables["individualism"]
    assert variable.shapes == "fitted"
    assert variable.partition.radius == default.radius
    assert variable.partition.centres == pytest.approx(default.centres, abs=1e-8)
    assert variable.partition.squared_errors == pytest.approx(default.squared_errors, abs=1e-8)
    for term, fitted in default.terms.items():
        for score in range(101):
            assert variable.terms[term](score) == pytest.approx(fitted(score), abs=1e-7)


def test_the_order_of_the_scores_does_not_matter(default):
    again = partition(sorted(SCORES, reverse=True))
    assert again.centres == pytest.approx(default.centres, abs=1e-9)
    assert again.squared_errors == pytest.approx(default.squared_errors, abs=1e-9)


@settings(max_examples=20)
@given(st.floats(-5, 5), st.floats(0.1, 100))
def test_clusters_move_and_stretch_with_the_data(shift, scale):
    data = np.array(SCORES, dtype=float)
    centres = subtractive_centres(data, 0.5)
    assert subtractive_centres(data * scale + shift, 0.5) == pytest.approx(centres * scale + shift)


def test_numpys_global_random_state_is_left_alone():
    before = np.random.get_state()[1].tolist()
    c_means(np.array(SCORES, dtype=float), np.array([30.0, 70.0]))
    assert np.random.get_state()[1].tolist() == before


def test_one_group_is_an_honest_answer_and_no_partition():
    with pytest.raises(InputError, match="one group"):
        partition([50, 50, 50, 51, 49, 50, 52], radius=2.0)


@pytest.mark.parametrize("data", [[], [1.0], [3.0, 3.0], [1.0, float("nan"), 2.0]])
def test_no_data_is_refused(data):
    with pytest.raises(InputError, match="two different finite numbers"):
        partition(data)


@pytest.mark.parametrize("radius", [0, -1, float("nan"), float("inf")])
def test_a_wrong_radius_is_refused(radius):
    with pytest.raises(InputError, match="radius"):
        partition(SCORES, radius)


@pytest.mark.parametrize("data", [None, 7, ["a", "b"], [1.0, None], [10**400, 1]])
def test_what_is_no_list_of_numbers_is_refused(data):
    with pytest.raises(InputError, match="data as"):
        partition(data)
    with pytest.raises(InputError, match="data as"):
        from_data("x", data, level="interval", reason="made up")
