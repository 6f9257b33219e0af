"""Sentences that quote words mean whole words and whole numbers, in small letters or capitals."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity.testing.amounts.words import holds

WORD = st.text("abcXYZ019é_", min_size=1, max_size=4)


@given(st.lists(WORD, min_size=1, max_size=6), st.data())
def test_words_that_stand_in_a_text_are_found_and_parts_of_them_are_not(text, data):
    i = data.draw(st.integers(0, len(text) - 1))
    j = data.draw(st.integers(i + 1, len(text)))
    assert holds(f"so: {' '.join(text)}.", "  ".join(text[i:j]).swapcase())
    longer = [f"q{word}q" for word in text]
    assert not holds(" ".join(longer), " ".join(text[i:j]))


@pytest.mark.parametrize(
    ("text", "words", "found"),
    [
        ("→ both (rule 11, 0.84)", "rule 1", False),
        ("→ both (rule 1, 0.84)", "rule 1", True),
        ("the score is 38", "is 3", False),
        ("distance 0.64 m", "distance 0", False),
        ("distance 0.64 m", "64 m", False),
        ("distance 0.64 m", "0.64 m", True),
        ("it is 3.", "is 3", True),
        ("The doctor is ready.", "read", False),
        ("The doctor is ready.", "the doctor", True),
        ("gender is female → close (rule 1, 0.84)", "→ close (rule 1, 0.84)", True),
        ("made of two\nlines", "two lines", True),
        ("O'Neil's tea", "neil", True),
        ("whatever", "", True),
    ],
)
def test_what_is_a_word_and_what_a_number(text, words, found):
    assert holds(text, words) is found


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("un the\u0301 d'e\u0301te\u0301", "th\u00e9"),
        ("un th\u00e9", "the\u0301"),
        ("Talstraße 4", "TALSTRASSE"),
        ("TALSTRASSE 4", "Talstraße"),
    ],
)
def test_signs_that_look_or_mean_the_same_are_the_same(text, words):
    assert holds(text, words)
