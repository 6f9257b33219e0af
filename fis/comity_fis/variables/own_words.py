"""Facts in people's own words: a word outside the categories is disclosed, and no term holds of it."""

from __future__ import annotations

from collections.abc import Collection
from difflib import get_close_matches

from comity_fis.scores.iso3166 import culture_name

CULTURE = "culture"
"""The fact that a person's culture is told by."""
GENDERS = (("female", "woman", "f"), ("male", "man", "m"))
"""Words for the same gender: a rulebook has one of them as a category."""

TYPO = 0.8
"""Similarity of a word and a category, in [0, 1], from which the word is a typo. Our choice, such that
`femal` is one and `transfemale` is not."""


def in_own_words(fact: str, word: str, categories: Collection[str]) -> str | None:
    """A person's word as a value of a variable: a category, or their own word where no category says it.

    Args:
        fact: What it tells: gender, culture, or another one.
        word: What the person said, in any case.
        categories: Of the variable.

    Returns:
        None where the variable takes its categories alone, or the word is a typo of a gender, or a code that
        no country has.
    """
    if fact == CULTURE:
        return _culture(word, categories)
    return _gender(word.strip(), categories) if fact == "gender" else None


def _culture(word: str, categories: Collection[str]) -> str | None:
    name = culture_name(word)
    same = name and next(
        (category for category in categories if category.casefold() == name.casefold()), None
    )
    return same or name


def _gender(word: str, categories: Collection[str]) -> str | None:
    said = word.casefold()
    same = next((words for words in GENDERS if said in words), (said,))
    if known := [category for category in categories if category.casefold() in same]:
        return known[0]
    typo = get_close_matches(said, [category.casefold() for category in categories], n=1, cutoff=TYPO)
    return word if word and not typo else None
