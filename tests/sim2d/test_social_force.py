"""The social force model: what its formula implies for any two people, and for one of them and a wall."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from comity_sim2d.people.social_force import BIAS, REACH_M, STRENGTH_M_S2, between, from_wall

PARTS = st.floats(-3.0, 3.0)
VECTORS = st.builds(complex, PARTS, PARTS)
APART = VECTORS.filter(lambda apart: abs(apart) > 0.3)
WIDTH_M = 0.4


def push(apart: complex, closing: complex, side: float = 1.0) -> complex:
    towards, gap_m = np.array([apart / abs(apart)]), np.array([abs(apart) - WIDTH_M])
    return complex(between(towards, gap_m, np.array([closing]), side)[0])


@given(APART, VECTORS)
def test_what_one_does_the_other_does_opposite(apart, closing):
    assert push(apart, closing) == pytest.approx(-push(-apart, -closing), abs=1e-9)


@given(APART, VECTORS)
@example(complex(-0.0, -1.0), 1j)  # straight away from somebody, where the angle's sign is that of a zero
@example(complex(0.0, -1.0), 1j)
@example(complex(-1.0, -0.0), 1 + 0j)
def test_a_mirrored_meeting_has_the_mirrored_outcome(apart, closing):
    mirrored = push(apart.conjugate(), closing.conjugate(), side=-1.0)
    assert mirrored == pytest.approx(push(apart, closing).conjugate(), abs=1e-9)


@given(APART, VECTORS, st.floats(-math.pi, math.pi))
def test_the_direction_of_the_compass_means_nothing(apart, closing, turn):
    assume(abs(closing) < 1e-9 or abs((closing / apart).imag) > 1e-6)  # head-on the side jumps with the angle
    turned = np.exp(1j * turn)
    assert push(apart * turned, closing * turned) == pytest.approx(push(apart, closing) * turned, abs=1e-6)


def test_standing_face_to_face_the_force_is_that_of_the_paper():
    """Without relative velocity B = gamma, and theta is the bias alone (Moussaid et al. 2009, equation 4)."""
    for distance in (0.5, 1.0, 2.0):
        force = push(complex(distance), 0j)
        slow = STRENGTH_M_S2 * math.exp(-distance / REACH_M - (3 * REACH_M * BIAS * REACH_M) ** 2)
        turn = STRENGTH_M_S2 * math.exp(-distance / REACH_M - (2 * REACH_M * BIAS * REACH_M) ** 2)
        assert force.real == pytest.approx(-slow)
        assert force.imag == pytest.approx(-turn)


@pytest.mark.parametrize(("side", "sign"), [(1.0, -1.0), (-1.0, 1.0)])
def test_who_meet_head_on_evade_to_the_side_that_people_keep_to(side, sign):
    assert math.copysign(1.0, push(3.0 + 0j, 2.6 + 0j, side).imag) == sign


@given(st.floats(0.0, 3.0), st.floats(0.01, 1.0))
def test_a_wall_pushes_away_and_the_more_the_nearer(gap, farther):
    near, far = (abs(from_wall(np.array([1j]), np.array([g]))[0]) for g in (gap, gap + farther))
    assert near > far
