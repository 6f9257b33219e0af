"""`-k` of `comity test` is that of pytest."""

from __future__ import annotations

import pytest
from _pytest.mark import expression
from hypothesis import given
from hypothesis import strategies as st

from comity.testing.collection.choosing import choice
from comity_fis import InputError

REFUSALS = (SyntaxError, getattr(expression, "ParseError", SyntaxError))
"""What pytest 9 raises, and what pytest before it."""
NAMES = ("hall[german_man-seed0]", "hall.scenario.yaml", "slow")
WORDS = ("and", "or", "not", "(", ")", "german", "arab", "seed0]", "Hall", "slow", "android", "a:b", "-", "%")


@given(st.lists(st.sampled_from(WORDS), min_size=1, max_size=10).map(" ".join))
def test_it_chooses_what_pytest_chooses_and_refuses_what_pytest_refuses(words):
    try:
        wanted = expression.Expression.compile(words).evaluate(
            lambda name, **_: any(name.lower() in each for each in NAMES)
        )
    except REFUSALS:
        with pytest.raises(InputError) as refused:
            choice(words)
        instead = refused.value.remedy.split("`")[1]
        assert choice(instead)(NAMES) in (True, False), "what is written instead is taken"
    else:
        assert choice(words)(NAMES) == wanted


@given(st.lists(st.sampled_from(["hall", "slow", "not arab", "(a or b)"]), min_size=2, max_size=6))
def test_words_beside_each_other_are_answered_with_and_between_them(words):
    with pytest.raises(InputError) as refused:
        choice(" ".join(words))
    assert refused.value.remedy == f"Write it like `{' and '.join(words)}`."


@pytest.mark.parametrize("words", ["(" * 5000 + "a", "not " * 5000 + "a"])
def test_what_nobody_writes_is_refused_in_words(words):
    with pytest.raises(InputError):
        choice(words)
