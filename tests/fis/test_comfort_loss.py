"""Where to stand, given what is believed: the laws of the loss that decides it."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_fis.learning.comfort import MIDDLES, PLACES
from comity_fis.learning.comfort_loss import HARM, NOTICED, losses

LOSSES = losses(PLACES, MIDDLES)
BELIEFS = st.lists(st.floats(0.0, 1.0), min_size=len(MIDDLES), max_size=len(MIDDLES)).filter(sum)


def best(beliefs) -> float:
    return float(PLACES[(LOSSES @ np.asarray(beliefs)).argmin()])


def test_nobody_is_worse_off_at_the_models_value_nor_for_a_move_that_is_not_noticed():
    small = np.abs(PLACES) <= NOTICED - 1e-9
    assert small.sum() > 10
    assert (LOSSES[small] < np.abs(PLACES[small, None] - MIDDLES) + HARM / 1000).all()


@given(st.floats(0.0, 2.0))
def test_who_certainly_likes_a_place_is_met_there(middle):
    certain = np.zeros(len(MIDDLES))
    certain[np.abs(MIDDLES - middle).argmin()] = 1.0
    assert best(certain) == pytest.approx(float(certain @ MIDDLES), abs=1.01 * (PLACES[1] - PLACES[0]))


def test_where_nothing_is_known_the_models_value_stands():
    assert best(np.ones(len(MIDDLES))) == pytest.approx(0.0, abs=1e-9)
    assert best(np.exp(-(MIDDLES**2) / 2)) == pytest.approx(0.0, abs=1e-9)


@given(BELIEFS, BELIEFS)
def test_who_is_believed_to_like_it_farther_is_never_met_nearer(beliefs, odds):
    """For any shift of the odds of every two middles towards the farther one.

    The difference between the losses of two places changes its sign once along the middles, which is what a
    decision needs to follow such shifts (Karlin and Rubin 1956).
    """
    beliefs = np.asarray(beliefs) + 1e-6
    shifted = beliefs * (1e-3 + np.cumsum(odds))
    assert best(shifted) >= best(beliefs) - 1e-9


@given(BELIEFS, st.floats(0.0, 1.0))
def test_the_more_may_mean_the_opposite_the_less_far_the_robot_goes(beliefs, contrary):
    """Beliefs are weighed against their mirror image: at even odds the model's value stands."""
    beliefs = np.where(MIDDLES > 0.3, np.asarray(beliefs) + 1e-3, 0.0)
    beliefs /= beliefs.sum()
    mirrored = beliefs[::-1]
    some, more = sorted((contrary / 2, 0.5))
    doubted = [best((1 - share) * beliefs + share * mirrored) for share in (0.0, some, more)]
    assert doubted[0] >= doubted[1] - 1e-9 >= doubted[2] - 2e-9
    assert abs(doubted[2]) <= NOTICED
