"""MATLAB's membership functions: between 0 and 1, as scikit-fuzzy has them, and with honest heights."""

import math

import numpy as np
import pytest
import skfuzzy
from hypothesis import assume, given
from hypothesis import strategies as st

from comity_fis.errors import WrongValueError
from comity_fis.membership.curved import CURVED
from comity_fis.membership.function import Complement, Trapezoid

places = st.floats(-50, 50)
sizes = st.floats(0.05, 20)
slopes = st.floats(0.05, 20) | st.floats(-20, -0.05)


@st.composite
def curves(draw):
    name = draw(st.sampled_from(sorted(CURVED)))
    p, q, r, s = sorted(draw(st.lists(places, min_size=4, max_size=4)))
    assume(min(q - p, s - r) > 0.1)
    numbers = {
        "gaussmf": (draw(sizes), p),
        "gauss2mf": (draw(sizes), p, draw(sizes), q),
        "gbellmf": (draw(sizes), draw(st.floats(0.3, 8)), p),
        "sigmf": (draw(slopes), p),
        "dsigmf": (draw(slopes), p, draw(slopes), q),
        "psigmf": (draw(slopes), p, draw(slopes), q),
        "smf": (p, q),
        "zmf": (p, q),
        "pimf": (p, q, r, s),
    }
    return CURVED[name](*numbers[name])


@given(curves(), st.floats(-1e300, 1e300))
def test_degrees_lie_between_0_and_1_wherever_one_looks(curve, x):
    assert 0 <= curve(x) <= 1
    assert Complement(curve)(x) == 1 - curve(x)


@given(curves(), places)
def test_scikit_fuzzy_has_the_same_functions(curve, x):
    swapped = {"gaussmf", "gauss2mf", "sigmf", "dsigmf", "psigmf"}
    numbers = list(curve.parameters)
    if curve.matlab in swapped:
        numbers = [number for pair in zip(numbers[1::2], numbers[::2], strict=True) for number in pair]
    with np.errstate(over="ignore"):
        theirs = getattr(skfuzzy, curve.matlab)(np.array([x]), *numbers)[0]
    assert curve(x) == pytest.approx(abs(theirs), abs=1e-9)


@given(curves(), places, places)
def test_no_degree_is_above_the_height(curve, one, other):
    low, high = sorted((one, other))
    assume(high > low)
    degrees = [curve(low + (high - low) * i / 500) for i in range(501)]
    assert max(degrees) <= curve.height(low, high) + 1e-9
    assert curve.height(low, high) <= 1
    reached = max(degrees) + 0.05 * (max(degrees) - min(degrees)) + 1e-9
    steep = abs(high - low) * 20 / 500  # a slope of at most 20 between two samples
    assert curve.height(low, high) <= reached + steep


@pytest.mark.parametrize(
    ("name", "numbers", "x", "degree"),
    [
        ("gaussmf", (2, 5), 7, math.exp(-0.5)),
        ("gauss2mf", (1, 2, 1, 4), 3, 1),
        ("gauss2mf", (1, 4, 1, 2), 3, math.exp(-1)),
        ("gbellmf", (2, 2.5, 6), 8, 0.5),
        ("sigmf", (2, 4), 4, 0.5),
        ("dsigmf", (5, 7, 5, 2), 4.5, 1),  # MATLAB takes the absolute difference
        ("psigmf", (2, 3, -5, 8), 3, 0.5),
        ("smf", (1, 8), 4.5, 0.5),
        ("zmf", (3, 7), 5, 0.5),
        ("pimf", (1, 4, 5, 10), 4.5, 1),
    ],
)
def test_a_degree_by_hand(name, numbers, x, degree):
    assert CURVED[name](*numbers)(x) == pytest.approx(degree, abs=1e-4)


@pytest.mark.parametrize(
    ("name", "numbers"),
    [
        ("gaussmf", (0, 1)),
        ("gaussmf", (math.nan, 1)),
        ("gauss2mf", (1, 0, 0, 1)),
        ("gbellmf", (0, 1, 1)),
        ("gbellmf", (1, -1, 1)),
        ("sigmf", (0, 1)),
        ("dsigmf", (0, 1, 1, 1)),
        ("smf", (2, 1)),
        ("zmf", (2, 2)),
        ("pimf", (1, 0, 3, 4)),
        ("pimf", (1, 2, 3, math.inf)),
    ],
)
def test_a_shape_without_a_meaning_cannot_be_built(name, numbers):
    with pytest.raises(WrongValueError, match=name):
        CURVED[name](*numbers)


def test_the_complement_of_a_shoulder_is_the_other_side():
    rest = Complement(Trapezoid(0, 0, 2, 4))
    assert [rest(x) for x in (0, 2, 3, 4, 5)] == [0, 0, 0.5, 1, 1]
    assert rest.height(0, 3) == pytest.approx(0.5)
