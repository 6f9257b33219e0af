"""Partial pooling: few answers are drawn towards what stood before, many stand by themselves."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from comity_fis.audit.order import BAND_M
from comity_fis.learning.pooling import StatedOffset, pooled

SPREAD_M, WIDEST_M = 0.3, 0.75
"""What the shipped rulebooks declare of people's distances, and what their rules can give."""

offsets = st.floats(-1, 1).map(lambda x: round(x, 3))
answers = st.lists(
    st.builds(StatedOffset, st.integers(0, 8), st.sampled_from(["JPN", "DEU", "Kurdish", None]), offsets),
    min_size=1,
    max_size=30,
)


def prior(given_answers, spread=SPREAD_M, widest=WIDEST_M):
    return pooled(given_answers, declared_spread=spread, widest=widest)


@given(answers)
def test_a_group_lies_between_its_own_mean_and_everybodys_value(given_answers):
    found = prior(given_answers)
    for group in found.groups.values():
        low, high = sorted((group.mean, found.everybody))
        assert low - 1e-9 <= group.offset <= high + 1e-9


@given(answers)
def test_everybodys_value_lies_between_what_stood_before_and_what_groups_say(given_answers):
    found = prior(given_answers)
    means = [group.mean for group in found.groups.values()]
    if all(answer.group for answer in given_answers):
        assert min([0.0, *means]) - 1e-9 <= found.everybody <= max([0.0, *means]) + 1e-9


@given(answers, st.randoms(use_true_random=False))
def test_the_order_of_the_answers_does_not_matter(given_answers, source):
    one, other = prior(given_answers), prior(source.sample(given_answers, len(given_answers)))
    assert one.everybody == pytest.approx(other.everybody, abs=1e-9)
    assert {name: group.offset for name, group in one.groups.items()} == pytest.approx(
        {name: group.offset for name, group in other.groups.items()}, abs=1e-9
    )


@given(answers)
def test_centimetres_give_what_metres_give(given_answers):
    metres = prior(given_answers)
    centimetres = prior(
        [StatedOffset(a.person, a.group, 100 * a.offset) for a in given_answers],
        100 * SPREAD_M,
        100 * WIDEST_M,
    )
    assert centimetres.everybody == pytest.approx(100 * metres.everybody, abs=1e-6)
    assert centimetres.between_people == pytest.approx(100 * metres.between_people)


@given(answers, st.lists(offsets, min_size=1, max_size=6))
def test_a_person_lies_between_their_group_and_their_own_answers_and_nearer_with_each(given_answers, own):
    found = prior(given_answers)
    expected, mean = found.expected("JPN"), sum(own) / len(own)
    low, high = sorted((expected, mean))
    assert low - 1e-9 <= found.known("JPN", own) <= high + 1e-9
    trusts = [found.trust(count) for count in (1, 2, 5)]
    assert trusts == sorted(trusts)
    assert all(0 <= trust <= 1 for trust in trusts)


def test_somebody_of_a_place_that_nobody_told_of_is_anybody():
    found = prior([StatedOffset(i, group, 0.2) for group in ("JPN", "DEU") for i in range(9)])
    assert found.expected("KEN") == found.expected(None) == found.everybody


def test_one_place_alone_says_nothing_about_the_others():
    found = prior([StatedOffset(i, "JPN", 0.25) for i in range(20)])
    assert found.expected("KEN") == 0
    assert found.expected("JPN") > 0.2


def test_people_whose_culture_is_not_known_are_everybody():
    found = prior([StatedOffset(i, None, 0.25) for i in range(20)])
    assert found.everybody > 0.2
    assert dict(found.groups) == {}


def drawn(people, wrong, seed, spread=SPREAD_M):
    """What is expected of a place whose people want so much more than what stood before."""
    random = np.random.default_rng(seed)
    return prior([StatedOffset(i, "JPN", random.normal(wrong, spread)) for i in range(people)]).expected(
        "JPN"
    )


def harm(expected, wrong, spread=SPREAD_M):
    """By how much a new person of the place is missed by more than before, on average."""
    new = np.random.default_rng(7).normal(wrong, spread, 20_000)
    return float(np.abs(new - expected).mean() - np.abs(new).mean())


@pytest.mark.parametrize("wrong", [0.25, -0.25])
def test_twenty_people_of_one_place_mend_a_prior_that_is_25_cm_wrong(wrong):
    """People vary by 30 cm: 6 cm are left on average, less than a half in more than 85 of 100 tables."""
    left = [abs(drawn(20, wrong, seed) - wrong) for seed in range(300)]
    assert np.mean(left) < 0.07
    assert np.mean(np.array(left) < 0.125) > 0.85
    assert np.mean([harm(drawn(20, wrong, seed), wrong) for seed in range(50)]) < -0.05


@pytest.mark.parametrize("spread", [0.15, 0.2, 0.3])
def test_five_people_of_one_place_do_a_right_prior_no_harm(spread):
    """Over many tables, new people are missed by less than the smallest difference that counts."""
    assert np.mean([harm(drawn(5, 0.0, seed, spread), 0.0, spread) for seed in range(300)]) < BAND_M


@settings(max_examples=20)
@given(st.integers(0, 10**6))
def test_what_varies_is_told_apart(seed):
    """40 people of each of 8 places, three answers each: places by 15 cm, people by 20, answers by 6."""
    random = np.random.default_rng(seed)
    found = prior(
        [
            StatedOffset((place, person), f"place {place}", of_place + of_person + random.normal(0, 0.06))
            for place in range(8)
            for of_place in [random.normal(0, 0.15)]
            for person in range(40)
            for of_person in [random.normal(0, 0.20)]
            for _ in range(3)
        ]
    )
    assert found.within_person == pytest.approx(0.06, rel=0.25)
    assert found.between_people == pytest.approx(0.20, rel=0.25)
    assert 0.03 < found.between_groups < 0.40
    assert found.trust(1) == pytest.approx(0.04 / (0.04 + 0.0036), abs=0.06)
