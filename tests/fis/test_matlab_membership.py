"""MATLAB's membership functions: between 0 and 1, as MATLAB defines them, and with honest heights."""

import math

import pytest
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


def bell_curve(x, sigma, centre):
    return math.exp(-(((x - centre) / sigma) ** 2) / 2)


def logistic(x, slope, centre):
    t = slope * (x - centre)
    return 1 / (1 + math.exp(-t)) if t >= 0 else math.exp(t) / (1 + math.exp(t))


def parabolas(x, foot, shoulder):
    t = min(max((x - foot) / (shoulder - foot), 0), 1)
    return 2 * t * t if t <= 0.5 else 1 - 2 * (1 - t) ** 2


FORMULAS = {
    "gaussmf": bell_curve,
    "gauss2mf": lambda x, s, b, t, c: bell_curve(min(x, b), s, b) * bell_curve(max(x, c), t, c),
    "gbellmf": lambda x, a, b, c: 1 / (1 + abs((x - c) / a) ** (2 * b)),
    "sigmf": logistic,
    "dsigmf": lambda x, a, b, c, d: abs(logistic(x, a, b) - logistic(x, c, d)),
    "psigmf": lambda x, a, b, c, d: logistic(x, a, b) * logistic(x, c, d),
    "smf": parabolas,
    "zmf": lambda x, a, b: 1 - parabolas(x, a, b),
    "pimf": lambda x, a, b, c, d: parabolas(x, a, b) * (1 - parabolas(x, c, d)),
}
"""As MATLAB's manual defines them."""


@given(curves(), places)
def test_they_are_what_matlab_defines(curve, x):
    assert curve(x) == pytest.approx(FORMULAS[curve.matlab](x, *curve.parameters), abs=1e-9)


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
