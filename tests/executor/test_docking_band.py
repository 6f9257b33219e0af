"""The bands of docking: tight to enter, loose to leave, and never below the safety floor."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_executor import Limits
from comity_executor.leaves.docking_band import enter_band, leave_band, lost_band
from comity_executor.memory.visit import PlannedPose

poses = st.builds(PlannedPose, distance_m=st.floats(0.3, 3.0), bearing_deg=st.floats(-180, 180))
quantities = st.fixed_dictionaries(
    {
        "distance_m": st.floats(-0.1, 4.0),
        "bearing_deg": st.floats(-180, 180),
        "facing_error_deg": st.floats(0, 180),
        "speed_m_s": st.floats(0, 1),
    }
)


@given(poses, quantities)
def test_who_enters_does_not_leave_at_once(reading, pose, quantities) -> None:
    seen, limits = reading(**quantities), Limits()
    if enter_band(pose, limits).contains(seen):
        assert leave_band(pose, limits).contains(seen)
        assert lost_band(pose, limits).contains(seen)


@given(poses, quantities)
def test_no_band_reaches_below_the_safety_floor(reading, pose, quantities) -> None:
    seen, limits = reading(**quantities), Limits()
    for band in (enter_band(pose, limits), leave_band(pose, limits), lost_band(pose, limits)):
        assert band.nearest_m >= limits.safety_floor_m
        assert seen.distance_m >= limits.safety_floor_m or not band.contains(seen)


@pytest.mark.parametrize(
    ("quantity", "text", "parameter"),
    [
        ({"distance_m": 1.05}, "distance 1.05 m is not in 1.00..1.02 around 1.01", "conversational_distance"),
        ({"bearing_deg": 178.0}, "bearing 178.0 deg is not in ±3 around 0.0", "approach_direction"),
        ({"facing_error_deg": 6.0}, "facing error 6.0 deg is above 5", None),
        ({"speed_m_s": 0.1}, "speed 0.10 m/s is not below 0.02", None),
    ],
)
def test_the_account_names_what_is_outside(reading, quantity, text, parameter) -> None:
    band = enter_band(PlannedPose(1.01, 0.0), Limits())
    assert not band.contains(reading(**quantity))
    account = band.account(reading(**quantity))
    assert (account.text, account.parameter) == (text, parameter)
    assert account.value == next(iter(quantity.values()))


def test_the_loose_band_is_asymmetric(reading) -> None:
    band = leave_band(PlannedPose(1.01, 0.0), Limits())
    assert band.contains(reading(distance_m=0.77))
    assert not band.contains(reading(distance_m=0.75))
    assert band.contains(reading(distance_m=1.30))
    assert not band.contains(reading(distance_m=1.32))


def test_bearings_are_compared_on_the_circle(reading) -> None:
    assert enter_band(PlannedPose(1.01, 179.0), Limits()).contains(reading(bearing_deg=-179.0))
