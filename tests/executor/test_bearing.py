from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_executor.robots.bearing import bearing_error_deg

angles = st.floats(-1000, 1000)


@given(angles, angles)
def test_the_error_is_symmetric_and_at_most_half_a_turn(one: float, other: float) -> None:
    error = bearing_error_deg(one, other)
    assert 0 <= error <= 180
    assert error == pytest.approx(bearing_error_deg(other, one), abs=1e-9)


@given(angles, angles, st.integers(-3, 3))
def test_whole_turns_do_not_count(one: float, other: float, turns: int) -> None:
    error = bearing_error_deg(one, other)
    assert bearing_error_deg(one + 360 * turns, other) == pytest.approx(error, abs=1e-6)


def test_the_back_is_one_direction() -> None:
    assert bearing_error_deg(179, -179) == pytest.approx(2)
