"""Terms fitted to any data have one peak, follow the clusters between the data too, and leave no gap."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from sampling import sampled

from comity_fis import InputError, Level, from_data, individualism_scores, load_rulebook, partition
from comity_fis.membership.function import Bump, TwoTermGaussian
from comity_fis.variables.clustering import memberships_of, peaked_degrees
from comity_fis.variables.fitted_term import humps

SCORES = [float(row.value) for row in individualism_scores()]
NOBODY_SAID_4 = [1.0] * 14 + [2.0] * 16 + [3.0] * 7 + [5.0] * 9 + [6.0] * 8 + [7.0] * 6
FIVE_POINTS = [1.0] * 10 + [2.0] * 12 + [3.0] * 5 + [4.0] * 9 + [5.0] * 14
RADII = st.sampled_from([0.1, 0.2, 0.3, 0.5])


@st.composite
def likert(draw):
    """Answers on a scale of 4 to 9 points, some of which may be nobody's."""
    counts = draw(st.lists(st.integers(0, 20), min_size=4, max_size=9))
    return [float(answer) for answer, count in enumerate(counts, 1) for _ in range(count)]


@st.composite
def continuous(draw):
    """Normal groups anywhere, skewed data, and data with outliers."""
    source = np.random.default_rng(draw(st.integers(0, 10_000)))
    kind, count = draw(st.sampled_from(["normal", "skewed", "outliers"])), draw(st.integers(8, 60))
    if kind == "normal":
        groups = [source.normal(source.uniform(0, 100), source.uniform(2, 15), count) for _ in range(3)]
        return np.concatenate(groups).tolist()
    if kind == "skewed":
        return source.exponential(1, count).tolist()
    return np.concatenate([source.normal(0, 1, count), source.standard_cauchy(10)]).tolist()


def parted(data, radius):
    """The partition, where the data have several groups."""
    try:
        return partition(data, radius)
    except InputError:
        assume(False)


def degrees(term, places):
    return np.array([term(float(x)) for x in places])


def rise_after_fall(curve):
    """How far a curve rises again after it fell from its highest place, to either side."""
    top = int(curve.argmax())
    sides = curve[top:], curve[top::-1]
    return max(float((side - np.minimum.accumulate(side)).max()) for side in sides)


@sampled(6)
@given(likert() | continuous(), RADII)
def test_every_term_has_one_peak_and_together_they_leave_no_gap(data, radius):
    found = parted(data, radius)
    low, high = min(data), max(data)
    width = high - low
    curves = []
    for fit, centre in zip(found.fits, found.centres, strict=True):
        bumps = fit.term.first, fit.term.second
        beside = [bump.centre + k / 20 * bump.width for bump in bumps for k in range(-100, 101)]
        places = np.unique([*np.linspace(low - width, high + width, 3001), *beside])
        assert rise_after_fall(degrees(fit.term, places)) < 1e-6
        curves.append(degrees(fit.term, np.linspace(low, high, 501)))
        assert fit.term(centre) > 0.6
        assert (fit.form == "held") == bool(fit.because)
    assert np.max(curves, axis=0).min() > 0.2
    assert np.sum(curves, axis=0).max() < 1.5


@sampled(3)
@given(
    likert() | continuous(), RADII, st.sampled_from([1e-300, 1e-20, 1e-3, 7.0, 1e9, 1e200]),
    st.sampled_from([0.0, -3.0, 50.0]),
)  # fmt: skip
def test_other_units_and_another_zero_give_the_same_terms_there(data, radius, scale, shift):
    found = parted(data, radius)
    moved = partition([scale * (x + shift) for x in data], radius)
    low, width = min(data), max(data) - min(data)
    assert [c / scale - shift for c in moved.centres] == pytest.approx(found.centres, abs=1e-5 * width)
    assert [fit.form for fit in moved.fits] == [fit.form for fit in found.fits]
    for fit, other in zip(found.fits, moved.fits, strict=True):
        for x in np.linspace(low, low + width, 41).tolist():
            assert other.term(scale * (x + shift)) == pytest.approx(fit.term(x), abs=1e-3)


def test_seven_points_of_which_one_is_nobodys_give_two_terms_that_share_it():
    found = partition(NOBODY_SAID_4)
    low, high = found.terms.values()
    assert low(4) == pytest.approx(0.4, abs=0.1)
    assert low(4) + high(4) == pytest.approx(1, abs=0.1)
    assert [fit.form for fit in found.fits] == ["held", "held"]
    assert max(fit.largest_error for fit in found.fits) < 0.05


def test_five_points_are_enough():
    variable = from_data("agreement", FIVE_POINTS, level=Level.INTERVAL, reason="made up")
    assert list(variable.terms) == ["LC1", "LC2"]
    assert variable.partition.held["LC1"].startswith("5 different values")
    assert "Held terms" in variable.partition.method


def test_a_gap_between_groups_is_no_hole_in_the_terms():
    rng = np.random.default_rng(3)
    data = np.concatenate([rng.normal(20, 2, 40), rng.normal(80, 2, 40)])
    low, high = partition(data).terms.values()
    assert low(50) + high(50) == pytest.approx(1, abs=0.15)


def test_the_papers_fit_is_free_and_looked_at_over_the_whole_range():
    found = partition(SCORES)
    assert [(fit.form, fit.because) for fit in found.fits] == [("free", ""), ("free", "")]
    assert [fit.largest_error for fit in found.fits] == pytest.approx([0.0241, 0.0264], abs=1e-3)
    assert load_rulebook("bruno2017").variables["individualism"].partition.held == {}


def test_a_second_hump_is_found_where_it_is():
    humped = TwoTermGaussian(Bump(1.0, 0.2, 0.1), Bump(0.6, 0.7, 0.1))
    top, second = humps(humped)
    assert top == pytest.approx((0.2, 1.0), abs=1e-2)
    assert second == pytest.approx((0.7, 0.6), abs=1e-2)
    assert len(humps(TwoTermGaussian(Bump(1.0, 0.4, 0.2), Bump(0.6, 0.5, 0.2)))) == 1
    assert len(humps(TwoTermGaussian(Bump(1.0, 0.4, 0.2), Bump(0.6, 0.4, 0.1)))) == 1


@given(st.lists(st.integers(0, 1000), min_size=2, max_size=6, unique=True), st.data())
def test_the_degrees_of_a_cluster_have_one_peak_at_its_centre(places, data):
    centres = np.sort(places) / 1000
    cluster = data.draw(st.integers(0, len(centres) - 1))
    grid = np.unique([*np.linspace(-0.5, 1.5, 501), centres[cluster]])
    curve = peaked_degrees(grid, centres, cluster)
    assert rise_after_fall(curve) < 1e-12
    assert grid[curve.argmax()] == pytest.approx(centres[cluster], abs=1e-9)
    assert (curve <= memberships_of(grid, centres)[cluster]).all()


@pytest.mark.parametrize(
    "data", [[1e308, -1e308, 0, 1, 2, 3], [1e16, 1e16 + 2, 1e16 + 4, 1e16 + 6, 1e16 + 8]]
)
def test_a_range_that_no_difference_resolves_is_refused(data):
    with pytest.raises(InputError, match="differences can be computed"):
        partition(data)
