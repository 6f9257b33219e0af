import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from comity_fis.errors import WrongValueError
from comity_fis.membership.function import Bump, Trapezoid, TwoTermGaussian

number = st.floats(-100, 100)
bumps = st.builds(Bump, st.floats(0, 2), number, st.floats(0.5, 50))


@st.composite
def trapezoids(draw):
    corners = sorted(draw(st.lists(number, min_size=4, max_size=4)))
    assume(corners[3] - corners[0] > 1e-6)
    return Trapezoid(*corners)


memberships = trapezoids() | st.builds(TwoTermGaussian, bumps, bumps)


@given(memberships, st.floats(-300, 300))
def test_degrees_stay_in_0_to_1(membership, x):
    assert 0 <= membership(x) <= 1


@given(memberships, number, number)
def test_the_height_is_the_largest_degree_and_is_reached(membership, one, other):
    low, high = sorted((one, other))
    degrees = [membership(x) for x in np.linspace(low, high, 2001)]
    height = membership.height(low, high)
    assert height >= max(degrees) - 1e-9
    steepest = 2.0 if isinstance(membership, Trapezoid) else 2 * 2 / 0.5
    if isinstance(membership, TwoTermGaussian):
        assert height <= max(degrees) + steepest * (high - low) / 2000


@given(trapezoids())
def test_a_trapezoid_is_1_on_its_core_and_0_outside_its_support(shape):
    assert shape(shape.b) == shape(shape.c) == shape((shape.b + shape.c) / 2) == 1
    assert shape(np.nextafter(shape.a, -np.inf)) == shape(np.nextafter(shape.d, np.inf)) == 0


def test_a_shoulder_is_1_at_its_end():
    assert Trapezoid(0, 0, 1, 2)(0) == 1
    assert Trapezoid(0, 1, 2, 2)(2) == 1


@pytest.mark.parametrize(
    "corners", [(3, 2, 1, 0), (0, 1, 2, float("nan")), (1, 1, 1, 1), (0, 0, 1, float("inf"))]
)
def test_wrong_corners_cannot_be_built(corners):
    with pytest.raises(WrongValueError):
        Trapezoid(*corners)


@pytest.mark.parametrize("numbers", [(-0.1, 0, 1), (1, 0, 0), (1, float("nan"), 1)])
def test_wrong_bumps_cannot_be_built(numbers):
    with pytest.raises(WrongValueError):
        Bump(*numbers)
