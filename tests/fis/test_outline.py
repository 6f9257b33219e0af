"""Desirability as points: what `--json` gives and pictures draw."""

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_fis import Interval
from comity_fis.defuzzification.output_set import Layer, OutputSet
from comity_fis.membership.function import Bump, Trapezoid, TwoTermGaussian

RANGE = Interval(0, 10)
corner = st.integers(-20, 120).map(lambda tenth: tenth / 10)
trapezoids = (
    st.lists(corner, min_size=4, max_size=4)
    .map(sorted)
    .filter(lambda c: c[0] < c[3])
    .map(lambda c: Trapezoid(*c))
)
curves = st.lists(st.builds(Layer, trapezoids, st.floats(0.01, 1)), max_size=4).map(
    lambda cuts: OutputSet(RANGE, tuple(cuts))
)


def between(points, x):
    """The straight lines through the points, at a place that is none of them."""
    (x0, y0), (x1, y1) = next((a, b) for a, b in pairwise(points) if a[0] < x < b[0])
    return y0 + (y1 - y0) * (x - x0) / (x1 - x0)


@given(curves, st.floats(0.001, 9.999))
def test_straight_lines_through_the_outline_are_the_curve(curve, x):
    if any(abs(x - place) < 1e-6 for place, _ in curve.outline):
        return
    assert between(curve.outline, x) == pytest.approx(curve(x), abs=1e-9)


@given(curves)
def test_the_outline_spans_the_domain_in_ascending_order_within_degrees(curve):
    places = [x for x, _ in curve.outline]
    assert (places[0], places[-1]) == RANGE.ends
    assert places == sorted(places)
    assert all(0 <= degree <= 1 for _, degree in curve.outline)


@given(curves, st.integers(2, 50))
def test_samples_are_values_of_the_curve_with_both_ends(curve, n):
    points = curve.sample(n)
    assert len(points) == n
    assert (points[0][0], points[-1][0]) == RANGE.ends
    assert all(degree == curve(x) for x, degree in points)


def test_a_trapezoid_is_its_corners_and_a_jump_is_two_points():
    cuts = (Layer(Trapezoid(2, 2, 4, 6), 0.5),)
    assert OutputSet(RANGE, cuts).outline == (
        (0, 0),
        (2, 0),
        (2, 0.5),
        (5, 0.5),
        (6, pytest.approx(0)),
        (10, 0),
    )


def test_a_curved_set_is_sampled():
    term = TwoTermGaussian(Bump(1, 3, 2), Bump(0.5, 6, 2))
    assert len(OutputSet(RANGE, (Layer(term, 0.8),)).outline) == 101


def test_one_point_is_no_curve():
    with pytest.raises(ValueError, match="at least 2"):
        OutputSet(RANGE, ()).sample(1)
