"""Neighbour lists: whatever moves, they hold exactly the pairs that a look at everybody finds."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from comity_sim2d.people.neighbours import FEW, VERY_FEW, NeighbourList, pairs_within
from comity_sim2d.people.outlines import Outlines, WallList

SEEDS = st.integers(0, 10_000)
REACH_M, SKIN_M = 3.0, 1.0


def places(rng: np.random.Generator, count: int) -> np.ndarray:
    side = 2.0 * np.sqrt(count)
    return rng.uniform(0, side, count) + 1j * rng.uniform(0, side, count)


def all_pairs(at: np.ndarray, reach: float) -> set[tuple[int, int]]:
    """By comparing everybody with everybody."""
    count = len(at)
    return {(i, j) for i in range(count) for j in range(i + 1, count) if abs(at[i] - at[j]) <= reach}


@settings(max_examples=25, deadline=None)
@given(SEEDS, st.sampled_from([2, 10, FEW, FEW + 1, 120]))
def test_pairs_are_those_that_a_look_at_everybody_finds(seed, count):
    at = places(np.random.default_rng(seed), count)
    assert set(zip(*pairs_within(at, REACH_M), strict=True)) == all_pairs(at, REACH_M)


@settings(max_examples=10, deadline=None)
@given(SEEDS, st.sampled_from([VERY_FEW + 1, 80]))
def test_a_list_never_misses_a_pair_while_people_walk(seed, count):
    rng = np.random.default_rng(seed)
    at, kept = places(rng, count), 0
    neighbours = NeighbourList(REACH_M, SKIN_M, np.ones(count, dtype=bool))
    for _ in range(30):
        kept += not neighbours.update(at)
        listed = set(zip(neighbours.one.tolist(), neighbours.other.tolist(), strict=True))
        assert all_pairs(at, REACH_M) <= listed <= all_pairs(at, REACH_M + 2 * SKIN_M)
        at = at + 0.13 * np.exp(2j * np.pi * rng.random(count))
    assert kept > 10


def test_of_very_few_all_pairs_are_listed_once_and_for_good():
    neighbours = NeighbourList(REACH_M, SKIN_M, np.ones(VERY_FEW, dtype=bool))
    assert neighbours.update(places(np.random.default_rng(0), VERY_FEW))
    assert not neighbours.update(places(np.random.default_rng(1), VERY_FEW))
    assert len(neighbours.one) == VERY_FEW * (VERY_FEW - 1) // 2


def test_two_who_never_move_are_no_pair():
    at = np.array([0j, 1 + 0j, 2 + 0j])
    neighbours = NeighbourList(REACH_M, SKIN_M, np.array([False, False, True]))
    neighbours.update(at)
    assert list(zip(neighbours.one.tolist(), neighbours.other.tolist(), strict=True)) == [(0, 2), (1, 2)]


@settings(max_examples=25, deadline=None)
@given(SEEDS)
def test_walls_are_as_far_as_geometry_says(seed):
    from shapely import LineString, Point

    rng = np.random.default_rng(seed)
    starts, ends, at = (places(rng, 12) for _ in range(3))
    half = rng.uniform(0.0, 0.1, 12)
    walls = WallList(Outlines(starts, ends, half), np.arange(12), np.zeros(12), 50.0, SKIN_M)
    _, distance = walls.update(at)
    lines = [LineString([(a.real, a.imag), (b.real, b.imag)]) for a, b in zip(starts, ends, strict=True)]
    truth = [
        Point(p.real, p.imag).distance(line) - h for p in at for line, h in zip(lines, half, strict=True)
    ]
    assert distance == pytest.approx(np.array(truth), abs=1e-9)
