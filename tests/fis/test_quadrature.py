"""The exact value of a set, against quadrature aligned with every corner: any shape, however narrow."""

import math
from itertools import combinations, pairwise

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from comity_fis import Interval
from comity_fis.defuzzification import corners, ground, reference, sets
from comity_fis.defuzzification.output_set import Layer, OutputSet
from comity_fis.membership.arrays import degrees
from comity_fis.membership.curved import CURVED
from comity_fis.membership.function import Bump, Complement, Trapezoid, TwoTermGaussian
from comity_fis.rules.methods import Methods

LOW, HIGH = 0.45, 1.2
SPAN = HIGH - LOW
WHOLE = Interval(LOW, HIGH)
UNITED = [Methods(implication=i, aggregation=a) for i in ("min", "prod") for a in ("max", "sum", "probor")]

place = st.floats(LOW - 0.1 * SPAN, HIGH + 0.1 * SPAN)
width = st.floats(-6, 0).map(lambda exponent: SPAN * 10**exponent)
strength = st.floats(-10, 0).map(lambda exponent: 10**exponent) | st.floats(0.01, 1)
sign = st.sampled_from([-1, 1])


@st.composite
def trapezoids(draw, widths=width):
    centre, reach = draw(place), draw(widths)
    a, b, c, d = sorted(centre + reach * draw(st.floats(-1, 1)) for _ in range(4))
    b, c = draw(st.sampled_from([(b, c), (a, c), (b, d), (b, b)]))
    assume(d - a > 1e-2 * reach)
    return Trapezoid(a, b, max(b, c), d)


@st.composite
def curves(draw, widths=width):
    name, centre, reach = draw(st.sampled_from(sorted(CURVED))), draw(place), draw(widths)
    size, other = (draw(st.floats(0.2, 2)) * reach for _ in range(2))
    slope, fall = (draw(sign) * draw(st.floats(0.5, 8)) / reach for _ in range(2))
    far = centre + reach * draw(st.floats(0.1, 100))
    numbers = {
        "gaussmf": (size, centre),
        "gauss2mf": (size, centre, other, far),
        "gbellmf": (size, draw(st.floats(0.5, 6)), centre),
        "sigmf": (slope, centre),
        "dsigmf": (slope, centre, fall, far),
        "psigmf": (slope, centre, fall, far),
        "smf": (centre, centre + size),
        "zmf": (centre, centre + size),
        "pimf": (centre, centre + size, far, far + other),
    }
    return CURVED[name](*numbers[name])


@st.composite
def two_terms(draw, widths=width):
    centre, reach = draw(place), draw(widths)
    far = centre + draw(sign) * reach * 10 ** draw(st.floats(-1, 4))
    first = Bump(draw(st.floats(0.1, 1.5)), centre, draw(st.floats(0.2, 2)) * reach)
    return TwoTermGaussian(first, Bump(draw(st.floats(0, 1)), far, draw(st.floats(0.2, 2)) * reach))


shapes = trapezoids() | curves() | two_terms() | trapezoids().map(Complement) | curves().map(Complement)


def layers_of(terms):
    return st.lists(st.builds(Layer, terms, strength), min_size=1, max_size=4).map(tuple)


def corners_between(found, edges):
    """Where shaped terms have a corner or pass each other, each found by bracketing on a graded grid."""
    steps = 2.0 ** -np.arange(1, 44, 3)
    grid = np.unique(
        np.concatenate(
            [
                np.concatenate([a + (b - a) * steps, b - (b - a) * steps, np.linspace(a, b, 9)])
                for a, b in pairwise(edges)
            ]
        )
    )
    terms = [layer.term for layer in found.layers]
    if found.methods.implication == "min":
        heights = {layer.strength for layer in found.layers}
        gaps = [lambda x, t=term, h=height: t(x) - h for term in terms for height in heights]
        plain = terms
    else:
        gaps = []
        plain = [lambda x, t=term, h=height: h * t(x) for term, height in found.layers]
    if found.methods.aggregation == "max":
        gaps += [lambda x, f=f, g=g: f(x) - g(x) for f, g in combinations(plain, 2)]
    for gap in gaps:
        signs = np.sign([gap(x) for x in grid.tolist()])
        for k in np.flatnonzero(signs[:-1] * signs[1:] < 0):
            yield brentq(gap, grid[k], grid[k + 1], xtol=4e-16)
    yield from grid


def centre_by_quadrature(found):
    """Gauss-Legendre between all corners, halved until nothing changes."""
    turns = {x for layer in found.layers for x in layer.term.turns if LOW < x < HIGH}
    edges = np.unique([LOW, HIGH, *corners_between(found, sorted({LOW, HIGH, *turns}))])
    nodes, weights = np.polynomial.legendre.leggauss(20)

    def integral(a, b):
        xs = (a + b) / 2 + (b - a) / 2 * nodes
        heights = (b - a) / 2 * weights * [found.degree(x) for x in xs.tolist()]
        return np.array([heights.sum(), (heights * (xs - LOW)).sum()])

    panels = [(a, b, integral(a, b)) for a, b in pairwise(edges)]
    allowed = 1e-12 * sum(whole[0] for *_, whole in panels)
    done = []
    for _ in range(50):
        halves = [(a, b, whole, integral(a, (a + b) / 2), integral((a + b) / 2, b)) for a, b, whole in panels]
        panels = []
        for a, b, whole, left, right in halves:
            if np.abs(left + right - whole).max() <= allowed:
                done.append(left + right)
            else:
                panels += [(a, (a + b) / 2, left), ((a + b) / 2, b, right)]
    area, moment = (math.fsum(part[i] for part in done) for i in (0, 1))
    return LOW + moment / area if area > 0 else None


@settings(max_examples=40, deadline=None)
@given(layers_of(shapes), st.sampled_from(UNITED))
def test_the_centre_of_area_is_right_to_a_billionth_of_the_range(layers, methods):
    assume(all(layer.term.height(LOW, HIGH) > 0 for layer in layers))
    found = OutputSet(WHOLE, layers, methods)
    expected = centre_by_quadrature(found)
    assert found.value() == (expected and pytest.approx(expected, abs=1e-9 * SPAN))


@settings(max_examples=60, deadline=None)
@given(layers_of(shapes), st.sampled_from(UNITED))
def test_the_number_of_evaluations_is_bounded_whatever_the_shapes(layers, methods):
    """Of one parameter's first set, which includes what is worked out once for all sets of its terms."""
    counts = []

    def counted(term, xs):
        counts.append(xs.size)
        return degrees(term, xs)

    with pytest.MonkeyPatch.context() as patch:
        for module in (corners, ground, sets):
            patch.setattr(module, "degrees", counted)
        ground.ground_of.cache_clear()
        OutputSet(WHOLE, layers, methods).value()
    assert sum(counts) <= 100_000 * len(layers)


@pytest.mark.parametrize(
    ("terms", "strengths", "expected"),
    [
        ([("gaussmf", 1, 703)], [1], 703.0),
        ([("trimf", 100, 100.5, 101), ("gaussmf", 0.05, 700)], [0.9, 0.1], 129.8206),
        ([("trimf", 100, 100.5, 101), ("gaussmf", 0.05, 700)], [0.6, 0.4], 192.5484),
        ([("trimf", 100, 100.5, 101), ("gaussmf", 0.05, 700)], [0.2, 0.8], 336.2060),
    ],
)
def test_a_narrow_peak_in_a_wide_range_is_seen(terms, strengths, expected):
    shaped = [
        Trapezoid(a[0], a[1], a[1], a[2]) if name == "trimf" else CURVED[name](*a) for name, *a in terms
    ]
    found = OutputSet(Interval(0, 1000), tuple(map(Layer, shaped, strengths)))
    assert found.value() == pytest.approx(expected, abs=5e-4)


@pytest.mark.parametrize("height", [1.0, 0.5, 1e-9, 1e-30])
def test_a_symmetric_curve_has_its_centre_in_the_middle_however_weak_its_rule(height):
    term = TwoTermGaussian(Bump(1, 0.8, 0.001), Bump(0, 0, 1))
    assert OutputSet(Interval(0, 2), (Layer(term, height),)).value() == pytest.approx(0.8, abs=1e-9)


def test_a_cut_gaussian_in_closed_form():
    """Half a bell cut off at 1/2, integrated by hand with the error function."""
    width, top = 0.2, 0.5
    edge = width * math.sqrt(math.log(1 / top))
    area = top * edge + width * math.sqrt(math.pi) / 2 * (math.erf(1 / width) - math.erf(edge / width))
    moment = top * edge**2 / 2 + width**2 / 2 * (
        math.exp(-((edge / width) ** 2)) - math.exp(-((1 / width) ** 2))
    )
    cut = Layer(TwoTermGaussian(Bump(1, 0, width), Bump(0, 0, 1)), top)
    assert OutputSet(Interval(0, 1), (cut,)).value() == pytest.approx(moment / area, abs=1e-12)


@settings(deadline=None)
@given(layers_of(shapes), place, place)
def test_the_centre_lies_in_the_interval_or_there_is_none(layers, one, other):
    low, high = sorted((one, other))
    centre = OutputSet(WHOLE, layers).centroid(low, high)
    assert centre is None or max(low, LOW) <= centre <= min(high, HIGH)


wide = st.just(SPAN)
friendly = st.lists(
    st.builds(Layer, trapezoids(wide) | curves(wide), st.floats(0.05, 1)), min_size=1, max_size=4
)


@settings(max_examples=30, deadline=None)
@given(friendly.map(tuple))
def test_scikit_fuzzy_comes_near(layers):
    assume(max(layer.term(x) for layer in layers for x in np.linspace(LOW, HIGH, 9).tolist()) > 0.2)
    found = OutputSet(WHOLE, layers)
    assert reference.value(found) == pytest.approx(found.value(), abs=2e-3)


def test_matlabs_rule_gives_both_ends_full_weight():
    full, left = Trapezoid(0, 0, 1, 1), Trapezoid(0, 0, 0, 1)
    assert OutputSet(Interval(0, 1), (Layer(full, 1),)).value_from_samples() == pytest.approx(0.5)
    # sum of x (1 - x) over sum of (1 - x), 101 points
    assert OutputSet(Interval(0, 1), (Layer(left, 1),)).value_from_samples() == pytest.approx(16.665 / 50.5)


@pytest.mark.parametrize(
    "layers", [(), (Layer(Trapezoid(0, 0, 1, 1), 0),), (Layer(Trapezoid(5, 6, 7, 8), 1),)]
)
@pytest.mark.parametrize("value", [OutputSet.value, OutputSet.value_from_samples, reference.value])
def test_no_area_has_no_centre(layers, value):
    assert value(OutputSet(Interval(0, 1), layers)) is None


def test_a_vertical_edge_inside_the_domain_counts_once():
    box = Layer(Trapezoid(0.25, 0.25, 0.5, 0.5), 0.7)
    assert OutputSet(Interval(0, 1), (box,)).value() == pytest.approx(0.375, abs=1e-12)
