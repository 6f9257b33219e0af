"""Accuracy: errors, baselines, order and rank correlation, study by study."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.stats import spearmanr

from comity_fis import InputError
from comity_fis.audit.accuracy import Compared, accuracy, constant_error, line_error, study_accuracy
from comity_fis.audit.agreement import agreement
from comity_fis.audit.order import direction, verdict
from comity_fis.audit.rank_correlation import rank_correlation
from comity_fis.variables.unit import QUANTITIES, factor

NEUTRAL, BAND = 0.825, 0.01
DISTANCES = st.integers(30, 300).map(lambda cm: cm / 100)
SCORES = st.integers(0, 100).map(float)
ROWS = st.lists(st.builds(Compared, DISTANCES, DISTANCES, st.none() | SCORES), min_size=1, max_size=12)


@given(ROWS, st.randoms(use_true_random=False))
def test_the_order_of_the_rows_changes_nothing(rows, source):
    shuffled = source.sample(rows, len(rows))
    assert study_accuracy(shuffled, BAND, NEUTRAL) == study_accuracy(rows, BAND, NEUTRAL)


@given(st.lists(DISTANCES, min_size=2, max_size=12, unique=True))
def test_perfect_predictions_have_no_error_and_the_measured_order(values):
    found = study_accuracy([Compared(value, value) for value in values], BAND, NEUTRAL)
    assert (found.mean_absolute_error, found.bias) == (0, 0)
    assert found.rank_correlation is not None
    assert found.rank_correlation.value == 1
    assert (found.order.contradicting, found.order.equal) == (0, 0)


@given(ROWS)
def test_every_pair_of_rows_with_a_measured_order_is_counted_once(rows):
    ordered = sum(
        abs(a.measured - b.measured) > BAND * (1 + 1e-9) for a, b in itertools.combinations(rows, 2)
    )
    assert study_accuracy(rows, BAND, NEUTRAL).order.pairs == ordered


def test_what_was_measured_equal_contradicts_nothing():
    rows = [Compared(0.9, 0.8), Compared(0.9, 1.1)]
    assert study_accuracy(rows, BAND, NEUTRAL).order.pairs == 0


@given(ROWS)
def test_the_bias_never_exceeds_the_error(rows):
    found = study_accuracy(rows, BAND, NEUTRAL)
    assert abs(found.bias) <= found.mean_absolute_error + 1e-12


@given(ROWS, st.floats(-0.2, 0.2))
def test_the_baselines_do_not_care_about_a_constant_shift(rows, shift):
    """Whether distances are read between surfaces or centres changes neither the constant nor the line."""
    moved = [Compared(row.measured + shift, row.predicted, row.score) for row in rows]
    before, after = study_accuracy(rows, BAND, NEUTRAL), study_accuracy(moved, BAND, NEUTRAL)
    assert after.constant == pytest.approx(before.constant, abs=1e-9)
    assert after.line == pytest.approx(before.line, abs=1e-6)


@given(st.lists(st.tuples(SCORES, DISTANCES), min_size=3, max_size=10))
def test_the_baselines_are_what_leaving_out_each_row_gives(rows):
    scores, values = (np.array(column) for column in zip(*rows, strict=True))
    places = range(len(rows))
    others = [[j for j in places if j != i] for i in places]
    constant = np.mean([abs(values[rest].mean() - values[i]) for i, rest in enumerate(others)])
    assert constant_error(values) == pytest.approx(constant)
    lines = any(len(set(scores[rest])) < 2 for rest in others)
    if lines:
        assert line_error(scores, values) is None
        return
    misses = [
        abs(np.polyval(np.polyfit(scores[rest], values[rest], 1), scores[i]) - values[i])
        for i, rest in enumerate(others)
    ]
    assert line_error(scores, values) == pytest.approx(np.mean(misses), rel=1e-4, abs=1e-6)


@given(st.lists(st.tuples(DISTANCES, DISTANCES), min_size=2, max_size=12))
def test_the_rank_correlation_does_not_change_under_monotone_maps(pairs):
    first, second = zip(*pairs, strict=True)
    mapped = rank_correlation([math.exp(5 * x) for x in first], [x**3 - 7 for x in second])
    assert mapped == rank_correlation(first, second)
    turned = rank_correlation([-x for x in first], second)
    if mapped is None:
        assert turned is None
    else:
        assert turned is not None
        assert turned.value == pytest.approx(-mapped.value)


@given(st.lists(st.tuples(DISTANCES, DISTANCES), min_size=4, max_size=12))
def test_the_rank_correlation_is_scipys_inside_its_interval(pairs):
    first, second = zip(*pairs, strict=True)
    found = rank_correlation(first, second)
    assume(found is not None)
    assert found.value == pytest.approx(spearmanr(first, second).statistic)
    assert -1 <= found.low <= found.value <= found.high <= 1


def test_few_rows_leave_little_certainty():
    """Two rows have no interval, four in perfect order one that holds 0, ten one that does not."""
    of_two, of_four, of_ten = (rank_correlation(range(n), range(n)) for n in (2, 4, 10))
    assert (of_two.value, of_two.low, of_two.high) == (1, None, None)
    assert of_four.low < 0 < of_ten.low
    assert of_four.high == of_ten.high == 1


def test_the_interval_covers_what_it_should():
    """Of samples of 10 of two correlated normal numbers, at least 92 % of the intervals hold the truth."""
    source = np.random.default_rng(0)
    true = 6 / math.pi * math.asin(0.6 / 2)
    hits = 0
    for _ in range(400):
        x = source.normal(size=10)
        found = rank_correlation(x, 0.6 * x + 0.8 * source.normal(size=10))
        hits += found.low <= true <= found.high
    assert hits / 400 >= 0.92


def test_studies_are_never_pooled():
    """Two studies of which each has the order right, and whose rows together would not."""
    low = [Compared(0.5, 0.9), Compared(0.6, 1.0)]
    high = [Compared(1.5, 0.5), Compared(1.6, 0.6)]
    found = accuracy({"a": low, "b": high}, band=BAND, neutral=NEUTRAL)
    assert [one.rank_correlation.value for one in found.values()] == [1, 1]
    assert [one.order.agreeing for one in found.values()] == [1, 1]
    assert study_accuracy(low + high, BAND, NEUTRAL).rank_correlation.value < 0


@given(st.sampled_from([-1, 0, 1]), st.floats(-1, 1))
def test_a_verdict_is_the_same_from_either_side(found, predicted):
    assert verdict(found, predicted, BAND) == verdict(-found, -predicted, BAND)


def test_the_band_belongs_to_equality():
    assert direction(0.66 - 0.65, 0.01) == 0
    assert direction(0.6601 - 0.65, 0.01) == 1
    assert verdict(0, 0.2, 0.01) == "contradicting"
    assert verdict(1, 0.005, 0.01) == "equal"


@given(
    st.lists(st.tuples(st.sampled_from("abc"), st.sampled_from("abc")), min_size=1),
    st.randoms(use_true_random=False),
)
def test_words_agree_or_not_in_any_order(pairs, source):
    found = agreement(pairs)
    assert found == agreement(source.sample(pairs, len(pairs)))
    assert 0 <= found.hits <= found.rows == len(pairs)
    assert agreement([(word, word) for word, _ in pairs]).hits == len(pairs)


def test_the_most_frequent_word_of_the_others_is_the_baseline_of_words():
    assert agreement([("bow", "nod")]).constant_hits is None
    assert agreement([("bow", "nod"), ("bow", "nod"), ("wave", "wave")]).constant_hits == 0
    assert agreement([("bow", "x"), ("bow", "x"), ("bow", "x"), ("wave", "x")]).constant_hits == 3


@given(st.sampled_from([(a, b) for quantity in QUANTITIES for a in quantity for b in quantity]))
def test_units_convert_there_and_back(units):
    one, other = units
    assert factor(one, other) * factor(other, one) == pytest.approx(1)


@pytest.mark.parametrize(
    ("unit", "wanted"), [("cm", "deg"), ("", "m"), ("parsec", "m"), ("m", "1"), ("m", "Hz")]
)
def test_units_of_other_quantities_are_refused(unit, wanted):
    with pytest.raises(InputError, match="unit"):
        factor(unit, wanted)
