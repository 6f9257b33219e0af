"""The exact centre of area against quadrature that is aligned with every corner, and against scikit-fuzzy."""

import math
from itertools import combinations, pairwise

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from comity_fis.defuzzification import reference
from comity_fis.defuzzification.centroid import Cut, exact_centroid, sampled_centroid
from comity_fis.membership.curved import Complement
from comity_fis.membership.function import Bump, Trapezoid, TwoTermGaussian

LOW, HIGH = 0.45, 1.2
place = st.floats(LOW - 0.2, HIGH + 0.2)
strengths = st.floats(0.001, 1)


@st.composite
def trapezoids(draw):
    a, b, c, d = sorted(draw(st.lists(place, min_size=4, max_size=4)))
    assume(d - a > 1e-3)
    return Trapezoid(a, b, c, d)


gaussians = st.builds(
    TwoTermGaussian,
    st.builds(Bump, st.floats(0.1, 1), place, st.floats(0.05, 0.5)),
    st.builds(Bump, st.floats(0, 1), place, st.floats(0.05, 0.5)),
)
opposites = trapezoids().map(Complement)
straight = st.lists(st.builds(Cut, trapezoids() | opposites, strengths), min_size=1, max_size=5)
mixed = st.lists(st.builds(Cut, trapezoids() | gaussians, strengths), min_size=1, max_size=3)


def by_quadrature(cuts, low, high, panels):
    """Gauss-Legendre between all corners and crossings; many panels where a term is curved."""
    corners = {low, high}
    lines = []
    for cut in cuts:
        if isinstance(cut.term, Trapezoid):
            a, b, c, d = cut.term.knots
            h = cut.strength
            corners |= {a, a + h * (b - a), d - h * (d - c), d}
            lines += [(a, b, 0, 1), (c, d, 1, 0)]
        if isinstance(cut.term, Complement):
            a, b, c, d = cut.term.part.knots
            h = 1 - cut.strength
            corners |= {a, b, c, d, a + h * (b - a), d - h * (d - c)}
            lines += [(a, b, 1, 0), (c, d, 0, 1)]
        lines.append((low, high, cut.strength, cut.strength))
    for i, (x0, x1, y0, y1) in enumerate(lines):
        for u0, u1, v0, v1 in lines[:i]:
            if x1 > x0 and u1 > u0:
                slope, other = (y1 - y0) / (x1 - x0), (v1 - v0) / (u1 - u0)
                if slope != other:
                    corners.add(((v0 - other * u0) - (y0 - slope * x0)) / (slope - other))
    edges = sorted(x for x in corners if low <= x <= high)
    fine = np.unique(np.concatenate([np.linspace(x0, x1, panels + 1) for x0, x1 in pairwise(edges)]))
    nodes, weights = np.polynomial.legendre.leggauss(5)
    half = np.diff(fine)[:, None] / 2
    xs = (fine[:-1, None] + half) + half * nodes
    degrees = np.vectorize(lambda x: max(cut(x) for cut in cuts))(xs)
    area = math.fsum((half * weights * degrees).ravel())
    return None if area <= 1e-9 else math.fsum((half * weights * degrees * xs).ravel()) / area


@given(straight)
def test_trapezoids_exactly(cuts):
    expected = by_quadrature(cuts, LOW, HIGH, 1)
    assume(expected is not None)
    assert exact_centroid(cuts, LOW, HIGH) == pytest.approx(expected, abs=1e-9 * (HIGH - LOW))


def unbounded(term):
    """The term without the bound at 1, so that it meets a strength of 1 at a point and not along a line."""
    if isinstance(term, Trapezoid):
        return term
    bumps = (term.first, term.second)
    return lambda x: sum(b.height * math.exp(-(((x - b.centre) / b.width) ** 2)) for b in bumps)


def crossings(cuts, low, high):
    """Where any two of the terms and of the strengths that cut them are equal, found by bracketing."""
    curves = [unbounded(cut.term) for cut in cuts] + [lambda x, top=cut.strength: top for cut in cuts]
    grid = np.linspace(low, high, 1501)
    levels = [np.array([curve(x) for x in grid]) for curve in curves]
    for (f, above), (g, below) in combinations(zip(curves, levels, strict=True), 2):
        apart = above - below
        yield from grid[apart == 0] if 0 < np.count_nonzero(apart == 0) < 10 else ()
        for k in np.flatnonzero(apart[:-1] * apart[1:] < 0):
            yield brentq(lambda x, f=f, g=g: f(x) - g(x), grid[k], grid[k + 1], xtol=1e-14)


def by_aligned_quadrature(cuts, low, high):
    """Gauss-Legendre between all knots and crossings, so that no panel has a corner inside."""
    knots = {x for cut in cuts for x in cut.term.knots} | set(crossings(cuts, low, high))
    edges = np.unique([low, *(x for x in knots if low < x < high), high])
    nodes, weights = np.polynomial.legendre.leggauss(40)
    area = moment = 0.0
    for x0, x1 in pairwise(edges):
        for a, b in pairwise(np.linspace(x0, x1, 5)):
            xs = (a + b) / 2 + (b - a) / 2 * nodes
            degrees = np.array([max(cut(x) for cut in cuts) for x in xs])
            area += (b - a) / 2 * float(weights @ degrees)
            moment += (b - a) / 2 * float(weights @ (degrees * xs))
    return None if area <= 1e-6 else moment / area


@settings(max_examples=25, deadline=None)
@given(mixed)
def test_curved_terms_to_a_billionth_of_the_range(cuts):
    expected = by_aligned_quadrature(cuts, LOW, HIGH)
    assume(expected is not None)
    assert exact_centroid(cuts, LOW, HIGH) == pytest.approx(expected, abs=1e-9 * (HIGH - LOW))


@pytest.mark.parametrize(("strength", "centre"), [(1.0, 0.8), (0.5, 0.8)])
def test_a_symmetric_curve_has_its_centre_in_the_middle(strength, centre):
    term = TwoTermGaussian(Bump(1, centre, 0.1), Bump(0, 0, 1))
    assert exact_centroid([Cut(term, strength)], 0.5, 1.1) == pytest.approx(0.8, abs=6e-10)


def test_a_cut_gaussian_in_closed_form():
    """Half a bell cut off at 1/2, integrated by hand with the error function."""
    width, top = 0.2, 0.5
    edge = width * math.sqrt(math.log(1 / top))
    area = top * edge + width * math.sqrt(math.pi) / 2 * (math.erf(1 / width) - math.erf(edge / width))
    moment = top * edge**2 / 2 + width**2 / 2 * (
        math.exp(-((edge / width) ** 2)) - math.exp(-((1 / width) ** 2))
    )
    cut = Cut(TwoTermGaussian(Bump(1, 0, width), Bump(0, 0, 1)), top)
    assert exact_centroid([cut], 0, 1) == pytest.approx(moment / area, abs=1e-9)


@given(straight, place, place)
def test_the_centre_lies_in_the_interval_or_there_is_none(cuts, one, other):
    low, high = sorted((one, other))
    centre = exact_centroid(cuts, low, high)
    assert centre is None or low <= centre <= high


@given(straight)
def test_the_order_of_terms_does_not_matter(cuts):
    forward, backward = exact_centroid(cuts, LOW, HIGH), exact_centroid(cuts[::-1], LOW, HIGH)
    assert forward == pytest.approx(backward, abs=1e-12) if forward is not None else backward is None


@settings(max_examples=30, deadline=None)
@given(st.lists(st.builds(Cut, trapezoids(), strengths), min_size=1, max_size=5))
def test_scikit_fuzzy_comes_near(cuts):
    ours, theirs = exact_centroid(cuts, LOW, HIGH), reference.defuzzified(cuts, LOW, HIGH)
    heights = [cut.term.height(LOW, HIGH) * (min(cut.term.d, HIGH) - max(cut.term.a, LOW)) for cut in cuts]
    assume(max(heights) > 0.1)
    assert theirs == pytest.approx(ours, abs=2e-3)


def test_matlabs_rule_gives_both_ends_full_weight():
    full = Cut(Trapezoid(0, 0, 1, 1), 1)
    left = Cut(Trapezoid(0, 0, 0, 1), 1)
    assert sampled_centroid([full], 0, 1) == pytest.approx(0.5)
    # sum of x (1 - x) over sum of (1 - x), 101 points
    assert sampled_centroid([left], 0, 1) == pytest.approx(16.665 / 50.5)


def test_no_area_has_no_centre():
    nothing = Cut(Trapezoid(0, 0, 1, 1), 0)
    for centre in (exact_centroid, sampled_centroid, reference.defuzzified):
        assert centre([nothing], 0, 1) is None
        assert centre([], 0, 1) is None


def test_a_vertical_edge_inside_the_domain_counts_once():
    box = Cut(Trapezoid(0.25, 0.25, 0.5, 0.5), 0.7)
    assert exact_centroid([box], 0, 1) == pytest.approx(0.375, abs=1e-12)
