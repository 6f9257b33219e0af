"""Crowds: people slow down in a dense stream, give way at a door, and never overlap."""

from __future__ import annotations

import numpy as np
import pytest
from crowd_picture import PAGE, tables
from crowd_study import DENSITIES, DOORS_M, LEAVING, RADIUS_M, SEYFRIED_S_M, leaving, stream_m_s, weidmann_m_s
from hypothesis import given
from hypothesis import strategies as st

from comity_sim2d.people.headway import TIME_GAP_S, within_headway
from comity_sim2d.people.near import Near
from comity_sim2d.people.yielding import BACK_S, BLOCKED_S, Yielding

PACES = st.floats(0.2, 2.0)
ANGLES = st.floats(-3.0, 3.0)
GAPS = st.floats(0.0, 3.0)
WIDTH_M = 2 * RADIUS_M


def pair(angle: float, gap_m: float) -> Near:
    """The second body in this direction from the first one."""
    none, first, second = np.empty(0, dtype=int), np.array([0]), np.array([1])
    towards = np.array([np.exp(1j * angle)])
    return Near(first, second, towards, np.array([gap_m]), np.array([WIDTH_M]), none, none + 0j, none + 0.0)


def facing(wanted: np.ndarray) -> np.ndarray:
    """People face where they go."""
    return wanted / np.abs(wanted)


@given(PACES, PACES, ANGLES, ANGLES, GAPS)
def test_nobody_goes_faster_or_elsewhere_because_of_headway(pace, other, way, there, gap_m):
    wanted = np.array([pace * np.exp(1j * way), other * np.exp(1j * way)])
    kept = within_headway(wanted, facing(wanted), pair(there, gap_m))
    assert np.all(np.abs(kept) <= np.abs(wanted) + 1e-12)
    assert np.allclose(kept * np.abs(wanted), wanted * np.abs(kept))


@given(PACES, ANGLES, GAPS)
def test_behind_a_person_the_gap_takes_the_time_gap_at_least(pace, way, gap_m):
    wanted = np.array([pace, 1.0]) * np.exp(1j * way)
    kept = within_headway(wanted, facing(wanted), pair(way, gap_m))
    assert abs(kept[0]) == pytest.approx(min(pace, gap_m / TIME_GAP_S), abs=1e-9)
    assert kept[1] == pytest.approx(wanted[1])  # the one ahead is free


@given(PACES, PACES, ANGLES, GAPS)
def test_people_who_come_the_other_way_are_evaded_and_not_followed(pace, other, way, gap_m):
    wanted = np.array([pace, -other]) * np.exp(1j * way)
    assert within_headway(wanted, facing(wanted), pair(way, gap_m)) == pytest.approx(wanted)


@given(st.integers(0, 1000))
def test_of_two_who_block_each_other_one_steps_back_and_for_a_while(seed):
    step_s = 0.1
    yielding, wanted, still = Yielding(2, seed, step_s), np.array([1.0 + 0j, 1.0 + 0j]), np.zeros(2, complex)
    beside = pair(np.pi / 2, 0.01)
    for _ in range(round(BLOCKED_S / step_s) - 1):
        assert np.array_equal(yielding.decide(wanted, still, beside), wanted)
    back = yielding.decide(wanted, still, beside).real < 0.0
    assert back.sum() == 1
    moving = np.where(back, 0.0, 1.0) + 0j
    backwards = [yielding.decide(wanted, moving, beside)[back][0].real < 0.0 for _ in range(30)]
    assert sum(backwards) + 1 == round(BACK_S / step_s)


@pytest.mark.parametrize("seed", range(2))
def test_sixty_people_leave_by_a_door_of_seventy_centimetres(seed):
    left = leaving(0.7, seed)
    assert left.out == LEAVING
    assert left.last_s <= 90.0


@pytest.mark.parametrize("per_m2", [1.0, 2.0])
def test_a_dense_stream_is_as_slow_as_measured(per_m2):
    assert stream_m_s(per_m2, 0) == pytest.approx(weidmann_m_s(per_m2), rel=0.25)


@pytest.mark.study
def test_so_it_is_in_ten_seeds():
    for per_m2 in DENSITIES:
        speed = np.mean([stream_m_s(per_m2, seed) for seed in range(10)])
        assert speed == pytest.approx(weidmann_m_s(per_m2), rel=0.25)
    for door_m in DOORS_M:
        assert max(leaving(door_m, seed).last_s for seed in range(10)) <= 90.0


def test_the_page_compares_with_what_was_measured_at_the_densities_and_widths_of_the_study():
    streams, through_doors = tables(PAGE.read_text(encoding="utf-8"))
    assert [row.per_m2 for row in streams] == list(DENSITIES)
    assert [row.width_m for row in through_doors] == list(DOORS_M)
    for row in streams:
        assert row.measured_m_s == pytest.approx(weidmann_m_s(row.per_m2), abs=0.005)
    for row in through_doors:
        assert row.measured_s == pytest.approx(SEYFRIED_S_M * row.width_m, abs=0.005)
        assert row.least_s <= row.ours_s <= row.most_s
