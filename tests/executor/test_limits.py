from __future__ import annotations

import pytest

from comity_executor import Limits


@pytest.mark.parametrize(
    "contradiction",
    [
        {"leave_bearing_deg": 3.0},
        {"leave_closer_m": 0.005},
        {"enter_facing_deg": 60.0},
        {"lost_distance_m": 0.01},
    ],
)
def test_a_band_to_leave_must_be_wider_than_the_one_to_enter(contradiction) -> None:
    with pytest.raises(ValueError, match="flickers"):
        Limits(**contradiction)


@pytest.mark.parametrize("value", [0, -1, float("nan")])
def test_a_limit_is_positive(value: float) -> None:
    with pytest.raises(ValueError, match="reach_timeout_s must be positive"):
        Limits(reach_timeout_s=value)
