"""Groups of about one size at any time, orders that balance, and an allocation that is never replaced."""

from __future__ import annotations

from collections import Counter
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity.study.allocation import allocated
from comity.study.latin_square import balanced_orders
from comity_fis.errors import WrongValueError

COUNTS = st.integers(1, 9)


@given(COUNTS)
def test_each_condition_stands_at_each_place_and_after_each_other_equally_often(count):
    orders = balanced_orders(count)
    assert all(sorted(order) == list(range(count)) for order in orders)
    places = Counter((place, one) for order in orders for place, one in enumerate(order))
    assert len(places) == count * count
    assert len(set(places.values())) == 1
    pairs = Counter(pair for order in orders for pair in pairwise(order))
    assert len(pairs) == count * (count - 1)
    assert len(set(pairs.values())) <= 1


@given(st.integers(1, 60), COUNTS, st.integers(1, 4), st.integers(0, 99))
def test_groups_differ_by_no_more_than_half_a_block_whenever_the_study_ends(people, count, groups, seed):
    names, conditions = [f"g{i}" for i in range(groups)], [f"c{i}" for i in range(count)]
    sizes = Counter(dict.fromkeys(names, 0))
    for one in allocated(people, conditions, names, seed=seed):
        sizes[one.group] += 1
        assert max(sizes.values()) - min(sizes.values()) <= 2
        assert sorted(one.conditions) == conditions


@given(st.integers(1, 30), st.integers(0, 30), st.integers(0, 9))
def test_more_participants_change_nothing_for_those_before_them(few, more, seed):
    conditions, groups = ["a", "b", "c"], ["x", "y"]
    before = allocated(few, conditions, groups, seed=seed)
    assert allocated(few + more, conditions, groups, seed=seed)[:few] == before


def test_orders_come_equally_often_in_each_group():
    sessions = allocated(48, "abcd", ["x", "y"], seed=3)
    for group in "xy":
        orders = Counter(one.conditions for one in sessions if one.group == group)
        assert len(orders) == 4
        assert set(orders.values()) == {6}


def test_another_seed_gives_another_allocation():
    assert allocated(24, "ab", ["x", "y"], seed=1) != allocated(24, "ab", ["x", "y"], seed=2)


def test_what_cannot_be_balanced_is_refused():
    for words in (("aab", ["x"], None), ("ab", ["x", "x"], None), ("ab", ["x", "y"], 3), ("", [], None)):
        conditions, groups, block = words
        with pytest.raises(WrongValueError):
            allocated(4, conditions, groups, block=block, seed=0)


def test_a_sheet_for_each_participant_and_no_allocation_is_replaced(comity, here):
    words = ["study", "sessions", "--conditions", "near,far", "--groups", "x,y", "--out", "sessions"]
    answer = comity(*words, "--participants", 6, "--json").json
    assert [one["participant"] for one in answer["sessions"]] == ["P01", "P02", "P03", "P04", "P05", "P06"]
    first = (here / "sessions/allocation.csv").read_text()
    assert first.splitlines()[0] == "participant,group,block,condition_1,condition_2"
    sheet = (here / "sessions/sheets/P03.txt").read_text()
    assert [sheet.index(one) for one in answer["sessions"][2]["conditions"]]
    assert sheet.count("stop distance") == 6
    assert comity(*words, "--participants", 8).code == 0
    assert (here / "sessions/allocation.csv").read_text().startswith(first)
    said = comity(*words, "--participants", 8, "--seed", 1)
    assert said.code == 2
    assert (here / "sessions/allocation.csv").read_text().startswith(first)
