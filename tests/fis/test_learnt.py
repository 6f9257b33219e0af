"""What was learnt with a person moves the value, inside what may be asked for and what is safe."""

import math

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from comity_fis import InputError, Learnt
from comity_fis.errors import WrongValueError

OFFSETS = st.floats(-20, 20)
WARMTH = st.none() | st.floats(0, 10)
MOODS = st.sampled_from([None, "calm", "lively"])


def learnt(offset, spread=0.1):
    return Learnt(offset, spread, "3 visits: stepped back once")


@given(WARMTH, MOODS, OFFSETS)
def test_nothing_learnt_passes_what_may_be_asked_for_or_is_safe(small, warmth, mood, offset):
    value = small.infer({"warmth": warmth, "mood": mood}, learnt={"distance": learnt(offset)})["distance"]
    assert 0 <= value.number <= 6  # asked for up to 8, safe up to 6


@given(WARMTH, MOODS, OFFSETS)
def test_contributions_add_up_to_the_value(small, warmth, mood, offset):
    value = small.infer({"warmth": warmth, "mood": mood}, learnt={"distance": learnt(offset)})["distance"]
    assert math.isclose(sum(part.value for part in value.contributions), value.number, abs_tol=1e-9)


@given(WARMTH, OFFSETS)
def test_the_start_is_what_stands_without_anything_learnt(small, warmth, offset):
    without = small.infer({"warmth": warmth})["distance"]
    value = small.infer({"warmth": warmth}, learnt={"distance": learnt(offset)})["distance"]
    assert value.start == without.contributions[0]
    assert value.fired == without.fired


@given(WARMTH, st.tuples(OFFSETS, OFFSETS))
def test_learning_a_larger_offset_never_gives_a_smaller_value(small, warmth, offsets):
    values = [
        small.infer({"warmth": warmth}, learnt={"distance": learnt(offset)})["distance"].number
        for offset in sorted(offsets)
    ]
    assert values[0] <= values[1]


@given(WARMTH, OFFSETS, st.floats(0, 1))
def test_desirability_moves_along_with_the_value(small, warmth, offset, share):
    before = small.infer({"warmth": warmth})["distance"]
    value = small.infer({"warmth": warmth}, learnt={"distance": learnt(offset)})["distance"]
    by = value.number - before.number
    low, high = value.desirability.domain
    assert low <= value.number <= high
    assert 0 <= low <= high <= 6
    assume(high - low > 4e-6)
    x = low + 1e-6 + share * (high - low - 2e-6)
    assert math.isclose(value.desirability(x), before.desirability(x - by), abs_tol=1e-6)
    assert value.desirability.height(x, x) == value.desirability(x)
    assert [x for x, _ in value.desirability.outline] == sorted(x for x, _ in value.desirability.outline)


def test_the_centre_of_a_curve_moves_as_far_as_the_value(small):
    before = small.infer({"warmth": 9})["distance"]
    value = small.infer({"warmth": 9}, learnt={"distance": learnt(0.5)})["distance"]
    assert value.desirability.centroid(0, 6) == pytest.approx(before.number + 0.5)
    assert value.desirability.domain == (0.5, 4.5)
    assert value.desirability.outline[0] == (0.5, 1.0)


def test_a_learnt_value_says_so_with_the_persons_own_spread(small):
    value = small.infer({"warmth": 9}, learnt={"distance": learnt(0.25, spread=0.07)})["distance"]
    assert (value.origin, value.spread) == ("learnt", 0.07)
    assert [part.origin for part in value.contributions] == ["culture", "learnt"]
    assert value.contributions[1].text == "3 visits: stepped back once"


def test_an_offset_of_zero_confirms_and_changes_nothing_but_the_spread(small):
    value = small.infer({"warmth": 9}, learnt={"distance": learnt(0.0, spread=0.07)})["distance"]
    assert (value.origin, value.spread) == ("culture", 0.07)
    assert value.number == small.infer({"warmth": 9})["distance"].number


def test_the_limits_say_what_they_took_away(small):
    high = small.infer({"warmth": 0}, learnt={"distance": learnt(9)})["distance"]
    assert [part.origin for part in high.contributions] == ["culture", "learnt", "learnt", "safety"]
    assert high.contributions[2].text == "kept within what may be asked for, at most 8 m"
    assert (high.number, high.origin) == (6, "safety")
    assert "safety allows at most 6 m" in high.note
    low = small.infer({"warmth": 9}, learnt={"distance": learnt(-9)})["distance"]
    assert (low.number, low.origin) == (0, "learnt")


@given(OFFSETS)
def test_a_setting_stands_whatever_was_learnt(small, offset):
    asked = small.infer({"warmth": 9}, settings={"distance": 2.5})
    assert (
        small.infer({"warmth": 9}, settings={"distance": 2.5}, learnt={"distance": learnt(offset)}) == asked
    )


def test_rules_that_read_a_parameter_read_what_was_learnt(small):
    near = small.infer({"warmth": 9})["volume"].number
    away = small.infer({"warmth": 9}, learnt={"distance": learnt(3.0)})["volume"].number
    assert near < away


@pytest.mark.parametrize("name", ["gesture", "distnace", "warmth"])
def test_only_numeric_parameters_can_be_learnt(small, name):
    with pytest.raises(InputError, match="a numeric parameter of the rulebook small"):
        small.infer({}, learnt={name: learnt(0.1)})


@pytest.mark.parametrize(
    ("offset", "spread"), [(math.nan, 0.1), (math.inf, 0.1), (0.1, -0.1), (0.1, math.nan)]
)
def test_what_is_learnt_is_finite(offset, spread):
    with pytest.raises(WrongValueError):
        Learnt(offset, spread, "")
