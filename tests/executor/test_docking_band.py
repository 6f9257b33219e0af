"""The bands of docking: tight to enter, loose to leave, and never below the safety floor."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_executor import Limits
from comity_executor.leaves.docking_band import enter_band, leave_band, lost_band
from comity_executor.memory.visit import PlannedPose
from comity_executor.robots.bearing import bearing_error_deg

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


@pytest.mark.parametrize(
    ("quantity", "text"),
    [
        ({"bearing_deg": -74.94}, "bearing -74.9 deg left ±10 around -85.0"),
        ({"bearing_deg": -74.96}, "bearing -74.96 deg left ±10 around -84.98"),
        ({"distance_m": 1.0604}, "distance 1.0604 m left 0.9600..1.0600 around 1.0100"),
    ],
)
def test_what_is_outside_by_less_than_the_last_digit_is_told_with_more(reading, quantity, text) -> None:
    band = lost_band(PlannedPose(1.01, -84.98), Limits())
    assert band.account(reading(**{"bearing_deg": -80.0, **quantity})).text == text


@given(poses, quantities)
def test_the_numbers_told_are_outside_as_well(reading, pose, quantities) -> None:
    band, seen = enter_band(pose, Limits()), reading(**quantities)
    text = band.account(seen).text
    if found := re.fullmatch(r"distance (\S+) m is not in (\S+)\.\.(\S+) around \S+", text):
        it, near, far = map(float, found.groups())
        assert not near <= it <= far or min(abs(it - near), abs(it - far)) < 1e-8
    elif found := re.fullmatch(r"bearing (\S+) deg is not in ±3 around (\S+)", text):
        assert bearing_error_deg(*map(float, found.groups())) > 3.0
    elif found := re.fullmatch(r"facing error (\S+) deg is above 5", text):
        assert float(found[1]) >= 5.0


def test_the_loose_band_is_asymmetric(reading) -> None:
    band = leave_band(PlannedPose(1.01, 0.0), Limits())
    assert band.contains(reading(distance_m=0.77))
    assert not band.contains(reading(distance_m=0.75))
    assert band.contains(reading(distance_m=1.30))
    assert not band.contains(reading(distance_m=1.32))


def test_bearings_are_compared_on_the_circle(reading) -> None:
    assert enter_band(PlannedPose(1.01, 179.0), Limits()).contains(reading(bearing_deg=-179.0))
