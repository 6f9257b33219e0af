"""Polynomials of the cut heights against breakpoint-aligned integration."""

from functools import partial, reduce

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from comity_fis import Interval
from comity_fis.defuzzification.closed_form import closed_form
from comity_fis.defuzzification.output_set import Layer, OutputSet
from comity_fis.membership.function import Bump, Trapezoid, TwoTermGaussian

LOW, HIGH = -3.0, 7.0
heights = st.lists(st.floats(0, 1), min_size=4, max_size=4)


@st.composite
def neighbours(draw):
    """Four terms of which only neighbours overlap, shoulders and vertical edges among them."""
    places = sorted(draw(st.lists(st.floats(LOW, HIGH), min_size=8, max_size=8)))
    a, b, c, d, e, f, g, h = (LOW, *places[1:7], HIGH)
    corners = [(a, a, b, c), (b, c, d, e), (d, e, f, g), (f, g, h, h)]
    assume(all(corner[3] - corner[0] > 1e-3 for corner in corners))
    return {f"t{i}": Trapezoid(*corner) for i, corner in enumerate(corners)}


@given(neighbours(), heights)
def test_it_is_the_integral(terms, strengths):
    form = closed_form(terms, Interval(LOW, HIGH))
    assume(form is not None)
    layers = tuple(Layer(term, strength) for term, strength in zip(terms.values(), strengths, strict=True))
    expected = OutputSet(Interval(LOW, HIGH), layers).value()
    assume(expected is not None and max(strengths) > 1e-6)
    centre = form.centre(dict(zip(terms, strengths, strict=True)))
    assert centre == pytest.approx(expected, abs=1e-9 * (HIGH - LOW))


@given(neighbours(), st.lists(heights, min_size=1, max_size=5))
def test_a_column_is_its_rows(terms, rows):
    form = closed_form(terms, Interval(LOW, HIGH))
    assume(form is not None)
    columns = dict(zip(terms, np.array(rows).T, strict=True))
    areas, moments = form.area_and_moment(columns, partial(reduce, np.minimum))
    for row, area, moment in zip(rows, areas, moments, strict=True):
        assert form.area_and_moment(dict(zip(terms, row, strict=True)), min) == (area, moment)


@given(neighbours(), heights, st.permutations(range(4)))
def test_the_order_of_terms_does_not_matter(terms, strengths, order):
    form = closed_form(terms, Interval(LOW, HIGH))
    names = list(terms)
    shuffled = closed_form({names[i]: terms[names[i]] for i in order}, Interval(LOW, HIGH))
    named = dict(zip(names, strengths, strict=True))
    assert (form is None) == (shuffled is None)
    if form is not None:
        assert form.centre(named) == shuffled.centre(named)


def test_shoulders_may_reach_beyond_the_range():
    beyond = {"low": Trapezoid(-9, -5, 0, 1), "high": Trapezoid(0, 1, 8, 9)}
    within = {"low": Trapezoid(LOW, LOW, 0, 1), "high": Trapezoid(0, 1, HIGH, HIGH)}
    one, other = (closed_form(terms, Interval(LOW, HIGH)) for terms in (beyond, within))
    assert one == other


@given(st.floats(0.5, 5), heights)
def test_a_peak_at_the_ranges_end_is_half_a_triangle(reach, strengths):
    """MATLAB writes terms so: the outer triangles reach as far beyond the range as into it."""
    corners = [LOW - reach, LOW, (LOW + HIGH) / 2, HIGH, HIGH + reach]
    beyond = {
        str(i): Trapezoid(a, b, b, c)
        for i, (a, b, c) in enumerate(zip(corners, corners[1:], corners[2:], strict=False))
    }
    within = dict(beyond) | {
        "0": Trapezoid(LOW, LOW, LOW, corners[2]),
        "2": Trapezoid(corners[2], HIGH, HIGH, HIGH),
    }
    one, other = (closed_form(terms, Interval(LOW, HIGH)) for terms in (beyond, within))
    assert one == other is not None


@pytest.mark.parametrize(
    "terms",
    [
        {"curved": TwoTermGaussian(Bump(1, 0, 1), Bump(0, 0, 1))},
        {"cut through by the range": Trapezoid(-4, -2, 0, 1)},
        {"outer": Trapezoid(-3, -2, 6, 7), "inner": Trapezoid(-1, 0, 1, 2)},
        {"a": Trapezoid(0, 1, 2, 3), "b": Trapezoid(0.5, 1.5, 2.5, 3.5), "c": Trapezoid(2, 3, 4, 5)},
    ],
)
def test_what_has_none(terms):
    assert closed_form(terms, Interval(LOW, HIGH)) is None
