"""One person's track: exact where somebody stands or walks on, and not far behind whoever turns round."""

import math
from collections.abc import Iterable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_sim2d import Person, Sensor
from comity_sim2d.senses.tracking import FADING, Covariance, Track

STEP_S, SIGMA_M = 0.05, 0.03
XY = tuple[float, float]
PLACES = st.lists(st.tuples(st.floats(-0.05, 0.05), st.floats(-0.05, 0.05)), min_size=2, max_size=20)


def to_and_fro(speed_m_s: float, seconds: float = 3.0) -> list[XY]:
    """Away for so long, and back."""
    ticks = round(seconds / STEP_S)
    return [(speed_m_s * STEP_S * (ticks - abs(ticks - tick)), 0.0) for tick in range(2 * ticks)]


def followed(way: Iterable[XY], seed: int) -> tuple[list[float], list[float]]:
    """How far the estimate is off at every tick, and the speed that it has [m/s]."""
    rng = np.random.default_rng(seed)
    track = Track(Sensor(SIGMA_M, 0.1), STEP_S, Person("ada", 0.0, 0.0, 0.0))
    off, speeds = [], []
    for x, y in way:
        dx, dy = rng.normal(0.0, SIGMA_M, 2)
        track.update(Person("ada", x + dx, y + dy, 0.0))
        off.append(math.dist(track.ahead(0.0).xy, (x, y)))
        speeds.append(math.hypot(*track.velocity))
    return off, speeds


def test_of_somebody_long_seen_the_gains_are_those_of_morrisons_fading_memory_filter() -> None:
    covariance = Covariance(SIGMA_M, STEP_S)
    for _ in range(1000):
        covariance.expect()
        gains = covariance.take()
    assert gains == pytest.approx((1.0 - FADING**2, (1.0 - FADING) ** 2 / STEP_S), rel=1e-9)


@given(PLACES)
def test_without_noise_the_estimate_is_the_measurement(steps: list[XY]) -> None:
    track, x, y = Track(Sensor(), STEP_S, Person("ada", 0.0, 0.0, 0.0)), 0.0, 0.0
    for dx, dy in steps:
        x, y = x + dx, y + dy
        track.update(Person("ada", x, y, 0.0))
        assert track.ahead(0.0).xy == pytest.approx((x, y), abs=1e-9)


@pytest.mark.parametrize("speed_m_s", [0.2, 0.4, 0.9, 1.2])
def test_who_turns_round_is_soon_where_the_robot_believes_them_to_be(speed_m_s: float) -> None:
    """A filter with a second of memory alone is 0.5 m behind at 1.2 m/s."""
    way = to_and_fro(speed_m_s)
    for seed in range(30):
        off, _ = followed(way, seed)
        assert max(off[60:]) < 0.2
        assert np.percentile(off[90:], 95) < 0.05  # 1.5 s later


def test_who_stands_is_known_well_and_never_taken_for_somebody_who_walks() -> None:
    tracks = [followed([(0.0, 0.0)] * 200, seed) for seed in range(50)]
    off = [each for offs, _ in tracks for each in offs[20:]]
    assert np.percentile(off, 95) < 0.02
    speeds = [speed for _, each in tracks for speed in each[20:]]
    assert np.percentile(speeds, 99.9) < 0.05


def test_who_walks_on_is_followed_without_lag() -> None:
    off = [each for seed in range(30) for each in followed(to_and_fro(0.2, 8.0)[:160], seed)[0][40:]]
    assert np.percentile(off, 95) < 0.03
